// SPDX-License-Identifier: Apache-2.0
#include "bytes/igor_wave.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "bytes/text_table.h"
#include "curves/recorded_curve.h"

namespace afm::curves {

namespace {

// Offsets in the file: BinHeader5 (64 bytes), WaveHeader5 (320), the data.
constexpr std::size_t kWaveSize = 4, kFormulaSize = 8, kNoteSize = 12, kDataUnitsSize = 16, kDimUnitsSizes = 20,
                      kDimLabelsSizes = 36, kDataType = 80, kName = 92, kDimensions = 132, kSpacings = 148,
                      kOrigins = 180, kDataUnit = 212, kDimensionUnits = 216, kData = 384, kWaveHeaderSize = 320,
                      kLabelSize = 32, kUnitSize = 4;
constexpr std::size_t kOldHeaders = 126;  // size of BinHeader2 and WaveHeader2 in bytes

// Byte order in which the version is a small number.
std::endian order_of(std::string_view bytes) {
  return number_at<std::uint16_t>(bytes, 0) < 0x100 ? std::endian::little : std::endian::big;
}

// Sum of the headers' words, zero if they are undamaged.
std::uint16_t sum_of_words(std::string_view headers, std::endian order) {
  std::uint16_t sum = 0;
  for (std::size_t i = 0; i + 1 < headers.size(); i += 2) {
    sum = static_cast<std::uint16_t>(sum + number_at<std::uint16_t>(headers, i, order));
  }
  return sum;
}

// Length stored in the file as a signed number.
std::size_t length_at(std::string_view bytes, std::size_t offset) {
  const auto value = number_at<std::int32_t>(bytes, offset, order_of(bytes));
  if (value < 0) throw CurveError("it is damaged: a length in its header is negative");
  return static_cast<std::size_t>(value);
}

std::string_view unit_at(std::string_view bytes, std::size_t offset) {
  const std::string_view unit = part(bytes, offset, kUnitSize);
  return unit.substr(0, unit.find('\0'));
}

void check_header(std::string_view bytes) {
  const std::endian order = order_of(bytes);
  if (const auto version = number_at<std::int16_t>(bytes, 0, order); version != 5) {
    throw CurveError(
        fmt::format("it is an Igor wave of version {}, which holds one row of numbers and no channels; version 5 is "
                    "read: save it again with Igor Pro 3 or newer as a wave of two or three dimensions",
                    version));
  }
  if (sum_of_words(part(bytes, 0, kData), order) != 0) throw CurveError("the checksum of its header is wrong");
}

// True for a plain matrix: two dimensions, or a third of one layer, without labels that would make columns or layers
// channels.
bool is_matrix(std::string_view bytes) {
  return length_at(bytes, kDimensions + 4) > 0 && length_at(bytes, kDimensions + 8) <= 1 &&
         length_at(bytes, kDimLabelsSizes + 4) == 0 && length_at(bytes, kDimLabelsSizes + 8) == 0;
}

void read_data(std::string_view bytes, IgorWave& wave) {
  wave.rows = length_at(bytes, kDimensions);
  wave.columns = length_at(bytes, kDimensions + 4);
  wave.layers = length_at(bytes, kDimensions + 8);
  if (!looks_like_igor_image(bytes)) wave.layers = 0;
  if (is_matrix(bytes)) wave.layers = 1;
  if (wave.rows == 0 || wave.columns == 0) {
    throw CurveError("its wave is not a table of channels with labels: it has one dimension");
  }
  switch (number_at<std::int16_t>(bytes, kDataType, wave.order)) {
    case 2:
      wave.number_size = sizeof(float);
      break;
    case 4:
      wave.number_size = sizeof(double);
      break;
    default:
      throw CurveError("its numbers are neither 32-bit nor 64-bit floats");
  }
  // limited by the file's size, so that the products below cannot overflow
  const std::size_t layers = std::max<std::size_t>(wave.layers, 1);
  if (wave.rows > bytes.size() || wave.columns > bytes.size() / wave.rows ||
      layers > bytes.size() / (wave.rows * wave.columns)) {
    throw CutShort();
  }
  const std::size_t data_size = wave.rows * wave.columns * layers * wave.number_size;
  if (length_at(bytes, kWaveSize) != kWaveHeaderSize + data_size) {
    throw CurveError("it is damaged: the wave's size does not fit its dimensions");
  }
  wave.data = part(bytes, kData, data_size);
}

}  // namespace

IgorWave read_igor_wave(std::string_view bytes) {
  check_header(bytes);
  IgorWave wave;
  wave.order = order_of(bytes);
  read_data(bytes, wave);
  for (std::size_t i = 0; i < 2; ++i) {
    wave.spacing[i] = number_at<double>(bytes, kSpacings + i * sizeof(double), wave.order);
    wave.origin[i] = number_at<double>(bytes, kOrigins + i * sizeof(double), wave.order);
    wave.units[i] = unit_at(bytes, kDimensionUnits + i * kUnitSize);
  }
  wave.data_unit = unit_at(bytes, kDataUnit);

  std::size_t offset = kData + wave.data.size() + length_at(bytes, kFormulaSize);
  const std::size_t note_size = length_at(bytes, kNoteSize);
  wave.note = part(bytes, offset, note_size);
  offset += note_size + length_at(bytes, kDataUnitsSize);
  for (std::size_t i = 0; i < 4; ++i) offset += length_at(bytes, kDimUnitsSizes + 4 * i);
  // labels of the channels' dimension, after those of the dimensions before it
  const std::size_t dimension = wave.layers > 0 ? 2 : 1;
  for (std::size_t i = 0; i < dimension; ++i) offset += length_at(bytes, kDimLabelsSizes + 4 * i);
  const std::string_view labels = part(bytes, offset, length_at(bytes, kDimLabelsSizes + 4 * dimension));
  // the first label is that of the dimension itself; the layers of an image may lack theirs
  for (std::size_t i = kLabelSize; i + kLabelSize <= labels.size(); i += kLabelSize) {
    const std::string_view label = labels.substr(i, kLabelSize);
    wave.labels.push_back(label.substr(0, label.find('\0')));
  }
  if (is_matrix(bytes)) {
    const std::string_view name = part(bytes, kName, kLabelSize);
    wave.labels = {name.substr(0, name.find('\0'))};
    wave.is_matrix = true;
  }
  if (wave.layers == 0 && wave.labels.size() != wave.columns) {
    throw CurveError("its columns have no labels, so that their channels are unknown");
  }
  wave.labels.resize(wave.layers > 0 ? wave.layers : wave.columns);
  wave.trailer = bytes.substr(offset + labels.size());
  return wave;
}

bool looks_like_igor(std::string_view bytes) {
  if (bytes.size() < 2) return false;
  const auto version = number_at<std::uint16_t>(bytes, 0, order_of(bytes));
  return version == 5 || version == 2;
}

bool looks_like_igor_image(std::string_view bytes) {
  if (bytes.size() < kData) return false;
  const std::endian order = order_of(bytes);
  if (number_at<std::uint16_t>(bytes, 0, order) != 5) return false;
  const auto number = [&](std::size_t offset) { return number_at<std::int32_t>(bytes, offset, order); };
  const std::int32_t columns = number(kDimensions + 4), layers = number(kDimensions + 8);
  const bool has_column_labels = number(kDimLabelsSizes + 4) > 0;
  if (layers == 0) return columns > 0 && !has_column_labels;
  return layers > 1 || number(kDimLabelsSizes + 8) > 0 || !has_column_labels;
}

bool is_old_igor(std::string_view bytes) {
  if (bytes.size() < kOldHeaders) return false;
  const std::endian order = order_of(bytes);
  return number_at<std::uint16_t>(bytes, 0, order) == 2 && sum_of_words(bytes.substr(0, kOldHeaders), order) == 0;
}

std::string_view note_value(std::string_view note, std::string_view key) {
  std::string_view line;
  for (Lines lines(note); lines.next(line);) {
    if (line.size() > key.size() && line.starts_with(key) && line[key.size()] == ':') {
      return trimmed(line.substr(key.size() + 1));
    }
  }
  return {};
}

std::optional<double> note_number(std::string_view note, std::string_view key) {
  std::string_view text = note_value(note, key);
  if (text.empty()) return std::nullopt;
  const auto number = number_of(text);
  if (!number && has_decimal_comma(text)) throw CurveError(decimal_comma_in(fmt::format("{} in its note", key), text));
  if (!number) throw CurveError(fmt::format("{} in its note is \"{}\", not a number", key, text.substr(0, 40)));
  return std::isfinite(*number) ? number : std::nullopt;
}

}  // namespace afm::curves
