// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "core/members.h"

// Description of the fields of a block of the shared scene, or of the state of the wall: the only list of their names.
//
//   template <class Visit, RecordOf<Tip>... Record>
//   constexpr void for_each_field(Visit&& visit, Record&... tip) {
//     visit("z_m", tip.z_m...);
//     ...
//
// With one record it visits the values, with two it visits them in pairs. `all_fields_described` fails to compile if a
// field was forgotten.
namespace afm::scene {

template <class Record, class Block>
concept RecordOf = std::same_as<std::remove_const_t<Record>, Block>;

template <class T>
concept Described = requires(const T& record) { for_each_field([](const char*, const auto&) {}, record); };

// Same as for_each_field(), but descends into fields that are blocks: visits only numbers, enumerators and arrays.
template <class Visit, class... Record>
constexpr void for_each_leaf(Visit&& visit, Record&... records) {
  for_each_field(
      [&](const char* name, auto&... values) {
        if constexpr ((Described<std::remove_cvref_t<decltype(values)>> && ...)) {
          for_each_leaf(visit, values...);
        } else {
          visit(name, values...);
        }
      },
      records...);
}

// Storage of a record that is never constructed, so that its fields can be named in a constant expression.
template <class Record>
union UnmadeRecord {
  char none;
  Record record;
  constexpr UnmadeRecord() : none(0) {}
  constexpr ~UnmadeRecord() {}
};

// True if for_each_field() visits every field. The fields of a shared block fill it, since it has no hidden
// padding; of any other record as many fields must be described as it has members.
template <class Record>
constexpr bool all_fields_described() {
  if constexpr (std::is_trivially_copyable_v<Record>) {
    const Record record{};
    std::size_t bytes = 0;
    // array of one, since clang-tidy mistakes the bare size of a pointer for a slip
    for_each_field([&]<class Value>(const char*, const Value&) { bytes += sizeof(std::array<Value, 1>); }, record);
    if (bytes == sizeof(Record)) return true;
  }
  std::size_t count = 0;
  const UnmadeRecord<Record> unmade;
  for_each_field([&](const char*, const auto&) { ++count; }, unmade.record);
  return count == core::kMembers<Record>;
}

}  // namespace afm::scene
