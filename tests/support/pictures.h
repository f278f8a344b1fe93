// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "render/frame.h"

// Measurements of pictures for tests.
namespace afm::test {

struct Pixel {
  int r = 0, g = 0, b = 0;
};
Pixel pixel(const render::Image& image, std::uint32_t x, std::uint32_t y);
std::array<int, 3> rgb_at(const render::Image& image, std::uint32_t x, std::uint32_t y);

// Middle of the pixels weighted by `weight`, in pixels from the top left corner; empty if all weights are 0.
std::optional<glm::dvec2> centroid(const render::Image& image, const std::function<double(const Pixel&)>& weight);

// Weight of a pixel: its brightness above `floor`, for grey objects in front of the background.
std::function<double(const Pixel&)> brighter_than(int floor);

std::size_t count(const render::Image& image, const std::function<bool(const Pixel&)>& wanted);

struct Difference {
  int largest = 0;          // largest difference of any channel, in 255ths
  double share_beyond = 0;  // fraction of the pixels with a channel that differs by more than the tolerance
};
Difference difference(const render::Image& a, const render::Image& b, int tolerance);

// Rectangle in which two pictures differ; empty if they are equal.
std::string where_differ(const render::Image& a, const render::Image& b);

render::Image read_png(const std::string& path);  // throws std::runtime_error

// Compares with tests/golden/<name>.png and <name>-*.png, of which one must match: at most 0.1 % of the
// pixels may differ by more than 5/255 in a channel, and none by more than 64/255. On failure <name>-actual.png,
// -expected.png and -difference.png are left in the build tree's golden/ folder, and the text says so; empty if alike.
// With AFM_UPDATE_GOLDEN=1 it writes the golden picture instead.
std::string compare_with_golden(const render::Image& actual, const std::string& name);

}  // namespace afm::test
