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
#include <vector>

#include "core/log.h"
#include "core/whole_file.h"
#include "core/written_by.h"
#include "curves/image_output.h"
#include "exhibit/scan/image_picture.h"
#include "physics/imaging/scan_image.h"
#include "render/image_file.h"

namespace afm::app {

namespace {

using Cell = FitMaps::Cell;

std::optional<double> trust_of(const Cell& cell) {
  if (!cell.trust) return std::nullopt;
  return static_cast<double>(fits::Trust::No) - static_cast<double>(*cell.trust);
}

struct MapRow {
  const char* word;  // part of file names
  const char* title;
  const char* unit;
  bool striped;  // true: untrusted fits striped
  std::optional<double> (*value)(const Cell& cell);
};
constexpr std::array kMaps{
    MapRow{"modulus", "Modulus", "Pa", true, [](const Cell& cell) { return cell.modulus_pa; }},
    MapRow{"contact", "Contact height", "m", true, [](const Cell& cell) { return cell.contact_m; }},
    MapRow{"depth", "Depth", "m", true, [](const Cell& cell) { return cell.depth_m; }},
    MapRow{"work", "Work of adhesion", "J/m^2", true, [](const Cell& cell) { return cell.work_j_per_m2; }},
    MapRow{"adhesion", "Adhesion", "N", false, [](const Cell& cell) { return cell.adhesion_n; }},
    MapRow{"trust", "Trust", "", false, trust_of}};

bool is_free(const std::string& name) {
  std::error_code unknown;
  return !std::filesystem::exists(name + ".gwy", unknown) &&
         std::none_of(kMaps.begin(), kMaps.end(), [&](const MapRow& row) {
           return std::filesystem::exists(fmt::format("{}-{}.png", name, row.word), unknown);
         });
}

// Path FOLDER/NAME, or FOLDER/NAME-2 and so on: the first one without a file.
std::string free_name(const std::string& folder, const std::string& name) {
  const std::string first = (std::filesystem::path(folder) / name).string();
  std::string found = first;
  for (int number = 2; !is_free(found); ++number) {
    found = fmt::format("{}-{}", first, number);
  }
  return found;
}

bool has_value(const physics::ImageChannel& channel) {
  return std::any_of(channel.values.begin(), channel.values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

void FitMaps::add(const curves::FittedCurve& curve) {
  if (!curve.pixel) {
    if (curve.position) ++outside_;
    return;
  }
  const curves::MapPixel& pixel = *curve.pixel;
  if (!grid_) {
    grid_ = pixel.grid;
    if (is_drawn()) {
      cells_.resize(grid_->columns * grid_->rows);
      filled_.resize(cells_.size());
    }
  }
  if (!(pixel.grid == *grid_)) return void(++elsewhere_);
  if (!is_drawn()) return;
  const std::size_t index = (grid_->rows - 1 - pixel.row) * grid_->columns + pixel.column;
  if (filled_[index]) ++replaced_;
  filled_[index] = true;
  Cell& cell = cells_[index];
  cell = {};
  cell.adhesion_n = curve.figures.adhesion_n;
  if (!curve.fit) return;
  cell.modulus_pa = curve.fit->modulus_pa;
  cell.contact_m = curve.fit->contact_z_m;
  cell.depth_m = curve.fit->depth_m;
  if (curve.fit->adhesion) cell.work_j_per_m2 = curve.fit->adhesion->work_j_per_m2;
  cell.trust = curve.fit->trust;
}

bool FitMaps::is_drawn() const { return curves_ > 1 && curves::is_map_of(curves_, *grid_); }

core::Result<std::string> FitMaps::write(const std::string& folder, const std::string& file,
                                         const Texts& fitted_with) const {
  if (!grid_ || curves_ == 1) return {};
  if (!is_drawn()) {
    core::log_line(fmt::format("{}: no map is drawn of {} curves on a grid of {} x {} pixels", file, curves_,
                               grid_->columns, grid_->rows));
    return {};
  }
  if (curves_ < cells_.size()) {
    core::log_line(fmt::format("{}: {} curves on a grid of {} x {} pixels: the other pixels are empty", file, curves_,
                               grid_->columns, grid_->rows));
  }
  if (elsewhere_ > 0) {
    core::log_line(fmt::format("{}: {} of its curves are on another grid, and not on the map", file, elsewhere_));
  }
  if (outside_ > 0) {
    core::log_line(fmt::format("{}: {} of its curves are outside the grid, and not on the map: their pixels are empty",
                               file, outside_));
  }
  if (replaced_ > 0) {
    core::log_line(fmt::format(
        "{}: {} of its curves share a pixel with a later one, which is on the map in their place", file, replaced_));
  }
  physics::ScanImage image{
      .columns = grid_->columns,
      .rows = grid_->rows,
      .width_m = grid_->width_m,
      .height_m = grid_->height_m,
      .x_offset_m = grid_->center_x_m - 0.5 * grid_->width_m,
      .y_offset_m = grid_->center_y_m + 0.5 * grid_->height_m,
      .channels = {},
      .metadata = {{"Source", std::filesystem::path(file).filename().string()}, {"Software", core::written_by()}}};
  image.metadata.insert(image.metadata.end(), fitted_with.begin(), fitted_with.end());
  exhibit::PictureStyle style{.cut_share = 0.01, .hatched = {}};
  for (const Cell& cell : cells_) style.hatched.push_back(cell.trust && *cell.trust != fits::Trust::Trusted);
  std::vector<const MapRow*> shown;
  for (const MapRow& row : kMaps) {
    physics::ImageChannel channel{row.title, row.unit, {}};
    for (const Cell& cell : cells_) {
      channel.values.push_back(row.value(cell).value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    if (!has_value(channel)) continue;
    image.channels.push_back(std::move(channel));
    shown.push_back(&row);
  }
  if (shown.empty()) return {};
  const std::string name = free_name(folder, std::filesystem::path(file).stem().string());
  if (const auto written = core::write_file(name + ".gwy", curves::gwy_bytes(image)); !written)
    return tl::unexpected(written.error());
  std::string modulus;
  for (std::size_t map = 0; map < shown.size(); ++map) {
    const auto picture = exhibit::picture_of(image, map, shown[map]->striped ? style : exhibit::PictureStyle{});
    const std::string path = fmt::format("{}-{}.png", name, shown[map]->word);
    const auto written = render::write_png(picture, path, exhibit::picture_texts(image, map));
    if (!written) return tl::unexpected(written.error());
    if (shown[map] == &kMaps.front()) modulus = core::read_file(path).value_or("");
  }
  return modulus;
}

}  // namespace afm::app
