// SPDX-License-Identifier: Apache-2.0
#include "formats/igor_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>

#include "curves/curve_error.h"
#include "formats/text_table.h"

namespace afm::curves {

namespace {

static_assert(std::endian::native == std::endian::little, "Igor waves are read as they lie in the file");

// Offsets in the file: BinHeader5 (64 bytes), WaveHeader5 (320), the data.
constexpr std::size_t kWaveSize = 4, kFormulaSize = 8, kNoteSize = 12, kDataUnitsSize = 16, kDimUnitsSizes = 20,
                      kDimLabelsSizes = 36, kDataType = 80, kDimensions = 132, kData = 384, kWaveHeaderSize = 320,
                      kLabelSize = 32;

template <class T>
T at(std::string_view bytes, std::size_t offset) {
  T value{};
  if (offset > bytes.size() || bytes.size() - offset < sizeof(T)) throw CurveError("it is cut short");
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

// A length in the file, which Igor holds as a signed number.
std::size_t length_at(std::string_view bytes, std::size_t offset) {
  const auto value = at<std::int32_t>(bytes, offset);
  if (value < 0) throw CurveError("it is damaged: a length in its header is negative");
  return static_cast<std::size_t>(value);
}

std::string_view part(std::string_view bytes, std::size_t offset, std::size_t size) {
  if (offset > bytes.size() || size > bytes.size() - offset) throw CurveError("it is cut short");
  return bytes.substr(offset, size);
}

struct Wave {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t number_size = 0;
  std::string_view data;
  std::string_view note;
  std::vector<std::string_view> labels;  // of the columns

  double value(std::size_t row, std::size_t column) const {
    const std::size_t offset = (column * rows + row) * number_size;
    return number_size == sizeof(float) ? static_cast<double>(at<float>(data, offset)) : at<double>(data, offset);
  }
};

void check_header(std::string_view bytes) {
  if (const auto version = at<std::int16_t>(bytes, 0); version != 5) {
    throw CurveError("it is an Igor wave of another version or byte order; only version 5, little-endian, is read");
  }
  std::uint16_t sum = 0;
  for (std::size_t i = 0; i < kData; i += 2) sum = static_cast<std::uint16_t>(sum + at<std::uint16_t>(bytes, i));
  if (sum != 0) throw CurveError("the checksum of its header is wrong");
}

// Asylum's program adds a text that ends with its own length and kind, "0292 Force".
void check_trailer(std::string_view trailer) {
  if (trailer.empty()) return;
  std::size_t letters = 0, digits = 0;
  const auto last = [&](std::size_t back) { return back < trailer.size() ? trailer[trailer.size() - 1 - back] : '\0'; };
  while (std::isalpha(static_cast<unsigned char>(last(letters))) != 0) ++letters;
  while (std::isdigit(static_cast<unsigned char>(last(letters + 1 + digits))) != 0) ++digits;
  if (letters == 0 || last(letters) != ' ' || digits != 4)
    throw CurveError("it is cut short: the text at its end is not whole");
}

Wave read_wave(std::string_view bytes) {
  check_header(bytes);
  Wave wave;
  wave.rows = length_at(bytes, kDimensions);
  wave.columns = length_at(bytes, kDimensions + 4);
  if (length_at(bytes, kDimensions + 8) > 1 || wave.rows == 0 || wave.columns == 0) {
    throw CurveError("its wave is no table of channels: an image or a volume");
  }
  switch (at<std::int16_t>(bytes, kDataType)) {
    case 2:
      wave.number_size = sizeof(float);
      break;
    case 4:
      wave.number_size = sizeof(double);
      break;
    default:
      throw CurveError("its numbers are neither 32-bit nor 64-bit floats");
  }
  // the file itself bounds both, so that the products below cannot overflow
  if (wave.rows > bytes.size() || wave.columns > bytes.size()) throw CurveError("it is cut short");
  const std::size_t data_size = wave.rows * wave.columns * wave.number_size;
  if (length_at(bytes, kWaveSize) != kWaveHeaderSize + data_size) {
    throw CurveError("it is damaged: the wave's size does not fit its dimensions");
  }
  wave.data = part(bytes, kData, data_size);

  std::size_t offset = kData + data_size + length_at(bytes, kFormulaSize);
  const std::size_t note_size = length_at(bytes, kNoteSize);
  wave.note = part(bytes, offset, note_size);
  offset += note_size + length_at(bytes, kDataUnitsSize);
  for (std::size_t i = 0; i < 4; ++i) offset += length_at(bytes, kDimUnitsSizes + 4 * i);
  offset += length_at(bytes, kDimLabelsSizes);
  const std::string_view labels = part(bytes, offset, length_at(bytes, kDimLabelsSizes + 4));
  // the first label is the dimension's own
  for (std::size_t i = kLabelSize; i + kLabelSize <= labels.size(); i += kLabelSize) {
    const std::string_view label = labels.substr(i, kLabelSize);
    wave.labels.push_back(label.substr(0, label.find('\0')));
  }
  if (wave.labels.size() != wave.columns)
    throw CurveError("its columns have no labels, so that their channels are unknown");
  check_trailer(bytes.substr(offset + labels.size()));
  return wave;
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
  const std::string_view text = note_value(note, key);
  if (text.empty()) return std::nullopt;
  return number_in(text, key, Lines({}));
}

std::size_t channel(const Wave& wave, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    const auto found = std::find(wave.labels.begin(), wave.labels.end(), name);
    if (found != wave.labels.end()) return static_cast<std::size_t>(found - wave.labels.begin());
  }
  throw CurveError(fmt::format("it has no channel {}", fmt::join(names, " or ")));
}

CurveMetadata metadata_of(std::string_view note) {
  CurveMetadata metadata;
  if (const auto k = note_number(note, "SpringConstant")) metadata.spring_constant = physics::Stiffness(*k);
  metadata.sensitivity_m_per_v = note_number(note, "InvOLS");
  if (const auto v = note_number(note, "ApproachVelocity")) metadata.approach_speed = physics::Velocity(*v);
  if (const auto v = note_number(note, "RetractVelocity")) metadata.retract_speed = physics::Velocity(*v);
  if (note_value(note, "TriggerChannel") == "Force") {
    if (const auto force = note_number(note, "TriggerPoint")) metadata.setpoint = physics::Force(*force);
  }
  metadata.instrument = note_value(note, "MicroscopeModel");
  metadata.software = "Asylum Research";
  metadata.software_version = note_value(note, "Version");
  metadata.date = note_value(note, "Date");
  metadata.time = note_value(note, "Time");
  return metadata;
}

}  // namespace

bool looks_like_igor(std::string_view bytes) {
  if (bytes.size() < 2) return false;
  const auto version = at<std::uint16_t>(bytes, 0);
  return version == 5 || version == 2 || version == 0x0500 || version == 0x0200;
}

RecordedCurve read_igor(std::string_view bytes) {
  const Wave wave = read_wave(bytes);
  if (wave.rows > kMostCurvePoints) throw CurveError("it has more points than a curve may have");
  RecordedCurve curve{{}, {}, metadata_of(wave.note)};
  if (!curve.metadata.spring_constant) throw CurveError("its note has no SpringConstant");
  const std::size_t height = channel(wave, {"ZSnsr", "ZSensor", "Raw", "Height"});
  const std::size_t deflection = channel(wave, {"Defl", "Deflection"});
  for (std::size_t row = 0; row < wave.rows; ++row) {
    const double z = -wave.value(row, height), bend = wave.value(row, deflection);
    if (!std::isfinite(z) || !std::isfinite(bend)) continue;
    curve.points.push_back({physics::Length(z), *curve.metadata.spring_constant * physics::Length(bend)});
  }
  const auto deepest = std::min_element(curve.points.begin(), curve.points.end(),
                                        [](const auto& a, const auto& b) { return a.z < b.z; });
  for (auto point = deepest; point != curve.points.end(); ++point) {
    if (point != deepest) point->branch = physics::Branch::Retract;
  }
  return curve;
}

}  // namespace afm::curves
