// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "formats/file_bytes.h"

namespace afm::curves {

// An Igor binary wave (.ibw): WaveMetrics' Technical Note 003, version 5, of 32-bit or 64-bit floats, in either order
// of bytes. Its channels are the columns of a table or the layers of an image, and their names are the labels of that
// dimension; a matrix without labels is an image of one layer with the wave's own name. Refers to the file's bytes.
struct IgorWave {
  std::size_t rows = 0;     // of the first dimension, which runs fastest
  std::size_t columns = 0;  // of the second
  std::size_t layers = 0;   // of the third; 0: a table
  bool is_matrix = false;   // without labels, which would say what its numbers are
  std::size_t number_size = 0;
  std::endian order = std::endian::little;
  std::array<double, 2> spacing{};  // of the first and the second dimension, in their units
  std::array<double, 2> origin{};
  std::array<std::string_view, 2> units;  // of the two, "m"
  std::string_view data_unit;
  std::string_view data;
  std::string_view note;
  std::vector<std::string_view> labels;  // of the channels
  std::string_view trailer;              // what Asylum's program adds behind the wave

  double value(std::size_t row, std::size_t column, std::size_t layer = 0) const {
    const std::size_t offset = ((layer * columns + column) * rows + row) * number_size;
    return number_size == sizeof(float) ? static_cast<double>(number_at<float>(data, offset, order))
                                        : number_at<double>(data, offset, order);
  }
};

// Throws CurveError.
IgorWave read_igor_wave(std::string_view bytes);

// Whether the bytes begin as an Igor wave of this or another version or byte order does.
bool looks_like_igor(std::string_view bytes);

// Whether such bytes are of three dimensions, the third with more than one layer, or with labels; or a matrix.
bool looks_like_igor_image(std::string_view bytes);

// Whether the bytes are a wave of version 2, which has one dimension: nothing here can read it.
bool is_old_igor(std::string_view bytes);

// "key: value" of a note; empty if it has none. The number throws CurveError where it is none.
std::string_view note_value(std::string_view note, std::string_view key);
std::optional<double> note_number(std::string_view note, std::string_view key);

}  // namespace afm::curves
