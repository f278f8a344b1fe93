// SPDX-License-Identifier: Apache-2.0
#include "curves/fitting/felt_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include "curves/fitting/curve_fit.h"
#include "fits/indenter.h"
#include "haptics/contact_model.h"
#include "haptics/law_family.h"
#include "haptics/map_contact.h"
#include "haptics/simulated_device.h"
#include "physics/quantity_text.h"

namespace afm::curves {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastAdhesion = 1e-8;  // adhesion of a tip that does not stick, J/m2
constexpr double kWeakestShare = 1e-3;   // smallest adhesion of a map, as a share of its largest
constexpr double kHardlySticks = 0.02;   // faintest pull over the push at a depth of a tenth of the tip's radius
constexpr int kDigitsOfMap = 3;

// Law with which a fit's numbers are felt; empty: none.
std::optional<physics::Law> law_of(fits::Shape shape) {
  switch (shape) {
    case fits::Shape::Paraboloid:
    case fits::Shape::Sphere:
    case fits::Shape::Dmt:
      return physics::Law::Dmt;
    case fits::Shape::Jkr:
      return physics::Law::Jkr;
    default:
      return std::nullopt;
  }
}

// Values row by row from the top, NaN where there is none.
struct Field {
  std::size_t columns, rows;
  std::vector<double> values;

  double& at(std::size_t column, std::size_t row) { return values[row * columns + column]; }
};

// Fills every empty cell with the mean of its full neighbours, from the full ones outwards.
void fill(Field& field) {
  for (bool any = true; any;) {
    any = false;
    std::vector<std::pair<std::size_t, double>> found;
    for (std::size_t row = 0; row < field.rows; ++row) {
      for (std::size_t column = 0; column < field.columns; ++column) {
        if (!std::isnan(field.at(column, row))) continue;
        double sum = 0.0;
        int count = 0;
        for (std::size_t y = row > 0 ? row - 1 : 0; y <= std::min(row + 1, field.rows - 1); ++y) {
          for (std::size_t x = column > 0 ? column - 1 : 0; x <= std::min(column + 1, field.columns - 1); ++x) {
            if (std::isnan(field.at(x, y))) continue;
            sum += field.at(x, y);
            ++count;
          }
        }
        if (count > 0) found.emplace_back(row * field.columns + column, sum / count);
      }
    }
    for (const auto& [cell, value] : found) field.values[cell] = value;
    any = !found.empty();
  }
}

// Grid of square cells over the same area.
struct Square {
  std::uint32_t columns, rows;
  double spacing_m;
};

Square square_of(const MapGrid& grid) {
  const double most = scene::kMaxLawMapSide - 1;
  const double finest_m =
      std::min(grid.width_m / static_cast<double>(grid.columns), grid.height_m / static_cast<double>(grid.rows));
  const double spacing_m = std::max(finest_m, std::max(grid.width_m, grid.height_m) / most);
  const auto count = [&](double length_m) {
    return static_cast<std::uint32_t>(std::clamp(std::round(length_m / spacing_m), 2.0, most));
  };
  return {count(grid.width_m), count(grid.height_m), spacing_m};
}

// Mean of the pixels that a cell of the square grid covers, or the pixel at its middle; rows from the bottom.
std::vector<float> laid_on(const Square& square, const MapGrid& grid, const Field& field) {
  std::vector<float> laid;
  laid.reserve(std::size_t{square.columns} * square.rows);
  const auto covered = [](std::uint32_t cell, std::uint32_t cells, std::size_t pixels) {
    const std::size_t first = cell * pixels / cells;
    return std::pair(first, std::max(first + 1, (cell + std::size_t{1}) * pixels / cells));
  };
  for (std::uint32_t row = 0; row < square.rows; ++row) {
    const auto [bottom, top] = covered(row, square.rows, grid.rows);
    for (std::uint32_t column = 0; column < square.columns; ++column) {
      const auto [left, right] = covered(column, square.columns, grid.columns);
      double sum = 0.0;
      for (std::size_t y = bottom; y < top; ++y) {
        for (std::size_t x = left; x < right; ++x) sum += field.values[(grid.rows - 1 - y) * grid.columns + x];
      }
      laid.push_back(static_cast<float>(sum / static_cast<double>((top - bottom) * (right - left))));
    }
  }
  return laid;
}

double median_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Work of adhesion of a fit, or that of DMT's law for its pull.
double adhesion_of(const PixelFit& fit, double radius_m) {
  if (!std::isnan(fit.adhesion_j_per_m2)) return fit.adhesion_j_per_m2;
  return std::isnan(fit.adhesion_n) ? 0.0 : fit.adhesion_n / (2.0 * std::numbers::pi * radius_m);
}

scene::Topography heights_of(const CurveMap& map, const Square& square) {
  Field field{map.grid().columns, map.grid().rows, map.heights_m()};
  fill(field);
  scene::Topography heights{square.columns, square.rows, square.spacing_m, laid_on(square, map.grid(), field)};
  const auto at = [&](std::uint32_t column, std::uint32_t row) {
    return heights.height_m[std::size_t{row} * heights.columns + column];
  };
  const float middle_m =
      0.25F * (at((square.columns - 1) / 2, (square.rows - 1) / 2) + at(square.columns / 2, (square.rows - 1) / 2) +
               at((square.columns - 1) / 2, square.rows / 2) + at(square.columns / 2, square.rows / 2));
  for (float& height_m : heights.height_m) height_m -= middle_m;
  return heights;
}

}  // namespace

