// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "app/options/command_line.h"

namespace afm::app {

// Limits of a width or height in pixels; both ends are legal.
struct PixelRange {
  std::uint32_t least, most;
};

// Empty unless the text is WIDTHxHEIGHT, two whole numbers.
std::optional<glm::uvec2> parse_pixel_size(std::string_view text);

// Adds an option whose value is the size of a picture or window. Help and error show the range if there is one.
Option pixel_size_option(OptionList& command, const std::string& name, std::optional<glm::uvec2>& size_px,
                         const std::string& description, std::optional<PixelRange> range = std::nullopt);

}  // namespace afm::app
