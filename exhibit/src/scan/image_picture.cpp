// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/image_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "exhibit/models/height_colours.h"
#include "physics/quantity_text.h"

namespace afm::exhibit {
namespace {

using Color = Srgb;

constexpr Color kPaper{24, 26, 30}, kInk{235, 235, 235};
constexpr std::uint32_t kSmallestSide = 256, kPictureMargin = 12, kRangeBarWidth = 16, kRangeLabelWidth = 100,
                        kPictureFooter = 44;

// Glyph of three columns of five dots, the top row in the highest bits.
struct Glyph {
  char letter;
  std::uint16_t dots;
};
constexpr std::array kGlyphs{
    Glyph{'0', 0b111'101'101'101'111}, Glyph{'1', 0b010'110'010'010'111}, Glyph{'2', 0b111'001'111'100'111},
    Glyph{'3', 0b111'001'111'001'111}, Glyph{'4', 0b101'101'111'001'001}, Glyph{'5', 0b111'100'111'001'111},
    Glyph{'6', 0b111'100'111'101'111}, Glyph{'7', 0b111'001'010'010'010}, Glyph{'8', 0b111'101'111'101'111},
    Glyph{'9', 0b111'101'111'001'111}, Glyph{'.', 0b000'000'000'000'010}, Glyph{'-', 0b000'000'111'000'000},
    Glyph{'n', 0b000'110'101'101'101}, Glyph{'m', 0b000'111'111'101'101}, Glyph{'p', 0b000'110'101'110'100},
    Glyph{'u', 0b000'101'101'101'110}, Glyph{'N', 0b101'111'111'111'101}, Glyph{'e', 0b000'111'111'100'111},
    Glyph{'P', 0b110'101'110'100'100}, Glyph{'a', 0b000'110'011'101'111}, Glyph{'k', 0b100'101'110'101'101},
    Glyph{'M', 0b101'111'101'101'101}, Glyph{'G', 0b011'100'101'101'011}, Glyph{'f', 0b011'010'111'010'010},
};

class Canvas {
 public:
  Canvas(std::uint32_t width, std::uint32_t height) {
    image_.width = width;
    image_.height = height;
    image_.rgba.assign(std::size_t{4} * width * height, 255);
    fill(0, 0, width, height, kPaper);
  }

  void dot(std::uint32_t x, std::uint32_t y, const Color& color) {
    if (x >= image_.width || y >= image_.height) return;
    std::copy(color.begin(), color.end(),
              image_.rgba.begin() + 4 * static_cast<std::ptrdiff_t>(std::size_t{y} * image_.width + x));
  }

  void fill(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height, const Color& color) {
    for (std::uint32_t row = 0; row < height; ++row) {
      for (std::uint32_t column = 0; column < width; ++column) dot(x + column, y + row, color);
    }
  }

  // Stripes that run on from one square to the next.
  void hatch(std::uint32_t left, std::uint32_t top, std::uint32_t side) {
    constexpr std::uint32_t kStripes = 6;  // pixels from one stripe to the next
    for (std::uint32_t y = top; y < top + side; ++y) {
      for (std::uint32_t x = left; x < left + side; ++x) {
        if ((x + y) % kStripes == 0) dot(x, y, kPaper);
      }
    }
  }

  void text(std::uint32_t x, std::uint32_t y, std::string_view letters) {
    constexpr std::uint32_t kDot = 2, kColumns = 3, kRows = 5;
    for (const char letter : letters) {
      const auto glyph =
          std::find_if(kGlyphs.begin(), kGlyphs.end(), [&](const Glyph& g) { return g.letter == letter; });
      for (std::uint32_t bit = 0; glyph != kGlyphs.end() && bit < kColumns * kRows; ++bit) {
        const bool set = (glyph->dots >> (kColumns * kRows - 1 - bit) & 1) != 0;
        if (set) fill(x + bit % kColumns * kDot, y + bit / kColumns * kDot, kDot, kDot, kInk);
      }
      x += (kColumns + 1) * kDot;
    }
  }

  render::Image take() { return std::move(image_); }

