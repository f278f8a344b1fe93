// SPDX-License-Identifier: Apache-2.0
#include "app/options/pixel_size_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

namespace afm::app {

namespace {

std::optional<std::uint32_t> whole_number(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool legal(std::uint32_t pixels, const std::optional<PixelRange>& range) {
  return !range || (pixels >= range->least && pixels <= range->most);
}

}  // namespace

std::optional<glm::uvec2> parse_pixel_size(std::string_view text) {
  constexpr std::array<std::string_view, 3> kCrosses{"x", "X", "\u00d7"};
  const auto crossed = std::find_if(kCrosses.begin(), kCrosses.end(),
                                    [&](std::string_view each) { return text.find(each) != std::string_view::npos; });
  if (crossed == kCrosses.end()) return std::nullopt;
  const std::size_t at = text.find(*crossed);
  const auto width = whole_number(text.substr(0, at)), height = whole_number(text.substr(at + crossed->size()));
  if (!width || !height) return std::nullopt;
  return glm::uvec2(*width, *height);
}

Option pixel_size_option(OptionList& command, const std::string& name, std::optional<glm::uvec2>& size_px,
                         const std::string& description, std::optional<PixelRange> range) {
  const std::string legal_values = range ? fmt::format("{} to {} each", range->least, range->most) : "";
  const auto read = [&size_px, range, legal_values](const std::string& text) -> core::Result<void> {
    const auto size = parse_pixel_size(text);
    if (!size || !legal(size->x, range) || !legal(size->y, range)) {
      return core::failure(core::ErrorCategory::WrongUsage,
                           fmt::format("\"{}\" is not WIDTHxHEIGHT in pixels{}, such as 1280x720", text,
                                       legal_values.empty() ? "" : " of " + legal_values));
    }
    size_px = *size;
    return {};
  };
  return command.add_parsed_option(name, read, description)
      .type_name("WIDTHxHEIGHT" + (legal_values.empty() ? "" : " from " + legal_values));
}

}  // namespace afm::app
