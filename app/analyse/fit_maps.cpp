// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/fit_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "core/whole_file.h"
#include "curves/image_output.h"
#include "exhibit/scan/image_picture.h"
#include "physics/imaging/scan_image.h"
#include "render/image_file.h"

namespace afm::app {

namespace {

// A map's name in files, its title and its unit.
struct MapRow {
  const char* word;
  const char* title;
  const char* unit;
};
constexpr std::array kMaps{MapRow{"modulus", "Modulus", "Pa"}, MapRow{"contact", "Contact height", "m"},
                           MapRow{"depth", "Depth", "m"}, MapRow{"adhesion", "Adhesion", "N"},
                           MapRow{"trust", "Trust", ""}};

// FOLDER/NAME, or FOLDER/NAME-2 and so on: the first of which there is no .gwy.
std::string free_name(const std::string& folder, const std::string& name) {
  const std::string first = (std::filesystem::path(folder) / name).string();
  std::string found = first;
  std::error_code unknown;
  for (int number = 2; std::filesystem::exists(found + ".gwy", unknown); ++number) {
    found = fmt::format("{}-{}", first, number);
  }
  return found;
}

bool has_value(const physics::ImageChannel& channel) {
  return std::any_of(channel.values.begin(), channel.values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

void FitMaps::add(const FittedCurve& curve) {
  if (!curve.pixel) return;
  const curves::MapPixel& pixel = *curve.pixel;
  if (!grid_) {
    grid_ = pixel.grid;
    cells_.resize(grid_->columns * grid_->rows);
  }
  if (!(pixel.grid == *grid_)) return;
  Cell& cell = cells_[(grid_->rows - 1 - pixel.row) * grid_->columns + pixel.column];
  cell = {};
  cell.adhesion_n = curve.figures.adhesion_n;
  if (!curve.fit) return;
  cell.modulus_pa = curve.fit->modulus_pa;
  cell.contact_m = curve.fit->contact_z_m;
  cell.depth_m = curve.fit->depth_m;
  cell.trust = curve.fit->trust;
}

core::Result<void> FitMaps::write(const std::string& folder, const std::string& file) const {
  if (!grid_) return {};
  physics::ScanImage image{.columns = grid_->columns,
                           .rows = grid_->rows,
                           .width_m = grid_->width_m,
                           .height_m = grid_->height_m,
                           .x_offset_m = grid_->center_x_m - 0.5 * grid_->width_m,
                           .y_offset_m = grid_->center_y_m + 0.5 * grid_->height_m,
                           .channels = {},
                           .metadata = {{"Source", std::filesystem::path(file).filename().string()}}};
  for (const MapRow& row : kMaps) image.channels.push_back({row.title, row.unit, {}});
  exhibit::PictureStyle style{.cut_share = 0.01, .hatched = {}};
  for (const Cell& cell : cells_) {
    const auto put = [&image](std::size_t map, const std::optional<double>& value) {
      image.channels[map].values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    };
    put(0, cell.modulus_pa);
    put(1, cell.contact_m);
    put(2, cell.depth_m);
    put(3, cell.adhesion_n);
    put(4, cell.trust ? std::optional(static_cast<double>(fits::Trust::No) - static_cast<double>(*cell.trust))
                      : std::nullopt);
    style.hatched.push_back(cell.trust && *cell.trust != fits::Trust::Trusted);
  }
  const std::string name = free_name(folder, std::filesystem::path(file).stem().string());
  if (const auto written = core::write_file(name + ".gwy", curves::gwy_bytes(image)); !written) return written;
  for (std::size_t map = 0; map < kMaps.size(); ++map) {
    if (!has_value(image.channels[map])) continue;
    const auto picture = exhibit::picture_of(image, map, map + 1 < kMaps.size() ? style : exhibit::PictureStyle{});
    const auto written = render::write_png(picture, fmt::format("{}-{}.png", name, kMaps[map].word));
    if (!written) return written;
  }
  return {};
}

}  // namespace afm::app
