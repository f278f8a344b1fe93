// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <utility>

namespace afm::exhibit {

// Random numbers of a lesson, equal for a seed on every machine, which the distributions of std do not guarantee. One
// thread.
class LessonRandom {
 public:
  explicit LessonRandom(std::uint64_t seed) : bits_(seed) {}

  // Uniform random number from 0 to below 1.
  double unit() { return static_cast<double>(bits_() >> 11U) * 0x1p-53; }

  // Uniform integer from 0 to below `count`, which must be at least 1 and far below 2^53.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }

  // Shuffles by the method of Fisher and Yates.
  template <class Value>
  void shuffle(std::span<Value> values) {
    for (std::size_t left = values.size(); left > 1; --left) std::swap(values[left - 1], values[below(left)]);
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace afm::exhibit
