// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cstdint>
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

// The field of a keyword; null if there is none. The tip is named as in a contact.
const curves::SyntheticField* field_of(std::string_view option) {
  const std::string_view name = option == "tip-radius" ? std::string_view("radius") : option;
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
    const curves::QuantityDomain domain{field->units->sort, field->units->units,
                                        curves::QuantityRange<double>{field->smallest, field->largest}};
    const std::string refusal = curves::refusal(si, physics::format_si(si, domain.units), domain);
    if (!refusal.empty()) refuse(fmt::format("--{}: {}", field->option, refusal));
    numbers.push_back({field, si});
  }
  return numbers;
}

py::tuple generate(const std::optional<std::string>& law, std::size_t count, std::optional<std::size_t> points,
                   std::optional<std::uint32_t> seed, const std::optional<std::string>& base, const py::kwargs& given) {
  curves::SyntheticSetup setup;
  if (law) setup.shape = row_named(fits::kShapes, *law, "law").shape;
  if (base) setup.base = row_named(fits::kBases, *base, "base").base;
  setup.seed = seed.value_or(setup.seed);
  setup.points = points.value_or(setup.points);
  if (setup.points < curves::kFewestSyntheticPoints || setup.points > curves::kMostSyntheticPoints) {
    refuse(fmt::format("points: {} is outside {} to {}", setup.points, curves::kFewestSyntheticPoints,
                       curves::kMostSyntheticPoints));
  }
  if (count == 0 || count > curves::kMostSyntheticPoints) {
    refuse(fmt::format("count: {} is outside 1 to {}", count, curves::kMostSyntheticPoints));
  }
  value_of(curves::apply(given_numbers(given), setup));
  curves::SyntheticFile file =
      value_of(long_work([setup, count](const std::stop_token&) { return curves::synthetic_curves(setup, count); }));
  std::vector<Curve> made;
  made.reserve(file.curves.size());
  for (curves::RecordedCurve& curve : file.curves) made.push_back({"generated", std::move(curve)});
  return py::make_tuple(std::move(made), dict_of_text(file.truth));
}

}  // namespace

void add_synthetic(py::module_& module) {
  module.def(
      "generate", &generate, py::arg("law") = py::none(), py::kw_only(), py::arg("count") = 1,
      py::arg("points") = py::none(), py::arg("seed") = py::none(), py::arg("base") = py::none(),
      "Curves as an instrument records them and their truth, as touchafm generate curve makes them: a list of\n"
      "Curve, and the dict of the truth file.\n\n"
      "Numbers in SI, with the names of the command's options: modulus, tip_radius, spring_constant, most_force,\n"
      "noise, ... The same seed gives the same bytes. Raises ValueError as the command refuses its options.");
}

}  // namespace afm::python
