// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "curves/quantity_domain.h"
#include "curves/synthetic_curve.h"
#include "python/bindings.h"
#include "python/curve.h"
#include "python/errors.h"
#include "python/json.h"
#include "python/long_work.h"
#include "python/named_row.h"
#include "python/numbers.h"

namespace afm::python {

namespace {

namespace py = pybind11;

// The field of a keyword; null if there is none. The tip is named as in a contact, E and W as in a fit.
const curves::SyntheticField* field_of(std::string_view option) {
  std::string_view name = option;
  if (option == "tip-radius") name = "radius";
  if (option == "E") name = "modulus";
  if (option == "W") name = "work-of-adhesion";
  for (const curves::SyntheticField& field : curves::kSyntheticFields) {
    if (field.option == name && option != "radius") return &field;
  }
  return nullptr;
}

std::vector<curves::GivenNumber> given_numbers(const py::kwargs& given) {
  std::vector<curves::GivenNumber> numbers;
  for (const auto& [option, si] : numbers_of(given)) {
    const curves::SyntheticField* field = field_of(option);
    if (field == nullptr) unknown_keyword("generate", keyword_of(option));
    for (const curves::GivenNumber& other : numbers) {
      if (other.field == field) refuse(fmt::format("{}: it is given twice; leave one out", keyword_of(option)));
    }
    const curves::QuantityDomain domain{field->units->sort, field->units->units,
                                        curves::QuantityRange<double>{field->smallest, field->largest}};
    const std::string refusal = curves::refusal(si, physics::format_si(si, domain.units), domain);
    if (!refusal.empty()) refuse(fmt::format("--{}: {}", field->option, refusal));
    numbers.push_back({field, si});
  }
  return numbers;
}

curves::SyntheticSetup setup_of(const std::optional<std::string>& law, const std::optional<Whole>& points,
                                const std::optional<Whole>& seed, const std::optional<std::string>& base,
                                const py::kwargs& given) {
  curves::SyntheticSetup setup;
  if (law) setup.shape = row_named(fits::kShapes, *law, "law").shape;
  if (base) setup.base = row_named(fits::kBases, *base, "base").base;
  constexpr std::uint32_t kMostSeed = std::numeric_limits<std::uint32_t>::max();
  if (seed) setup.seed = static_cast<std::uint32_t>(whole_within("seed", *seed, 0, kMostSeed));
  if (points) {
    setup.points = whole_within("points", *points, curves::kFewestSyntheticPoints, curves::kMostSyntheticPoints);
  }
  value_of(curves::apply(given_numbers(given), setup));
  return setup;
}

// Pair of the curves and the dict of the truth file.
py::tuple with_truth(curves::SyntheticFile file) {
  std::vector<Curve> made;
  made.reserve(file.curves.size());
  for (curves::RecordedCurve& curve : file.curves) made.push_back({"generated", std::move(curve)});
  return py::make_tuple(std::move(made), dict_of_text(file.truth));
}

py::tuple generate(const std::optional<std::string>& law, const std::optional<Whole>& given_count,
                   const std::optional<Whole>& n, const std::optional<Whole>& points, const std::optional<Whole>& seed,
                   const std::optional<std::string>& base, const py::kwargs& given) {
  if (given_count && n) refuse("count and n are the same; leave one out");
  const Whole one = std::uint64_t{1};
  const std::size_t count =
      whole_within(n ? "n" : "count", given_count.value_or(n.value_or(one)), 1, curves::kMostSyntheticPoints);
  return with_truth(
      value_of(long_work([setup = setup_of(law, points, seed, base, given), count](const std::stop_token&) {
        return curves::synthetic_curves(setup, count);
      })));
}

double legal(double si, const char* option, const physics::Units& units, const curves::QuantityRange<double>& range) {
  const std::string refusal =
      curves::refusal(si, physics::format_si(si, units.units), {units.sort, units.units, range});
  if (!refusal.empty()) refuse(fmt::format("--{}: {}", option, refusal));
  return si;
}

py::tuple generate_map(const std::optional<std::string>& law,
                       const std::optional<std::pair<std::size_t, std::size_t>>& pixels, std::optional<double> size,
                       const std::optional<std::string>& field, std::optional<double> second_modulus,
                       std::optional<double> second_work_of_adhesion, const std::optional<Whole>& points,
                       const std::optional<Whole>& seed, const std::optional<std::string>& base,
                       const py::kwargs& given) {
  curves::SyntheticMap map;
  const auto [columns, rows] = pixels.value_or(std::pair(curves::kUsualMapPixels, curves::kUsualMapPixels));
  const std::size_t least = std::min(columns, rows), most = std::max(columns, rows);
  if (least < 1 || most > curves::kMostMapPixels) {
    refuse(fmt::format("pixels: {} x {} is outside 1 to {}", columns, rows, curves::kMostMapPixels));
  }
  const double width_m = size ? legal(*size, "size", physics::kLengthUnits, curves::kMapWidthsM) : map.grid.width_m;
  map.grid = curves::map_grid(columns, rows, width_m);
  if (field) map.shape = row_named(curves::kFieldShapes, *field, "field").shape;
  if (second_modulus) {
    map.second_modulus_pa = legal(*second_modulus, "second-modulus", physics::kPressureUnits, curves::kMapModuliPa);
  }
  if (second_work_of_adhesion) {
    map.second_work_j_per_m2 = legal(*second_work_of_adhesion, "second-work-of-adhesion", physics::kSurfaceEnergyUnits,
                                     curves::kMapWorksJPerM2);
  }
  return with_truth(value_of(long_work([setup = setup_of(law, points, seed, base, given), map](const std::stop_token&) {
    return curves::synthetic_map(setup, map);
  })));
}

}  // namespace

void add_synthetic(py::module_& module) {
  module.def(
      "generate", &generate, py::arg("law") = py::none(), py::kw_only(), py::arg("count") = py::none(),
      py::arg("n") = py::none(), py::arg("points") = py::none(), py::arg("seed") = py::none(),
      py::arg("base") = py::none(),
      "Curves as an instrument records them and their truth, as touchafm generate curve makes them: a list of\n"
      "Curve, and the dict of the truth file.\n\n"
      "count, or n: number of curves, default 1. Numbers in SI, with the names of the command's options: modulus\n"
      "or E, work_of_adhesion or W, tip_radius, spring_constant, most_force, noise, ... The same seed gives the same "
      "bytes. Raises ValueError as the command refuses its options.\n"
      "docs/generate.md has the keys of the truth, docs/fits.md the equations with their sources.");
  module.def(
      "generate_map", &generate_map, py::arg("law") = py::none(), py::kw_only(), py::arg("pixels") = py::none(),
      py::arg("size") = py::none(), py::arg("field") = py::none(), py::arg("second_modulus") = py::none(),
      py::arg("second_work_of_adhesion") = py::none(), py::arg("points") = py::none(), py::arg("seed") = py::none(),
      py::arg("base") = py::none(),
      "A map of curves over a sample that differs from place to place, and its truth, as touchafm generate map makes\n"
      "them: a list of Curve, the bottom row first and each from the left, whose metadata has position and pixel, and\n"
      "the dict of the truth file.\n\n"
      "pixels: curves in x and y; size: width, m; field: \"uniform\", \"step\", \"gradient\" or \"islands\", with\n"
      "second_modulus, Pa, and second_work_of_adhesion, J/m2. The rest as for generate(). Raises ValueError as the\n"
      "command refuses its options. docs/generate.md has the keys of the truth, docs/fits.md the equations with their\n"
      "sources.");
}

}  // namespace afm::python
