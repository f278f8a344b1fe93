// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

namespace afm::fits {

// Two numbers that a processor adds, multiplies or divides at once. A compiler at -O2 does not find such pairs itself.
using Two = double __attribute__((vector_size(2 * sizeof(double))));

inline Two two_at(const double* values) {
  Two two;
  std::memcpy(&two, values, sizeof two);
  return two;
}

inline double sum_of(Two two) { return two[0] + two[1]; }

// Calls f(0) to f(count - 1) without a loop, so that arrays of that length stay in registers.
template <std::size_t count, class F>
void unrolled(F&& f) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (f(std::integral_constant<std::size_t, i>{}), ...);
  }(std::make_index_sequence<count>{});
}

}  // namespace afm::fits
