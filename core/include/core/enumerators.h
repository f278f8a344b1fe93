// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>

// Enumerators of an enum class, counted by the compiler. No count has to be kept next to the enum, and a static_assert
// can tie a table with one row each to it. Finds values from 0 to kMostEnumerators - 1; gaps are allowed.
namespace afm::core {

inline constexpr std::size_t kMostEnumerators = 32;

// Both compilers print an unnamed value as a cast, "(Color)7". Clang omits the value from a source_location.
template <auto value>
consteval bool has_name() {
  const std::string_view function = __PRETTY_FUNCTION__;
  const std::string_view spelled = function.substr(function.rfind("value = "));
  const std::size_t bracket = spelled.rfind(')');
  return bracket == std::string_view::npos || spelled[bracket + 1] == ':';  // "(anonymous namespace)::Color::Red"
}

template <class Enum>
consteval auto named_values() {
  static_assert(std::is_enum_v<Enum>);
  return []<std::size_t... index>(std::index_sequence<index...>) {
    return std::array<bool, kMostEnumerators>{has_name<static_cast<Enum>(index)>()...};
  }(std::make_index_sequence<kMostEnumerators>());
}

template <class Enum>
consteval auto find_enumerators() {
  constexpr auto named = named_values<Enum>();
  static_assert(!named.back(), "an enumerator may lie beyond kMostEnumerators");
  std::array<Enum, static_cast<std::size_t>(std::count(named.begin(), named.end(), true))> found{};
  std::size_t count = 0;
  for (std::size_t value = 0; value < named.size(); ++value) {
    if (named[value]) found[count++] = static_cast<Enum>(value);
  }
  return found;
}

// Enumerators of an enum, sorted by value.
template <class Enum>
inline constexpr auto kEnumerators = find_enumerators<Enum>();

// False for a value without an enumerator, as it may come from outside.
template <class Enum>
constexpr bool is_enumerator(Enum value) {
  return std::find(kEnumerators<Enum>.begin(), kEnumerators<Enum>.end(), value) != kEnumerators<Enum>.end();
}

// Position in kEnumerators, and in any table that satisfies has_row_for_each(). Valid for enumerators only.
template <class Enum>
constexpr std::size_t index_of(Enum value) {
  return static_cast<std::size_t>(std::find(kEnumerators<Enum>.begin(), kEnumerators<Enum>.end(), value) -
                                  kEnumerators<Enum>.begin());
}

// True if a table has one row for each enumerator, in the same order. `key` is the member with the enumerator.
template <class Rows, class Row, class Enum>
constexpr bool has_row_for_each(const Rows& rows, Enum Row::* key) {
  return std::equal(rows.begin(), rows.end(), kEnumerators<Enum>.begin(), kEnumerators<Enum>.end(),
                    [key](const Row& row, Enum value) { return row.*key == value; });
}

}  // namespace afm::core
