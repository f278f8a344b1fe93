// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace afm::core {

// 64-bit FNV-1a (Fowler, Noll, Vo; draft-eastlake-fnv, section 5), byte by byte.
class Fnv1a {
 public:
  constexpr void add(unsigned char byte) { value_ = (value_ ^ byte) * 0x100000001B3ULL; }
  constexpr std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

constexpr std::uint64_t fnv1a(std::string_view bytes) {
  Fnv1a hash;
  for (const char byte : bytes) hash.add(static_cast<unsigned char>(byte));
  return hash.value();
}

}  // namespace afm::core
