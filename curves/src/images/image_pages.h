// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bytes/scaled_unit.h"
#include "curves/curve_error.h"
#include "curves/image_file.h"

namespace afm::curves {

// One channel of an image file, checked by its reader, with the numbers still unread.
struct ImagePage {
  std::string name;
  std::string unit;  // SI unit, see physics::ImageChannel
  std::size_t columns = 0;
  std::size_t rows = 0;
  double width_m = 0;
  double height_m = 0;
  double x_offset_m = 0;
  double y_offset_m = 0;
  std::function<std::vector<double>()> values;  // values from the top row on; refers to the file's bytes
};

struct ImagePages {
  std::vector<ImagePage> pages;
  std::vector<std::pair<std::string, std::string>> metadata;
  std::vector<UnreadChannel> unread;
  std::vector<std::string> remarks;  // remarks without repetition

  void remark(const std::string& sentence) {
    constexpr std::size_t kMostImageRemarks = 64;
    const bool known = std::find(remarks.begin(), remarks.end(), sentence) != remarks.end();
    if (!known && remarks.size() < kMostImageRemarks) remarks.push_back(sentence);
  }
  // Adds a remark for a side whose unit the file does not name.
  void remark_if_without(const ScaledUnit& side) {
    if (side.unit.empty()) remark("it does not name the unit of its sides, which are taken as metres");
  }
};

// Adds the page that `read` returns. If it throws CurveError, the channel is left out with that reason; CutShort
// concerns the whole file.
template <class Read>
void add_page(const std::string& name, ImagePages& found, const Read& read) {
  try {
    found.pages.push_back(read());
  } catch (const CutShort&) {
    throw;
  } catch (const CurveError& fault) {
    found.unread.push_back({name, fault.what()});
  }
}

// Limits of a file's channels, of a side of an image, and of the values of all channels together.
inline constexpr std::size_t kMostChannels = 256;
inline constexpr std::size_t kMostImageSide = 8192;
inline constexpr std::size_t kMostImageValues = std::size_t{32} << 20U;

// `columns` x `rows` numbers of one size from `data`, scaled: value = factor * number + offset. `at` returns the number
// in a row and column of the file.
template <class NumberAt>
std::vector<double> grid_values(std::size_t columns, std::size_t rows, bool bottom_up, const NumberAt& number) {
  std::vector<double> values;
  values.reserve(columns * rows);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t in_file = bottom_up ? rows - 1 - row : row;
    for (std::size_t column = 0; column < columns; ++column) values.push_back(number(in_file * columns + column));
  }
  return values;
}

inline constexpr std::size_t kMostImageMetadata = 2000;

// Limit of an image's side on the sample. No microscope's or profiler's stage is as wide; in a file without units the
// sides are in pixels.
inline constexpr double kLongestSideM = 1.0;

// Throws CurveError if the side is out of range.
std::size_t image_side(double count);

// A length on the sample, in metres: the absolute value. A side without a unit counts as metres. Throws CurveError for
// another unit, and unless the side is above zero and at most kLongestSideM.
double image_length_m(double length, const ScaledUnit& unit = {1.0, "m"});

}  // namespace afm::curves
