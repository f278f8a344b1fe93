// SPDX-License-Identifier: Apache-2.0
#include "core/base64.h"

#include <cstddef>
#include <cstdint>

namespace afm::core {

std::string base64(std::string_view bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t at) { return std::uint32_t{static_cast<unsigned char>(bytes[at])}; };
  const std::size_t whole = bytes.size() / 3 * 3, rest = bytes.size() - whole;
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* out = text.data();
  for (std::size_t i = 0; i < whole; i += 3) {
    const std::uint32_t word = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    *out++ = kDigits[word >> 18U];
    *out++ = kDigits[word >> 12U & 63U];
    *out++ = kDigits[word >> 6U & 63U];
    *out++ = kDigits[word & 63U];
  }
  if (rest > 0) {
    const std::uint32_t word = byte(whole) << 16U | (rest > 1 ? byte(whole + 1) << 8U : 0U);
    for (std::size_t digit = 0; digit <= rest; ++digit) *out++ = kDigits[word >> (18U - 6U * digit) & 63U];
  }
  return text;
}

}  // namespace afm::core
