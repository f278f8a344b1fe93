// SPDX-License-Identifier: Apache-2.0
#include "images/igor_image.h"

#include <array>
#include <string>

#include "bytes/igor_wave.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

// Units by the beginning of a channel's name, as in Gwyddion 2.62.
constexpr std::pair<std::string_view, std::string_view> kIgorUnits[]{
    {"Height", "m"},    {"ZSensor", "m"}, {"ZSnsr", "m"},   {"Deflection", "m"},
    {"Amplitude", "m"}, {"Phase", "deg"}, {"Current", "A"}, {"Frequency", "Hz"}};

std::string igor_unit(std::string_view channel) {
  for (const auto& [beginning, unit] : kIgorUnits) {
    if (channel.starts_with(beginning)) return std::string(unit);
  }
  return "V";
}

double igor_side_m(const IgorWave& wave, std::size_t dimension, std::size_t count) {
  const ScaledUnit unit = scaled_unit(wave.units[dimension]);
  return image_length_m(wave.spacing[dimension] * static_cast<double>(count), unit);
}

}  // namespace

ImagePages read_igor_image(std::string_view bytes) {
  const IgorWave wave = read_igor_wave(bytes);
  const std::size_t columns = image_side(static_cast<double>(wave.rows)),
                    rows = image_side(static_cast<double>(wave.columns));
  const double width_m = igor_side_m(wave, 0, columns), height_m = igor_side_m(wave, 1, rows);
  ImagePages found;
  if (wave.layers > kMostChannels) throw CurveError("it has " + std::to_string(wave.layers) + " layers");
  for (std::size_t layer = 0; layer < wave.layers; ++layer) {
    const ScaledUnit data_unit = scaled_unit(wave.data_unit);
    const std::string_view label = wave.labels[layer];
    const std::string unit = wave.is_matrix || label.empty() ? "" : igor_unit(label);
    found.pages.push_back({.name = label.empty() ? "Layer " + std::to_string(layer) : std::string(label),
                           .unit = data_unit.unit.empty() ? unit : data_unit.unit,
                           .columns = columns,
                           .rows = rows,
                           .width_m = width_m,
                           .height_m = height_m,
                           .values = [wave, layer, columns, rows, factor = data_unit.factor] {
                             return grid_values(columns, rows, true, [&](std::size_t i) {
                               return factor * wave.value(i % columns, i / columns, layer);
                             });
                           }});
  }
  std::string_view line;
  for (Lines lines(wave.note); lines.next(line) && found.metadata.size() < kMostImageMetadata;) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || colon == 0) continue;
    found.metadata.emplace_back(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
  }
  return found;
}

}  // namespace afm::curves
