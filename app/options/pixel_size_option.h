// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "app/options/command_line.h"

namespace afm::app {

// Both ends are legal, each way.
struct PixelRange {
  std::uint32_t least, most;
};

// None unless it is WIDTHxHEIGHT, two whole numbers.
std::optional<glm::uvec2> parse_pixel_size(std::string_view text);

// An option whose value is the size of a picture or a window. Help and refusal give the range if there is one.
Option pixel_size_option(OptionList& command, const std::string& name, std::optional<glm::uvec2>& size_px,
                         const std::string& description, std::optional<PixelRange> range = std::nullopt);

}  // namespace afm::app
