// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/film_strip.h"

#include "core/check.h"

namespace afm::exhibit {

render::Image film_strip(std::span<const render::Image> frames, std::uint32_t columns, std::uint32_t factor) {
  AFM_CHECK(!frames.empty() && columns > 0 && factor > 0);
  const std::uint32_t width = frames.front().width / factor, height = frames.front().height / factor;
  const auto rows = static_cast<std::uint32_t>((frames.size() + columns - 1) / columns);
  render::Image strip{.width = columns * width, .height = rows * height, .rgba = {}};
  strip.rgba.resize(std::size_t{4} * strip.width * strip.height, 0);
  const auto byte_of = [](const render::Image& image, std::size_t x, std::size_t y, std::size_t channel) {
    return 4 * (y * image.width + x) + channel;
  };
  const std::uint32_t weight = factor * factor;
  for (std::uint32_t y = 0; y < strip.height; ++y) {
    for (std::uint32_t x = 0; x < strip.width; ++x) {
      const std::size_t index = std::size_t{y / height} * columns + x / width;
      if (index >= frames.size()) continue;
      const render::Image& frame = frames[index];
      for (std::size_t channel = 0; channel < 4; ++channel) {
        std::uint32_t sum = weight / 2;
        for (std::uint32_t i = 0; i < weight; ++i) {
          sum += frame.rgba[byte_of(frame, x % width * factor + i % factor, y % height * factor + i / factor, channel)];
        }
        strip.rgba[byte_of(strip, x, y, channel)] = static_cast<std::uint8_t>(sum / weight);
      }
    }
  }
  return strip;
}

}  // namespace afm::exhibit
