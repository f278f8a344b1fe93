// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace afm::support {

// A block of a Markdown page between lines that begin with ```.
struct FencedBlock {
  std::string language;
  std::string text;
  std::size_t begin = 0;  // index of its first character in the page
};

inline std::vector<FencedBlock> fenced_blocks(const std::string& page) {
  constexpr std::string_view kFence = "\n```";
  std::vector<FencedBlock> blocks;
  for (std::size_t fence = page.find(kFence); fence != std::string::npos;) {
    const std::size_t language = fence + kFence.size();
    const std::size_t line_end = page.find('\n', language);
    const std::size_t end = page.find(kFence, line_end);
    if (end == std::string::npos) break;
    blocks.push_back(
        {page.substr(language, line_end - language), page.substr(line_end + 1, end - line_end), line_end + 1});
    fence = page.find(kFence, end + kFence.size());
  }
  return blocks;
}

// Text of the first block of this language that begins with these words; empty if there is none.
inline std::string fenced_block(const std::string& page, std::string_view language, std::string_view words = {}) {
  const std::vector<FencedBlock> blocks = fenced_blocks(page);
  const auto found = std::find_if(blocks.begin(), blocks.end(), [&](const FencedBlock& block) {
    return block.language == language && std::string_view(block.text).substr(0, words.size()) == words;
  });
  return found == blocks.end() ? std::string() : found->text;
}

}  // namespace afm::support
