// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/served_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <utility>

#include "physics/quantity_text.h"
#include "scan/image_maps.h"

namespace afm::exhibit {

ServedImage::ServedImage(const Size& size) : size_(size) {
  for (Maps* maps : {&height_m_, &error_n_, &lateral_n_}) {
    for (auto& map : *maps) map.assign(size.columns * size.rows, std::numeric_limits<double>::quiet_NaN());
  }
}

void ServedImage::add(const physics::ScanLine& line) {
  if (line.row >= size_.rows || line.trace.height_m.size() != size_.columns ||
      line.retrace.height_m.size() != size_.columns) {
    return;
  }
  const auto start = static_cast<std::ptrdiff_t>(line.row * size_.columns);
  for (std::size_t pass = 0; pass < 2; ++pass) {
    const physics::ScanTrack& track = pass == 0 ? line.trace : line.retrace;
    std::copy(track.height_m.begin(), track.height_m.end(), height_m_[pass].begin() + start);
    std::copy(track.error_n.begin(), track.error_n.end(), error_n_[pass].begin() + start);
    std::copy(track.lateral_n.begin(), track.lateral_n.end(), lateral_n_[pass].begin() + start);
  }
  newest_row_ = line.row;
}

render::ColorGrid ServedImage::colored(const std::vector<double>& map, double low, double high,
                                       Srgb (*color)(double)) const {
  constexpr std::size_t kMostPanelCells = 256;  // limit of a panel
  const std::size_t cells = std::min(kMostPanelCells, std::max(size_.columns, size_.rows));
  const double side_m = std::max(size_.width_m, size_.height_m);
  // nearest pixel of a cell along one axis; none beside the image
  const auto pixel = [&](std::size_t cell, double length_m, std::size_t pixels) -> std::optional<std::size_t> {
    const double from_middle = (static_cast<double>(cell) + 0.5) / static_cast<double>(cells) - 0.5;
    const double place = std::floor((from_middle * side_m / length_m + 0.5) * static_cast<double>(pixels));
    if (!(place >= 0.0) || place >= static_cast<double>(pixels)) return std::nullopt;
    return static_cast<std::size_t>(place);
  };
  render::ColorGrid grid{
      .columns = static_cast<std::uint32_t>(cells), .rows = static_cast<std::uint32_t>(cells), .colors = {}};
  grid.colors.reserve(cells * cells);
  for (std::size_t y = 0; y < cells; ++y) {
    const auto row = pixel(y, size_.height_m, size_.rows);
    for (std::size_t x = 0; x < cells; ++x) {
      const auto column = pixel(x, size_.width_m, size_.columns);
      const double value =
          row && column ? map[*row * size_.columns + *column] : std::numeric_limits<double>::quiet_NaN();
      const bool known = std::isfinite(value);
      const auto [r, g, b] = known ? color((value - low) / (high - low)) : Srgb{};
      grid.colors.push_back({r, g, b, static_cast<std::uint8_t>(known ? 255 : 0)});
    }
  }
  return grid;
}

render::ImagePanel ServedImage::panel(const std::string& sample, const Phrases& phrases) const {
  const Range heights = at_least(range_of(height_m_[0], height_m_[1]), kLeastRangeM);
  const Range errors = at_least(range_of(error_n_[0]), kLeastForceN);
  const Range lateral = at_least(range_of(lateral_n_[0]), kLeastForceN);
  const std::string rate =
      physics::format_quantity(physics::Frequency(size_.line_rate_hz), physics::kFrequencyUnits, 3);

  render::ImagePanel panel;
  panel.title = phrases.text<Phrase::ScanTitle>(sample);
  panel.subtitle = phrases.text<Phrase::ScanSubtitle>(side_text(size_.width_m), phrases.number(rate),
                                                      fmt::format("{}", newest_row_ ? *newest_row_ + 1 : 1),
                                                      fmt::format("{}", size_.rows));
  panel.decimal_mark = phrases.decimal_mark();
  panel.heights = {
      render::ImageMap{phrases[Phrase::ScanTrace], colored(height_m_[0], heights.low, heights.high, height_colour)},
      render::ImageMap{phrases[Phrase::ScanRetrace], colored(height_m_[1], heights.low, heights.high, height_colour)}};
  panel.smaller = {
      {phrases.text<Phrase::ScanError>(nanonewtons(errors)), colored(error_n_[0], errors.low, errors.high, grey)},
      {phrases.text<Phrase::ScanLateral>(nanonewtons(lateral)),
       colored(lateral_n_[0], lateral.low, lateral.high, grey)}};
  const double side_m = std::max(size_.width_m, size_.height_m), high_nm = (heights.high - heights.low) * 1e9;
  panel.profile = {.title = phrases[Phrase::ScanNewestLine],
                   .low = {0.0, -0.06 * high_nm},
                   .high = {size_.width_m * 1e9, 1.30 * high_nm},  // top with room for the legend
                   .lines = {}};
  show_side(side_m, panel);
  show_heights(high_nm, panel);
  if (!newest_row_) return panel;
  const double from_middle = (static_cast<double>(*newest_row_) + 0.5) / static_cast<double>(size_.rows) - 0.5;
  panel.line = 0.5 + from_middle * size_.height_m / side_m;
  const auto newest = [&](const std::vector<double>& map) {
    std::vector<glm::vec2> points;
    for (std::size_t column = 0; column < size_.columns; ++column) {
      const double x = (static_cast<double>(column) + 0.5) / static_cast<double>(size_.columns);
      points.emplace_back(x * size_.width_m * 1e9, (map[*newest_row_ * size_.columns + column] - heights.low) * 1e9);
    }
    return points;
  };
  panel.profile.lines = {
      {.label = phrases[Phrase::ScanTraceShort], .color = kTraceColor, .dashed = false, .points = newest(height_m_[0])},
      {.label = phrases[Phrase::ScanRetraceShort],
       .color = kRetraceColor,
       .dashed = true,
       .points = newest(height_m_[1])}};
  return panel;
}

}  // namespace afm::exhibit
