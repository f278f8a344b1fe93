// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

// The members of an aggregate without bases and C arrays, counted and visited by the compiler, so that no list of them
// can lack one.
namespace afm::core {

// Converts to any type, so that an aggregate can be tried with a number of initializers.
struct AnyMember {
  template <class Member>
  constexpr operator Member() const {  // NOLINT(google-explicit-constructor): an initializer is converted implicitly
    return Member{};
  }
};

template <class Record, std::size_t... index>
consteval bool takes_members(std::index_sequence<index...> /*count*/) {
  return requires { Record{(static_cast<void>(index), AnyMember{})...}; };
}

template <class Record, std::size_t found = 0>
consteval std::size_t count_members() {
  static_assert(std::is_aggregate_v<Record>);
  if constexpr (takes_members<Record>(std::make_index_sequence<found + 1>())) {
    return count_members<Record, found + 1>();
  } else {
    return found;
  }
}

template <class Record>
inline constexpr std::size_t kMembers = count_members<std::remove_const_t<Record>>();

// References to the members, in their order.
template <class Record>
constexpr auto members_of(Record& record) {
  constexpr std::size_t kCount = kMembers<Record>;
  static_assert(kCount >= 1 && kCount <= 17, "members_of() needs a case for so many members");
  if constexpr (kCount == 1) {
    auto& [a] = record;
    return std::tie(a);
  } else if constexpr (kCount == 2) {
    auto& [a, b] = record;
    return std::tie(a, b);
  } else if constexpr (kCount == 3) {
    auto& [a, b, c] = record;
    return std::tie(a, b, c);
  } else if constexpr (kCount == 4) {
    auto& [a, b, c, d] = record;
    return std::tie(a, b, c, d);
  } else if constexpr (kCount == 5) {
    auto& [a, b, c, d, e] = record;
    return std::tie(a, b, c, d, e);
  } else if constexpr (kCount == 6) {
    auto& [a, b, c, d, e, f] = record;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (kCount == 7) {
    auto& [a, b, c, d, e, f, g] = record;
    return std::tie(a, b, c, d, e, f, g);
  } else if constexpr (kCount == 8) {
    auto& [a, b, c, d, e, f, g, h] = record;
    return std::tie(a, b, c, d, e, f, g, h);
  } else if constexpr (kCount == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = record;
    return std::tie(a, b, c, d, e, f, g, h, i);
  } else if constexpr (kCount == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (kCount == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (kCount == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (kCount == 13) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m);
  } else if constexpr (kCount == 14) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  } else if constexpr (kCount == 15) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  } else if constexpr (kCount == 16) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
  } else {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = record;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q);
  }
}

// Visits each member of a record, or of records of the same type side by side.
template <class Visit, class Record, class... Records>
constexpr void for_each_member(Visit&& visit, Record& record, Records&... records) {
  [&]<std::size_t... index>(std::index_sequence<index...>) {
    const auto visit_one = [&]<std::size_t at>(std::integral_constant<std::size_t, at>, const auto&... members) {
      visit(std::get<at>(members)...);
    };
    (visit_one(std::integral_constant<std::size_t, index>(), members_of(record), members_of(records)...), ...);
  }(std::make_index_sequence<kMembers<Record>>());
}

}  // namespace afm::core
