// SPDX-License-Identifier: Apache-2.0
#include "support/pictures.h"

#include <png.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <glm/common.hpp>
#include <stdexcept>

#include "render/image_file.h"
#include "support/places.h"

namespace afm::test {
namespace {

constexpr int kTolerance = 5;           // 255ths: rounding of other compilers and vector widths
constexpr double kShareBeyond = 0.001;  // edges that fall on the other side of a sample
constexpr int kLargest = 64;            // an edge may move by one of four samples

// Differences, ten times as large.
render::Image picture_of_difference(const render::Image& a, const render::Image& b) {
  render::Image result{.width = a.width, .height = a.height, .rgba = std::vector<std::uint8_t>(a.rgba.size(), 255)};
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    if (i % 4 != 3) {
      result.rgba[i] = static_cast<std::uint8_t>(std::min(255, 10 * std::abs(int{a.rgba[i]} - int{b.rgba[i]})));
    }
  }
  return result;
}

void write_or_throw(const render::Image& image, const std::string& path) {
  if (const auto written = render::write_png(image, path); !written) {
    throw std::runtime_error(written.error().message);
  }
}

}  // namespace

Pixel pixel(const render::Image& image, std::uint32_t x, std::uint32_t y) {
  const std::size_t i = 4 * (std::size_t{y} * image.width + x);
  return {image.rgba.at(i), image.rgba.at(i + 1), image.rgba.at(i + 2)};
}

std::array<int, 3> rgb_at(const render::Image& image, std::uint32_t x, std::uint32_t y) {
  const Pixel p = pixel(image, x, y);
  return {p.r, p.g, p.b};
}

std::optional<glm::dvec2> centroid(const render::Image& image, const std::function<double(const Pixel&)>& weight) {
  glm::dvec2 sum(0.0);
  double total = 0.0;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const double w = weight(pixel(image, x, y));
      sum += w * glm::dvec2(x + 0.5, y + 0.5);
      total += w;
    }
  }
  if (total == 0.0) {
    return std::nullopt;
  }
  return sum / total;
}

std::function<double(const Pixel&)> brighter_than(int floor) {
  return [floor](const Pixel& p) { return std::max(0, p.g - floor); };
}

std::size_t count(const render::Image& image, const std::function<bool(const Pixel&)>& wanted) {
  std::size_t result = 0;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      result += wanted(pixel(image, x, y)) ? 1U : 0U;
    }
  }
  return result;
}

Difference difference(const render::Image& a, const render::Image& b, int tolerance) {
  if (a.width != b.width || a.height != b.height) {
    return {.largest = 255, .share_beyond = 1.0};
  }
  Difference result;
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int largest = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      largest = std::max(largest, std::abs(int{a.rgba[i + channel]} - int{b.rgba[i + channel]}));
    }
    result.largest = std::max(result.largest, largest);
    beyond += largest > tolerance ? 1U : 0U;
  }
  result.share_beyond = static_cast<double>(beyond) / static_cast<double>(a.rgba.size() / 4);
  return result;
}

render::Image read_png(const std::string& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) {
    throw std::runtime_error(path + ": " + png.message);
  }
  png.format = PNG_FORMAT_RGBA;
  render::Image image{.width = png.width, .height = png.height, .rgba = std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
  if (png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr) == 0) {
    throw std::runtime_error(path + ": " + png.message);
  }
  return image;
}

namespace {

// NAME.png, and those of other versions of a library: NAME-imgui-1.90.png.
std::vector<std::string> goldens_of(const std::string& name) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(support::source("tests/golden"))) {
    const std::string file = entry.path().filename().string();
    if (file == name + ".png" || file.starts_with(name + "-")) files.push_back(entry.path().string());
  }
  return files;
}

}  // namespace

std::string where_differ(const render::Image& a, const render::Image& b) {
  if (a.width != b.width || a.height != b.height) return "in size";
  if (a.rgba == b.rgba) return "";
  glm::uvec2 low(a.width, a.height), high(0);
  for (std::uint32_t y = 0; y < a.height; ++y) {
    for (std::uint32_t x = 0; x < a.width; ++x) {
      const std::size_t at = std::size_t{4} * (std::size_t{y} * a.width + x);
      if (std::equal(&a.rgba[at], &a.rgba[at] + 4, &b.rgba[at])) continue;
      low = glm::min(low, glm::uvec2(x, y));
      high = glm::max(high, glm::uvec2(x, y));
    }
  }
  return "from " + std::to_string(low.x) + ", " + std::to_string(low.y) + " to " + std::to_string(high.x) + ", " +
         std::to_string(high.y) + " of " + std::to_string(a.width) + " x " + std::to_string(a.height);
}

std::string compare_with_golden(const render::Image& actual, const std::string& name) {
  const std::string golden = support::source("tests/golden/") + name + ".png";
  if (const char* update = std::getenv("AFM_UPDATE_GOLDEN"); update != nullptr && std::string(update) == "1") {
    write_or_throw(actual, golden);
    return {};
  }
  for (const std::string& each : goldens_of(name)) {
    const Difference found = difference(actual, read_png(each), kTolerance);
    if (found.share_beyond <= kShareBeyond && found.largest <= kLargest) return {};
  }
  const render::Image expected = read_png(golden);
  const Difference found = difference(actual, expected, kTolerance);
  const std::string folder = support::built("golden/");
  std::filesystem::create_directories(folder);
  write_or_throw(actual, folder + name + "-actual.png");
  write_or_throw(expected, folder + name + "-expected.png");
  if (actual.rgba.size() == expected.rgba.size()) {
    write_or_throw(picture_of_difference(actual, expected), folder + name + "-difference.png");
  }
  return name + ": largest difference " + std::to_string(found.largest) + "/255, " +
         std::to_string(100.0 * found.share_beyond) + " % of the pixels beyond " + std::to_string(kTolerance) +
         "/255; see " + folder + ", or set AFM_UPDATE_GOLDEN=1 if the new picture is right";
}

}  // namespace afm::test
