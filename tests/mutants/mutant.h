// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <type_traits>

// warnings that an edit may well cause
#pragma GCC diagnostic ignored "-Wparentheses"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wbool-compare"
#pragma GCC diagnostic ignored "-Wbool-operation"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-value"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wunused-but-set-parameter"
#pragma GCC diagnostic ignored "-Wunused-const-variable"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wint-in-bool-context"
#pragma GCC diagnostic ignored "-Wtautological-compare"
#pragma GCC diagnostic ignored "-Wtype-limits"
#pragma GCC diagnostic ignored "-Waddress"
#pragma GCC diagnostic ignored "-Wempty-body"
#pragma GCC diagnostic ignored "-Wreturn-type"
#pragma GCC diagnostic ignored "-Wdiv-by-zero"
#pragma GCC diagnostic ignored "-Wshadow"

// Code that scripts/drawn_mutants.py puts into a copy of the sources, so that one build holds many edits. Each sleeps
// unless the environment names it by AFM_MUTANT=<number>. The file named by AFM_MUTANT_REACHED gets a mark at the
// number of each edit that the program reaches. Only such copies include this.
namespace afm_mutants {

inline constexpr int kMarks = 4096;

struct State {
  int awake = -1;
  unsigned char* marks = nullptr;

  State() {
    if (const char* number = std::getenv("AFM_MUTANT")) awake = std::atoi(number);
    const char* path = std::getenv("AFM_MUTANT_REACHED");
    const int file = path == nullptr ? -1 : ::open(path, O_RDWR | O_CLOEXEC);
    if (file < 0) return;
    void* memory = ::mmap(nullptr, kMarks, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (memory != MAP_FAILED) marks = static_cast<unsigned char*>(memory);
  }
};

inline const State& state() {
  static const State state;
  return state;
}

// set at the start, before a process gives up its rights
inline const State& kAtTheStart = state();

// True for an active edit. Expressions evaluated by the compiler stay unchanged.
template <int kNumber>
constexpr bool is_awake() {
  static_assert(kNumber < kMarks);
  if (std::is_constant_evaluated()) return false;
  const State& now = state();
  if (now.marks != nullptr) now.marks[kNumber] = 1;
  return now.awake == kNumber;
}

// `c * factor<7, 0>()`: c, or c times the second number.
template <int kNumber, int kFactor>
constexpr int factor() {
  return is_awake<kNumber>() ? kFactor : 1;
}

// Same for a former constant of the compiler, which would evaluate the expression above while it sleeps.
template <int kNumber, int kFactor>
int factor_at_run_time() {
  return is_awake<kNumber>() ? kFactor : 1;
}

// `a + Sign<7, -1>() * b` is a - b asleep, and a + b awake; `a + Sign<7, 1>() * b` the other way round.
template <int kNumber, int kAsleep>
struct Sign {
  template <class T>
  friend constexpr auto operator*(Sign, const T& b) {
    return (is_awake<kNumber>() ? -kAsleep : kAsleep) < 0 ? -b : -(-b);  // units have no unary +
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
