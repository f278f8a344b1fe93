// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>

// A copy of core/enumerators.h for physics, which depends only on the standard library: ties a table to an enum whose
// values run from 0 without a gap, so that an enumerator without a row does not compile.
namespace afm::physics {

// Both compilers print a value without an enumerator as a cast, "(Color)7".
template <auto value>
consteval bool is_named() {
  const std::string_view function = __PRETTY_FUNCTION__;
  const std::string_view spelled = function.substr(function.rfind("value = "));
  const std::size_t bracket = spelled.rfind(')');
  return bracket == std::string_view::npos || spelled[bracket + 1] == ':';  // "(anonymous namespace)::Color::Red"
}

template <class Enum>
consteval std::size_t count_enumerators() {
  static_assert(std::is_enum_v<Enum>);
  return []<std::size_t... value>(std::index_sequence<value...>) {
    return (std::size_t{0} + ... + (is_named<static_cast<Enum>(value)>() ? 1U : 0U));
  }(std::make_index_sequence<32>());
}

// Returns whether a table has one row per enumerator, in order. `key` is the member with the enumerator.
template <class Rows, class Row, class Enum>
consteval bool has_row_for_each(const Rows& rows, Enum Row::* key) {
  if (rows.size() != count_enumerators<Enum>()) return false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].*key != static_cast<Enum>(i)) return false;
  }
  return true;
}

}  // namespace afm::physics
