// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace afm::exhibit {

// No phrase is longer: it has to fit on a line of the wall.
inline constexpr std::size_t kLongestPhrase = 90;  // characters

struct MessageKeys {
  std::span<const std::string_view> keys{};
  std::span<const std::string_view> optional_keys{};  // empty where the file lacks them
  std::span<const std::string_view> places{};         // "{up}": the only words in braces that a text may hold
};

// Reads short texts from a TOML file of `key = "text"`, so that they can be translated: these keys and no others, each
// with a line of 1 to kLongestPhrase characters. In the order of the keys, the optional ones last. The error names
// file, line and key. Any thread.
core::Result<std::vector<std::string>> load_messages(const std::string& path, const MessageKeys& keys);

}  // namespace afm::exhibit
