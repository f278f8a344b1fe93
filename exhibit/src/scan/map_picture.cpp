// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/map_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/enumerators.h"
#include "curves/curve_map.h"
#include "curves/fitting/felt_map.h"
#include "curves/live_parameters.h"
#include "exhibit/models/height_colours.h"
#include "physics/quantity_text.h"
#include "scan/image_maps.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

namespace {

constexpr std::size_t kMostCells = 128;  // largest side of the grid; a pixel of a small map has several cells

// Number of cells for a number of pixels: whole multiples, or as many as are drawn.
std::size_t cells_of(std::size_t pixels) { return pixels >= kMostCells ? kMostCells : pixels * (kMostCells / pixels); }

// Range of the values without the outermost percent at each end.
Range inner_range(std::vector<double> values) {
  constexpr double kCutShare = 0.01;
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto cut = static_cast<std::size_t>(kCutShare * static_cast<double>(values.size()));
  return {values[cut], values[values.size() - 1 - cut], false};
}

// Pixels covered by one cell along a side.
struct Covered {
  std::size_t first = 0, end = 0;
};
Covered covered_by(std::size_t cell, std::size_t cells, std::size_t pixels) {
  const std::size_t first = cell * pixels / cells;
  return {first, std::max(first + 1, (cell + 1) * pixels / cells)};
}

// First value of a cell: a single curve among many pixels without one must be visible. NaN: none.
double value_in(const std::vector<double>& values, std::size_t pixels_across, const Covered& rows,
                const Covered& columns) {
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    for (std::size_t column = columns.first; column < columns.end; ++column) {
      const double value = values[row * pixels_across + column];
      if (std::isfinite(value)) return value;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

template <class Q>
std::string unit_text(Q quantity, const physics::UnitList<Q>& units, const Phrases& phrases) {
  constexpr int kDigits = 3;
  return phrases.number(curves::typographic(physics::format_quantity(quantity, units, kDigits)));
}

std::string height_text(double height_m, const Phrases& phrases) {
  return unit_text(physics::Length(height_m), physics::kLengthUnits, phrases);
}
std::string modulus_text(double modulus_pa, const Phrases& phrases) {
  return unit_text(physics::Pressure(modulus_pa), physics::kPressureUnits, phrases);
}
std::string adhesion_text(double adhesion_n, const Phrases& phrases) {
  return unit_text(physics::Force(adhesion_n), physics::kForceUnits, phrases);
}

double usable_modulus_pa(const curves::PixelFit& fit) {
  return fit.usable() ? fit.modulus_pa : std::numeric_limits<double>::quiet_NaN();
}
double pull_n(const curves::PixelFit& fit) { return fit.adhesion_n; }

// One quantity that the picture can show.
struct QuantityRow {
  MapQuantity quantity;
  std::string_view name;
  Phrase title;
  double least_range;                                         // smallest range of the colours: equal pixels look equal
  double (*value)(const curves::PixelFit& fit);               // value of a pixel; null: the height
  std::string (*text)(double value, const Phrases& phrases);  // value with its unit
};
constexpr std::array kQuantities{
    QuantityRow{MapQuantity::Height, "height", Phrase::MapHeights, kLeastRangeM, nullptr, height_text},
    QuantityRow{MapQuantity::Modulus, "modulus", Phrase::MapModulus, 1e-3, usable_modulus_pa, modulus_text},
    QuantityRow{MapQuantity::Adhesion, "adhesion", Phrase::MapAdhesion, 1e-15, pull_n, adhesion_text}};
static_assert(core::has_row_for_each(kQuantities, &QuantityRow::quantity));

std::vector<double> values_of(const curves::CurveMap& map, const QuantityRow& row) {
  if (row.value == nullptr) return map.heights_m();
  std::vector<double> values;
  values.reserve(map.fits().size());
  for (const curves::PixelFit& fit : map.fits()) values.push_back(row.value(fit));
  return values;
}

}  // namespace

MapQuantity first_quantity(const curves::CurveMap& map) {
  return map.fits().empty() ? MapQuantity::Height : MapQuantity::Modulus;
}

MapQuantity next_quantity(const curves::CurveMap& map, MapQuantity shown) {
  if (map.fits().empty()) return shown;
  return kQuantities[(core::index_of(shown) + 1) % kQuantities.size()].quantity;
}

std::string_view name_of(MapQuantity quantity) { return kQuantities[core::index_of(quantity)].name; }

std::optional<MapQuantity> map_quantity_of(std::string_view name) {
  const auto row = std::find_if(kQuantities.begin(), kQuantities.end(),
                                [&](const QuantityRow& candidate) { return candidate.name == name; });
  return row == kQuantities.end() ? std::nullopt : std::optional(row->quantity);
}

render::MapPicture map_picture(const curves::CurveMap& map, const curves::MapPlace& felt, const Phrases& phrases,
                               MapQuantity quantity) {
  const curves::MapGrid& pixels = map.grid();
  const QuantityRow& row = kQuantities[core::index_of(quantity)];
  const std::vector<double> values = values_of(map, row);
  const Range range = at_least(inner_range(values), row.least_range);
  // heights alone have an arbitrary zero
  const double zero = row.value == nullptr ? range.low : 0.0;
  render::MapPicture picture{.title = phrases[row.title],
                             .columns = static_cast<std::uint32_t>(pixels.columns),
                             .rows = static_cast<std::uint32_t>(pixels.rows),
                             .aspect = pixels.width_m / pixels.height_m,
                             .grid = {.columns = static_cast<std::uint32_t>(cells_of(pixels.columns)),
                                      .rows = static_cast<std::uint32_t>(cells_of(pixels.rows)),
                                      .colors = {}},
                             .marked = target_index(felt, map),
                             .bar = {},
                             .lowest = row.value == nullptr ? "0" : row.text(range.low, phrases),
                             .highest = row.text(range.high - zero, phrases)};
  for (std::size_t y = 0; y < picture.grid.rows; ++y) {
    const Covered rows = covered_by(y, picture.grid.rows, pixels.rows);
    for (std::size_t x = 0; x < picture.grid.columns; ++x) {
      const double value = value_in(values, pixels.columns, rows, covered_by(x, picture.grid.columns, pixels.columns));
      const auto [r, g, b] = height_colour((value - range.low) / (range.high - range.low));
      picture.grid.colors.push_back({r, g, b, 255});
    }
  }
  for (const Srgb& c : kHeightColours) picture.bar.push_back(glm::vec3(c[0], c[1], c[2]) / 255.0F);
  return picture;
}

std::vector<std::string> felt_map_notes(const curves::SampleModel& model, const scene::TipState& tip,
                                        const Phrases& phrases) {
  if (!model.felt_map || !(tip.here.reduced_modulus_pa > 0.0)) return {};
  const curves::FeltMap& map = *model.felt_map;
  const std::string modulus = modulus_text(tip.here.reduced_modulus_pa * (1.0 - map.poisson * map.poisson), phrases);
  const std::string adhesion =
      unit_text(physics::SurfaceEnergy(tip.here.adhesion_j_per_m2), physics::kSurfaceEnergyUnits, phrases);
  std::vector<std::string> notes{map.law == physics::Law::Hertz ? phrases.text<Phrase::MapHereModulus>(modulus)
                                                                : phrases.text<Phrase::MapHere>(modulus, adhesion)};
  const auto pixel = curves::pixel_below(model, tip.surface.xy_m);
  if (!pixel) {
    notes.push_back(phrases[Phrase::MapBeside]);
  } else if (const std::size_t cell = target_index(*pixel, *model.pixel->map); map.is_filled[cell]) {
    notes.push_back(phrases[Phrase::MapFilled]);
  } else if (model.pixel->map->fits()[cell].trust == fits::Trust::Doubtful) {
    notes.push_back(phrases[Phrase::MapDoubtful]);
  }
  return notes;
}

std::size_t target_index(const curves::MapPlace& place, const curves::CurveMap& map) {
  return (map.grid().rows - 1 - place.row) * map.grid().columns + place.column;
}

curves::MapPlace place_of(const render::ControlTarget& target, const curves::CurveMap& map) {
  const std::size_t columns = map.grid().columns, rows = map.grid().rows;
  const std::size_t from_top = target.index / columns;
  return {target.index % columns, from_top < rows ? rows - 1 - from_top : rows};
}

}  // namespace afm::exhibit