core::Result<FeltMap> felt_map(const CurveMap& map, const FitOptions& options) {
  const auto law = options.shape ? law_of(*options.shape) : std::nullopt;
  if (!law) {
    return core::wrong_usage(
        "a whole map is felt with one law: fit it with --fit dmt, jkr, paraboloid or sphere, or feel a --felt pixel");
  }
  FeltMap felt{.law = *law,
               .poisson = options.poisson,
               .laws = {},
               .heights = {},
               .grid = map.grid(),
               .is_filled = std::vector<bool>(map.fits().size(), true)};
  Field modulus{felt.grid.columns, felt.grid.rows, std::vector<double>(map.fits().size(), kNone)};
  Field adhesion = modulus;
  std::size_t usable = 0;
  for (std::size_t cell = 0; cell < map.fits().size(); ++cell) {
    const PixelFit& fit = map.fits()[cell];
    if (!fit.usable() || !(fit.modulus_pa > 0.0)) continue;
    modulus.values[cell] = std::log(fit.modulus_pa / (1.0 - options.poisson * options.poisson));
    adhesion.values[cell] = adhesion_of(fit, options.radius_m);
    felt.is_filled[cell] = false;
    ++usable;
  }
  felt.filled = map.fits().size() - usable;
  if (usable < kLeastFits || static_cast<double>(usable) < kLeastShare * static_cast<double>(map.fits().size())) {
    return core::wrong_usage(
        fmt::format("too few fits of the map can be trusted to feel it whole: {} of {} pixels, and it needs {} and a "
                    "quarter of all; choose another --fit, or feel a --felt pixel",
                    usable, map.fits().size(), kLeastFits));
  }
  if (felt.grid.columns < 2 || felt.grid.rows < 2) {
    return core::wrong_usage("a single row of curves is not felt whole: feel a --felt pixel");
  }
  const double push_n =
      4.0 / 3.0 * std::exp(median_of(modulus.values)) * std::pow(0.1, 1.5) * options.radius_m * options.radius_m;
  const double pull_n = 2.0 * std::numbers::pi * options.radius_m * median_of(adhesion.values);
  const bool sticks = pull_n > kHardlySticks * push_n;
  if (!sticks) felt.law = physics::Law::Hertz;
  fill(modulus);
  fill(adhesion);
  const double strongest = *std::max_element(adhesion.values.begin(), adhesion.values.end());
  for (double& each : adhesion.values) {
    each = sticks ? std::max({each, kLeastAdhesion, kWeakestShare * strongest}) : kLeastAdhesion;
  }
  const Square square = square_of(felt.grid);
  felt.laws.columns = square.columns;
  felt.laws.rows = square.rows;
  felt.laws.spacing_m = square.spacing_m;
  std::ranges::copy(laid_on(square, felt.grid, modulus), felt.laws.ln_modulus.begin());
  std::ranges::copy(laid_on(square, felt.grid, adhesion), felt.laws.adhesion_j_per_m2.begin());
  felt.heights = heights_of(map, square);
  return felt;
}