 private:
  render::Image image_;
};

struct ValueRange {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  double share(double value) const {
    return most > least ? std::clamp((value - least) / (most - least), 0.0, 1.0) : 0.5;
  }
};

// Range of the values without this fraction at each end.
ValueRange value_range_of(std::vector<double> values, double cut_share) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto cut = static_cast<std::size_t>(cut_share * static_cast<double>(values.size()));
  return {values[cut], values[values.size() - 1 - cut]};
}

std::string value_label(double value, const std::string& unit) {
  constexpr int kDigits = 3;
  if (!std::isfinite(value)) return "";
  if (unit == "m") return physics::format_quantity(physics::Length(value), physics::kLengthUnits, kDigits);
  if (unit == "N") return physics::format_quantity(physics::Force(value), physics::kForceUnits, kDigits);
  if (unit == "Pa") return physics::format_quantity(physics::Pressure(value), physics::kPressureUnits, kDigits);
  return physics::format_si(value, physics::kPlainNumber.units, kDigits);
}

// Longest length of 1, 2 or 5 times a power of ten that is at most a third of the width.
double round_length_m(double width_m) {
  const double third_m = width_m / 3.0, decade_m = std::pow(10.0, std::floor(std::log10(third_m)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade_m <= third_m) return factor * decade_m;
  }
  return decade_m;
}

}  // namespace

render::Image picture_of(const physics::ScanImage& image, std::size_t channel, const PictureStyle& style) {
  const physics::ImageChannel& shown = image.channels[channel];
  const ValueRange range = value_range_of(shown.values, style.cut_share);
  const auto columns = static_cast<std::uint32_t>(image.columns), rows = static_cast<std::uint32_t>(image.rows);
  const std::uint32_t zoom = std::max(1U, (kSmallestSide + columns - 1) / columns);
  const std::uint32_t width = zoom * columns, height = zoom * rows;
  Canvas canvas(width + 3 * kPictureMargin + kRangeBarWidth + kRangeLabelWidth,
                height + kPictureMargin + kPictureFooter);
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double value = shown.values[std::size_t{row} * columns + column];
      const std::uint32_t x = kPictureMargin + zoom * column, y = kPictureMargin + zoom * row;
      canvas.fill(x, y, zoom, zoom, height_colour(std::isfinite(value) ? range.share(value) : value));
      if (!style.hatched.empty() && style.hatched[std::size_t{row} * columns + column]) canvas.hatch(x, y, zoom);
    }
  }

  const std::uint32_t bar_x = width + 2 * kPictureMargin, label_x = bar_x + kRangeBarWidth + kPictureMargin / 2;
  for (std::uint32_t y = 0; y < height; ++y) {
    canvas.fill(bar_x, kPictureMargin + y, kRangeBarWidth, 1,
                height_colour(1.0 - static_cast<double>(y) / std::max(1U, height - 1)));
  }
  constexpr std::uint32_t kLetterHeight = 10;
  canvas.text(label_x, kPictureMargin, value_label(range.most, shown.unit));
  canvas.text(label_x, kPictureMargin + height - kLetterHeight, value_label(range.least, shown.unit));

  const double length_m = round_length_m(image.width_m);
  canvas.fill(kPictureMargin, kPictureMargin + height + kPictureMargin / 2,
              static_cast<std::uint32_t>(width * length_m / image.width_m), 4, kInk);
  canvas.text(kPictureMargin, 2 * kPictureMargin + height + kPictureMargin / 2, value_label(length_m, "m"));
  return canvas.take();
}

std::vector<std::pair<std::string, std::string>> picture_texts(const physics::ScanImage& image, std::size_t channel) {
  const physics::ImageChannel& shown = image.channels.at(channel);
  const auto length = [](double si) { return physics::format_quantity(physics::Length(si), physics::kLengthUnits); };
  std::vector<std::pair<std::string, std::string>> texts{
      {"Title", shown.unit.empty() ? shown.name : shown.name + " in " + shown.unit},
      {"Width", length(image.width_m)},
      {"Height", length(image.height_m)}};
  texts.insert(texts.end(), image.metadata.begin(), image.metadata.end());
  return texts;
}

}  // namespace afm::exhibit
