// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "curves/curve_error.h"

// Numbers and parts of a file in memory. Access beyond its end is an error and reads nothing.
namespace afm::curves {

inline std::string_view part(std::string_view bytes, std::size_t offset, std::size_t size) {
  if (offset > bytes.size() || size > bytes.size() - offset) throw CutShort();
  return bytes.substr(offset, size);
}

// The number of type T at `offset`, stored in this byte order.
template <class T>
T number_at(std::string_view bytes, std::size_t offset, std::endian order = std::endian::little) {
  const std::string_view there = part(bytes, offset, sizeof(T));
  char reversed[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    reversed[i] = there[order == std::endian::native ? i : sizeof(T) - 1 - i];
  }
  T value{};
  std::memcpy(&value, reversed, sizeof(T));
  return value;
}

}  // namespace afm::curves
