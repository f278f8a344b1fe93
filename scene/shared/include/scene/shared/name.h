// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace afm::scene {

inline constexpr std::uint32_t kNameLength = 48;

using Name = std::array<char, kNameLength>;  // UTF-8, zero-terminated

// Cuts a longer text, since a name is only for display.
Name to_name(std::string_view text);

}  // namespace afm::scene
