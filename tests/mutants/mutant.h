// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <type_traits>

// What scripts/mutants puts into a copy of the sources, so that one build holds many edits: each is asleep unless the
// environment names it by AFM_MUTANT=<number>. Nothing else includes this.
namespace afm_mutants {

inline int awake() {
  static const int number = [] {
    const char* text = std::getenv("AFM_MUTANT");
    return text == nullptr ? -1 : std::atoi(text);
  }();
  return number;
}

// What the compiler evaluates stays as it was.
template <int kNumber>
constexpr bool is_awake() {
  if (std::is_constant_evaluated()) return false;
  return awake() == kNumber;
}

// `c * factor<7, 0>()`: c, or c times the second number.
template <int kNumber, int kFactor>
constexpr int factor() {
  return is_awake<kNumber>() ? kFactor : 1;
}

// `a + Sign<7, -1>() * b` is a - b asleep, and a + b awake; `a + Sign<7, 1>() * b` the other way round.
template <int kNumber, int kAsleep>
struct Sign {
  template <class T>
  friend constexpr auto operator*(Sign, const T& b) {
    return (is_awake<kNumber>() ? -kAsleep : kAsleep) < 0 ? -b : +b;
  }
};

// `a < Less<7>() < b` is a < b asleep, and a <= b awake: an operand that keeps the first one.
#define AFM_MUTANT_COMPARISON(Name, op, other)                          \
  template <int kNumber>                                                \
  struct Name {                                                         \
    template <class A>                                                  \
    struct With {                                                       \
      const A& a;                                                       \
      template <class B>                                                \
      friend constexpr bool operator op(const With& with, const B& b) { \
        return is_awake<kNumber>() ? with.a other b : with.a op b;      \
      }                                                                 \
    };                                                                  \
    template <class A>                                                  \
    friend constexpr With<A> operator op(const A & a, Name) {           \
      return {a};                                                       \
    }                                                                   \
  };
AFM_MUTANT_COMPARISON(Less, <, <=)
AFM_MUTANT_COMPARISON(LessEqual, <=, <)
AFM_MUTANT_COMPARISON(Greater, >, >=)
AFM_MUTANT_COMPARISON(GreaterEqual, >=, >)
AFM_MUTANT_COMPARISON(Equal, ==, !=)
AFM_MUTANT_COMPARISON(NotEqual, !=, ==)
#undef AFM_MUTANT_COMPARISON

}  // namespace afm_mutants
