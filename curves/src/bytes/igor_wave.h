// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "bytes/file_bytes.h"

namespace afm::curves {

// An Igor binary wave (.ibw): WaveMetrics' Technical Note 003, version 5, of 32-bit or 64-bit floats, in either byte
// order. Its channels are the columns of a table or the layers of an image, named by the labels of that dimension; a
// matrix without labels is an image of one layer with the wave's own name. Refers to the file's bytes.
struct IgorWave {
  std::size_t rows = 0;     // length of the first dimension, which runs fastest
  std::size_t columns = 0;  // length of the second dimension
  std::size_t layers = 0;   // length of the third dimension; 0: a table
  bool is_matrix = false;   // true: one layer without a label
  std::size_t number_size = 0;
  std::endian order = std::endian::little;
  std::array<double, 2> spacing{};  // sampling steps of the first two dimensions, in their units
  std::array<double, 2> origin{};
  std::array<std::string_view, 2> units;  // units of the first two dimensions, such as "m"
  std::string_view data_unit;
  std::string_view data;
  std::string_view note;
  std::vector<std::string_view> labels;  // names of the channels; empty where a layer has none
  std::string_view trailer;              // data appended by Asylum's program

  double value(std::size_t row, std::size_t column, std::size_t layer = 0) const {
    const std::size_t offset = ((layer * columns + column) * rows + row) * number_size;
    return number_size == sizeof(float) ? static_cast<double>(number_at<float>(data, offset, order))
                                        : number_at<double>(data, offset, order);
  }
};

// Throws CurveError.
IgorWave read_igor_wave(std::string_view bytes);

// Returns whether the bytes begin like an Igor wave of any version or byte order.
bool looks_like_igor(std::string_view bytes);

// Returns whether such bytes have three dimensions, the third with more than one layer, with labels or beside columns
// without labels, or are a matrix.
bool looks_like_igor_image(std::string_view bytes);

// Returns whether the bytes are a wave of version 2, which has one dimension and is not supported.
bool is_old_igor(std::string_view bytes);

// Value of "key: value" in a note; empty if it is missing. The number is also empty if it is NaN or infinite, and
// throws CurveError if it is malformed.
std::string_view note_value(std::string_view note, std::string_view key);
std::optional<double> note_number(std::string_view note, std::string_view key);

}  // namespace afm::curves
