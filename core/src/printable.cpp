// SPDX-License-Identifier: Apache-2.0
#include "core/printable.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace afm::core {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

// UTF-8 sequence of one length: its first byte under a mask, and the smallest character that needs that many bytes.
struct Form {
  std::size_t bytes;
  unsigned char mask, first;
  std::uint32_t least;
};
constexpr std::array kForms{Form{1, 0x80, 0x00, 0x00}, Form{2, 0xE0, 0xC0, 0x80}, Form{3, 0xF0, 0xE0, 0x800},
                            Form{4, 0xF8, 0xF0, 0x10000}};

bool is_control(std::uint32_t character) {
  return (character < 0x20 && character != '\n' && character != '\t') || (character >= 0x7F && character < 0xA0);
}

// Length in bytes of the first character if it may be shown; 0 otherwise.
std::size_t shown_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  for (const Form& form : kForms) {
    if ((byte(0) & form.mask) != form.first) continue;
    if (text.size() < form.bytes) return 0;
    std::uint32_t character = byte(0) & static_cast<unsigned char>(~form.mask);
    for (std::size_t i = 1; i < form.bytes; ++i) {
      if ((byte(i) & 0xC0U) != 0x80U) return 0;
      character = character << 6U | (byte(i) & 0x3FU);
    }
    const bool surrogate = character >= 0xD800 && character <= 0xDFFF;
    return character < form.least || character > 0x10FFFF || surrogate || is_control(character) ? 0 : form.bytes;
  }
  return 0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const std::size_t bytes = shown_bytes(text);
    shown += bytes > 0 ? text.substr(0, bytes) : kReplacement;
    text.remove_prefix(bytes > 0 ? bytes : 1);
  }
  return shown;
}

std::string printable_line(std::string_view text) {
  std::string line = printable(text);
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::replace(line.begin(), line.end(), '\t', ' ');
  return line;
}

std::size_t count_characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace afm::core
