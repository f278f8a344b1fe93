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

// Reads short texts from a TOML file of `key = "text"`, so that they can be translated: exactly these keys, each with a
// line of 1 to kLongestPhrase characters. In the order of the keys. The error names file, line and key. Any thread.
core::Result<std::vector<std::string>> load_messages(const std::string& path, std::span<const std::string_view> keys);

}  // namespace afm::exhibit