core::Result<SampleModel> make_sample_model(const SampleModel& pixel, const FitOptions& options,
                                            std::shared_ptr<const ForceVolume> volume) {
  const std::string& path = pixel.pixel->map->path();
  const auto cannot = [&](const core::Error& error) {
    return core::failure(error.category, fmt::format("force map {}: {}", path, error.message));
  };
  auto felt = felt_map(*pixel.pixel->map, options);
  if (!felt) return cannot(felt.error());
  felt->volume = std::move(volume);
  const auto middle = [&](std::span<const float> values) {
    const auto some = values.first(std::size_t{felt->laws.columns} * felt->laws.rows);
    return median_of({some.begin(), some.end()});
  };
  SampleModel model = pixel;
  model.setup.model.law = felt->law;
  scene::SharedContact& parameters = model.parameters;
  parameters.law = felt->law;
  parameters.measured_curve = scene::kNoMeasuredCurve;
  parameters.law_map = 1;
  parameters.contact.tip_radius = physics::Length(options.radius_m);
  if (options.atomic_distance_m) parameters.contact.atomic_distance = physics::Length(*options.atomic_distance_m);
  parameters.contact =
      haptics::contact_with(parameters.contact, physics::Pressure(std::exp(middle(felt->laws.ln_modulus))),
                            middle(felt->laws.adhesion_j_per_m2));
  auto tables = haptics::build_tables(parameters, {});
  if (!tables) return cannot(tables.error());
  const auto family = haptics::LawFamily::create(parameters, felt->laws);
  if (!family) return cannot(family.error());
  const auto scaling =
      haptics::Scaling::fit((*family)->laws(), haptics::MapContact::along_normal(haptics::SimulatedDevice().spec()));
  if (!scaling) return cannot(scaling.error());
  model.tables = std::move(*tables);
  model.scaling = *scaling;
  model.contact = physics::choose_law(parameters.contact);
  model.setup.material.title = title_of(path);
  model.felt_map = std::make_shared<const FeltMap>(std::move(*felt));
  return model;
}

std::optional<MapPlace> pixel_below(const SampleModel& model, const std::array<double, 2>& xy_m) {
  const MapGrid& grid = model.felt_map->grid;
  const double size =
      model.parameters.topography.lateral * scene::surface_scale(model.parameters, model.scaling.release_z_m());
  const double x = (xy_m[0] / (size * grid.width_m) + 0.5) * static_cast<double>(grid.columns);
  const double y = (xy_m[1] / (size * grid.height_m) + 0.5) * static_cast<double>(grid.rows);
  // written so that NaN is outside
  const bool within =
      x >= 0.0 && y >= 0.0 && x < static_cast<double>(grid.columns) && y < static_cast<double>(grid.rows);
  if (!within) return std::nullopt;
  return MapPlace{static_cast<std::size_t>(x), static_cast<std::size_t>(y)};
}

std::string felt_text(const FeltMap& map) {
  const std::size_t count = std::size_t{map.laws.columns} * map.laws.rows;
  const auto [soft, stiff] = std::ranges::minmax(std::span(map.laws.ln_modulus).first(count));
  const auto [weak, strong] = std::ranges::minmax(std::span(map.laws.adhesion_j_per_m2).first(count));
  const auto modulus = [&](float ln_modulus) {
    const physics::Pressure young(std::exp(static_cast<double>(ln_modulus)) * (1.0 - map.poisson * map.poisson));
    return physics::format_quantity(young, physics::kPressureUnits, kDigitsOfMap);
  };
  const auto adhesion = [](float j_per_m2) {
    return physics::format_quantity(physics::SurfaceEnergy(static_cast<double>(j_per_m2)), physics::kSurfaceEnergyUnits,
                                    kDigitsOfMap);
  };
  std::string text = fmt::format("E {} to {}", modulus(soft), modulus(stiff));
  text += map.law == physics::Law::Hertz ? std::string(", the tip hardly sticks")
                                         : fmt::format(", W {} to {}", adhesion(weak), adhesion(strong));
  return text + fmt::format(", law {}; {} of {} pixels are filled from their neighbours", physics::name_of(map.law),
                            map.filled, map.is_filled.size());
}

}  // namespace afm::curves
