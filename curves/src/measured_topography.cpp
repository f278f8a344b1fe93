// SPDX-License-Identifier: Apache-2.0
#include "curves/measured_topography.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/printable.h"
#include "core/written_by.h"
#include "physics/quantity_text.h"

namespace afm::curves {

namespace {

constexpr double kNarrowestScanM = 1e-10;  // width of the narrowest scan, the size of an atom
constexpr double kWidestScanM = 1e-3, kHighestM = 1e-3;
constexpr double kSquarePixels = 1e-3;  // largest relative difference of the sides

std::string length_text(double length_m) {
  return physics::format_quantity(physics::Length(length_m), physics::kLengthUnits);
}

// Value in the channel's unit; lengths in a convenient one.
std::string value_text(const MeasuredTopography& topography, double value) {
  const std::string& unit = topography.channel().unit;
  return unit == "m" ? length_text(value) : fmt::format("{:.5g} {}", value, unit);
}

// Heights row by row from the top, with pixels of any size.
struct PixelGrid {
  std::size_t columns, rows;
  double width_m, height_m;  // size of a pixel
  std::vector<double> heights;
};

// Means of blocks of pixels, without those beyond the last whole block.
PixelGrid averaged(const PixelGrid& grid, std::size_t across, std::size_t down) {
  PixelGrid mean{grid.columns / across,
                 grid.rows / down,
                 grid.width_m * static_cast<double>(across),
                 grid.height_m * static_cast<double>(down),
                 {}};
  for (std::size_t row = 0; row < mean.rows; ++row) {
    for (std::size_t column = 0; column < mean.columns; ++column) {
      double sum = 0;
      for (std::size_t r = 0; r < down; ++r) {
        for (std::size_t c = 0; c < across; ++c)
          sum += grid.heights[(row * down + r) * grid.columns + column * across + c];
      }
      mean.heights.push_back(sum / static_cast<double>(across * down));
    }
  }
  return mean;
}

// Height by bilinear interpolation between the pixels' centres; at the rim, the height of the nearest centre.
double height_at(const PixelGrid& grid, double column, double row) {
  const double c = std::clamp(column, 0.0, static_cast<double>(grid.columns - 1)),
               r = std::clamp(row, 0.0, static_cast<double>(grid.rows - 1));
  const auto left = static_cast<std::size_t>(c), above = static_cast<std::size_t>(r);
  const std::size_t right = std::min(left + 1, grid.columns - 1), below = std::min(above + 1, grid.rows - 1);
  const double x = c - static_cast<double>(left), y = r - static_cast<double>(above);
  const auto at = [&](std::size_t i, std::size_t k) { return grid.heights[k * grid.columns + i]; };
  return (1 - y) * ((1 - x) * at(left, above) + x * at(right, above)) +
         y * ((1 - x) * at(left, below) + x * at(right, below));
}

PixelGrid with_square_pixels(PixelGrid grid) {
  const auto most = static_cast<double>(scene::kMaxTopographySide);
  const bool square = std::abs(grid.width_m / grid.height_m - 1.0) < kSquarePixels;
  if (square && static_cast<double>(std::max(grid.columns, grid.rows)) <= most) return grid;
  const double width_m = grid.width_m * static_cast<double>(grid.columns),
               height_m = grid.height_m * static_cast<double>(grid.rows);
  const double spacing_m = std::max({width_m / most, height_m / most, std::min(grid.width_m, grid.height_m)});
  const auto across = static_cast<std::size_t>(std::max(1.0, std::floor(spacing_m / grid.width_m + kSquarePixels))),
             down = static_cast<std::size_t>(std::max(1.0, std::floor(spacing_m / grid.height_m + kSquarePixels)));
  if (across > 1 || down > 1) grid = averaged(grid, across, down);
  const auto count = [&](double side_m) {
    return static_cast<std::size_t>(std::clamp(std::round(side_m / spacing_m), 2.0, most));
  };
  PixelGrid even{count(width_m), count(height_m), spacing_m, spacing_m, {}};
  for (std::size_t row = 0; row < even.rows; ++row) {
    for (std::size_t column = 0; column < even.columns; ++column) {
      even.heights.push_back(height_at(grid, (static_cast<double>(column) + 0.5) * spacing_m / grid.width_m - 0.5,
                                       (static_cast<double>(row) + 0.5) * spacing_m / grid.height_m - 0.5));
    }
  }
  return even;
}

tl::unexpected<core::Error> unfit(const MeasuredTopography& topography, const std::string& why) {
  return core::failure(core::ErrorCategory::BadInputFile,
                       fmt::format("cannot use the image {} as a sample: {}", topography.name, why));
}

}  // namespace

core::Result<MeasuredTopography> load_topography(const std::string& path, const TopographyReading& reading) {
  auto image = load_image(path, reading.image);
  if (!image) return tl::unexpected(image.error());
  MeasuredTopography found{
      .name = path, .file = std::move(*image), .raw = {}, .levelling = reading.levelling, .level = {}, .levelled = {}};
  const physics::ScanImage& scan = found.file.image;
  found.raw = physics::height_statistics(found.channel().values);
  if (found.raw.measured == 0) {
    return core::failure(
        core::ErrorCategory::BadInputFile,
        fmt::format("cannot use the image {}: no point of its channel {} was measured", path, found.channel().name));
  }
  found.level = physics::levelled(found.channel().values, scan.columns, scan.rows, reading.levelling);
  found.levelled = physics::height_statistics(found.level.heights);
  return found;
}

std::string topography_text(const MeasuredTopography& topography) {
  const physics::ScanImage& scan = topography.file.image;
  std::string text;
  const auto out = std::back_inserter(text);
  const auto line = [&](std::string_view title, const std::string& value) {
    fmt::format_to(out, "  {:<14}{}\n", title, value);
  };
  fmt::format_to(out, "{}: {} image, {} x {} points, {} x {}\n", core::printable_line(topography.name),
                 name_of(topography.file.format), scan.columns, scan.rows, length_text(scan.width_m),
                 length_text(scan.height_m));
  std::string channels;
  for (const physics::ImageChannel& each : scan.channels) channels += (channels.empty() ? "" : ", ") + each.name;
  for (const std::string& name : topography.file.left_out) channels += fmt::format(", {} (on another grid)", name);
  line("channels", channels);
  for (const UnreadChannel& each : topography.file.unread) line("left out", each.name + ": " + each.reason);
  for (const std::string& remark : topography.file.remarks) line("remark", remark);
  line("channel", topography.channel().name);
  line("measured", fmt::format("{} of {} points", topography.raw.measured, scan.columns * scan.rows));
  line("mean", value_text(topography, topography.raw.mean));
  line("Sq", value_text(topography, topography.raw.sq));
  line("lowest", value_text(topography, topography.raw.lowest));
  line("highest", value_text(topography, topography.raw.highest));
  line("levelled by", fmt::format("{}: {}", physics::text_of(topography.levelling).word,
                                  physics::text_of(topography.levelling).meaning));
  line("Sq, levelled", value_text(topography, topography.levelled.sq));
  return text;
}

nlohmann::ordered_json topography_json(const MeasuredTopography& topography) {
  const physics::ScanImage& scan = topography.file.image;
  nlohmann::ordered_json channels = nlohmann::ordered_json::array();
  for (const physics::ImageChannel& each : scan.channels)
    channels.push_back({{"name", each.name}, {"unit", each.unit}});
  nlohmann::ordered_json unread = nlohmann::ordered_json::array();
  for (const UnreadChannel& each : topography.file.unread)
    unread.push_back({{"name", each.name}, {"reason", each.reason}});
  const double pixel_x_m = scan.width_m / static_cast<double>(scan.columns),
               pixel_y_m = scan.height_m / static_cast<double>(scan.rows);
  nlohmann::ordered_json result{{"file", topography.name},
                                {"format", name_of(topography.file.format)},
                                {"columns", scan.columns},
                                {"rows", scan.rows},
                                {"width_m", scan.width_m},
                                {"height_m", scan.height_m},
                                {"channels", channels},
                                {"on_other_grids", topography.file.left_out},
                                {"left_out", unread},
                                {"remarks", topography.file.remarks},
                                {"channel", topography.channel().name},
                                {"unit", topography.channel().unit},
                                {"measured", topography.raw.measured},
                                {"mean", topography.raw.mean},
                                {"sq", topography.raw.sq},
                                {"lowest", topography.raw.lowest},
                                {"highest", topography.raw.highest},
                                {"levelling", physics::text_of(topography.levelling).word},
                                {"slope_x", topography.level.slope_x / pixel_x_m},
                                {"slope_y", topography.level.slope_y / pixel_y_m},
                                {"filled", topography.level.filled},
                                {"sq_levelled", topography.levelled.sq}};
  core::name_software(result);
  return result;
}

core::Result<scene::Topography> felt_topography(const MeasuredTopography& topography) {
  const physics::ScanImage& scan = topography.file.image;
  if (topography.channel().unit != "m") {
    std::string unread;
    for (const UnreadChannel& each : topography.file.unread)
      unread += fmt::format("; its channel {} cannot be read: {}", each.name, each.reason);
    return unfit(topography,
                 fmt::format("its channel {} is in {}, not a height in metres; choose one with --channel{}",
                             topography.channel().name,
                             topography.channel().unit.empty() ? "no unit" : topography.channel().unit, unread));
  }
  if (std::max(scan.width_m, scan.height_m) > kWidestScanM ||
      std::max(-topography.levelled.lowest, topography.levelled.highest) > kHighestM) {
    return unfit(
        topography,
        fmt::format("{} x {}, heights of {} to {}: larger than a scan is, up to {}; set its size or its unit in "
                    "the program that wrote it",
                    length_text(scan.width_m), length_text(scan.height_m), length_text(topography.levelled.lowest),
                    length_text(topography.levelled.highest), length_text(kWidestScanM)));
  }
  if (std::min(scan.width_m, scan.height_m) < kNarrowestScanM) {
    return unfit(topography,
                 fmt::format("{} x {}: smaller than an atom", length_text(scan.width_m), length_text(scan.height_m)));
  }
  const PixelGrid grid = with_square_pixels({scan.columns, scan.rows, scan.width_m / static_cast<double>(scan.columns),
                                             scan.height_m / static_cast<double>(scan.rows), topography.level.heights});
  scene::Topography felt{.columns = static_cast<std::uint32_t>(grid.columns),
                         .rows = static_cast<std::uint32_t>(grid.rows),
                         .spacing_m = grid.width_m,
                         .height_m = {}};
  const auto middle = [&](std::size_t count) { return 0.5 * static_cast<double>(count - 1); };
  const double origin_m = height_at(grid, middle(grid.columns), middle(grid.rows));
  felt.height_m.reserve(grid.heights.size());
  // a height field begins at -y, an image at the top
  for (std::size_t row = grid.rows; row-- > 0;) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      felt.height_m.push_back(static_cast<float>(grid.heights[row * grid.columns + column] - origin_m));
    }
  }
  return felt;
}

}  // namespace afm::curves
