// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <type_traits>

// Description of the fields of a block of the shared scene, and the only list of them:
//
//   template <class Visit, std::same_as<Tip>... Record>
//   constexpr void for_each_field(Visit&& visit, const Record&... tip) {
//     visit("z_m", tip.z_m...);
//     ...
//
// With one record it visits the values, with two it visits them in pairs. `all_fields_described` fails to compile if a
// field was forgotten.
namespace afm::scene {

template <class T>
concept Described = requires(const T& record) { for_each_field([](const char*, const auto&) {}, record); };

// Same, but descends into fields that are blocks themselves: visits only numbers, enumerators and arrays.
template <class Visit, class... Record>
constexpr void for_each_leaf(Visit&& visit, const Record&... records) {
  for_each_field(
      [&](const char* name, const auto&... values) {
        if constexpr ((Described<std::remove_cvref_t<decltype(values)>> && ...)) {
          for_each_leaf(visit, values...);
        } else {
          visit(name, values...);
        }
      },
      records...);
}

// Blocks have no hidden padding: their fields fill them.
template <Described Record>
constexpr bool all_fields_described() {
  std::size_t bytes = 0;
  for_each_field([&](const char*, const auto& value) { bytes += sizeof(value); }, Record{});
  return bytes == sizeof(Record);
}

}  // namespace afm::scene
