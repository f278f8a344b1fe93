// SPDX-License-Identifier: Apache-2.0
#include "cluster/frame_message.h"

#include <algorithm>

namespace afm::cluster {

namespace {

// Length of at most `most` bytes that does not cut a character in two.
std::size_t whole_characters(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text.size();
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) --most;
  return most;
}

}  // namespace

std::vector<std::string> ShownTexts::list() const {
  std::vector<std::string> texts;
  std::size_t used = 0;
  for (auto begin = bytes.begin(); begin != bytes.end();) {
    const auto end = std::find(begin, bytes.end(), '\0');
    texts.emplace_back(begin, end);
    if (!texts.back().empty()) used = texts.size();
    begin = end == bytes.end() ? end : end + 1;
  }
  texts.resize(used);
  return texts;
}

void ShownTexts::set(std::span<const std::string> texts) {
  bytes = {};
  std::size_t at = 0;
  for (const std::string& text : texts) {
    if (at + 1 >= kBytes) return;
    const std::size_t length = whole_characters(text, kBytes - at - 1);
    std::copy_n(text.begin(), length, bytes.begin() + static_cast<std::ptrdiff_t>(at));
    at += length + 1;
  }
}

}  // namespace afm::cluster
