// SPDX-License-Identifier: Apache-2.0
#include "curves/live_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "curves/curve_map.h"
#include "curves/felt_swing.h"
#include "curves/recorded_curve.h"
#include "physics/adhesion_map.h"
#include "physics/force_model.h"
#include "physics/quantity_text.h"

namespace afm::curves {

namespace {

using physics::Law;

constexpr double kOctavesOfStep = 0.25;
constexpr physics::Pressure kStiffestModulus{1e12};  // first modulus on the way down from "rigid"
constexpr int kDigits = 3;
constexpr int kMostSteps = 200;  // limit far beyond the range of any law
constexpr double kPointsOfCycle = 400.0;

// Laws in the panel's order; empty means the choice of the adhesion map.
std::span<const std::optional<Law>> choices_of_law() {
  static const auto choices = [] {
    std::vector<std::optional<Law>> all{std::nullopt};
    for (const Law law : physics::laws_with(&physics::LawTraits::computed)) all.emplace_back(law);
    return all;
  }();
  return choices;
}

// Predicted cycle over the range of the force panel.
physics::ForceCurve predict(const SampleModel& material) {
  const double reach = cycle_reach_m(material);
  const physics::Length from(kReachAbove * reach), to(-kReachBelow * reach);
  return physics::record_curve(physics::ApproachRetractModel(material.tables),
                               {.from = from, .to = to, .step = (from - to) / kPointsOfCycle});
}

}  // namespace

double cycle_reach_m(const SampleModel& material) { return material.scaling.release_z_m(); }

LiveParameters::LiveParameters(const SampleModel& loaded) : loaded_(loaded), now_(loaded), curve_(predict(loaded)) {}

std::span<const LiveParameters::Row> LiveParameters::rows() const {
  static constexpr std::array kOfLaw{Row::TipRadius,      Row::SpringConstant, Row::Hamaker,
                                     Row::WorkOfAdhesion, Row::ReducedModulus, Row::Law};
  static constexpr std::array kOfMap{Row::PixelColumn, Row::PixelRow};
  if (loaded_.felt_map) return {};
  if (loaded_.pixel) return kOfMap;
  if (loaded_.parameters.law == Law::Measured) return {};
  return kOfLaw;
}

std::optional<Law> LiveParameters::law_after(int steps) const {
  const std::optional<Law> first = loaded_.setup.model.automatic ? std::nullopt : std::optional(loaded_.parameters.law);
  const auto choices = choices_of_law();
  const auto place = std::find(choices.begin(), choices.end(), first) - choices.begin();
  return choices[static_cast<std::size_t>(place + steps) % choices.size()];
}

std::optional<MapPlace> LiveParameters::place_after(const Steps& steps) const {
  const auto moved = [&](std::size_t from, Row row) { return from + static_cast<std::size_t>(steps[index(row)]); };
  const MapCurve& loaded = *loaded_.pixel;
  // left of the first column or below the first row lies a huge number
  const MapPlace place{moved(loaded.place.column, Row::PixelColumn), moved(loaded.place.row, Row::PixelRow)};
  return loaded.map->holds(place) ? std::optional(place) : std::nullopt;
}

bool LiveParameters::take_pixel(const Steps& steps) {
  const auto place = place_after(steps);
  if (!place) {
    refusal_ = "the map ends here";
    return false;
  }
  auto model = make_sample_model(loaded_.pixel->map, *place, loaded_.setup.material);
  if (!model) {
    refusal_ = model.error().message;
    return false;
  }
  model->parameters.height_field = loaded_.parameters.height_field;
  model->parameters.topography = loaded_.parameters.topography;
  model->parameters.surface_release_m = loaded_.parameters.surface_release_m;
  curve_ = predict(*model);
  now_ = std::move(*model);
  steps_ = steps;
  refusal_.clear();
  return true;
}

core::Result<void> LiveParameters::choose(const MapPlace& place) {
  const auto away = [](std::size_t to, std::size_t from) { return static_cast<int>(to) - static_cast<int>(from); };
  Steps next{};
  next[index(Row::PixelColumn)] = away(place.column, loaded_.pixel->place.column);
  next[index(Row::PixelRow)] = away(place.row, loaded_.pixel->place.row);
  refused_.reset();
  refused_direction_ = 0;
  if (next == steps_ || take(next)) return {};
  return core::failure(core::ErrorCategory::BadInputFile, std::exchange(refusal_, {}));
}

bool LiveParameters::take(const Steps& steps) {
  if (loaded_.pixel) return take_pixel(steps);
  const auto scaled = [&](Row row, auto quantity) {
    quantity.si *= std::exp2(kOctavesOfStep * steps[index(row)]);
    return quantity;
  };
  scene::SharedContact parameters = loaded_.parameters;
  physics::ContactParameters& in = parameters.contact;
  in.tip_radius = scaled(Row::TipRadius, in.tip_radius);
  in.spring_constant = scaled(Row::SpringConstant, in.spring_constant);
  in.hamaker = scaled(Row::Hamaker, in.hamaker);
  in.mean_surface_energy = scaled(Row::WorkOfAdhesion, in.mean_surface_energy);
  const bool softened = std::isinf(in.reduced_modulus.si) && steps[index(Row::ReducedModulus)] < 0;
  in.reduced_modulus = scaled(Row::ReducedModulus, softened ? kStiffestModulus : in.reduced_modulus);
  try {
    parameters.law = law_after(steps[index(Row::Law)]).value_or(physics::choose_law(in).law);
    auto model = make_sample_model(loaded_.setup.material, parameters, {});
    if (!model) {
      refusal_ = model.error().message;
      return false;
    }
    refusal_ = why_swing_is_lost(*model);
    if (!refusal_.empty()) return false;
    curve_ = predict(*model);
    model->setup = loaded_.setup;
    now_ = std::move(*model);
  } catch (const std::invalid_argument& why) {
    refusal_ = why.what();
    return false;
  }
  steps_ = steps;
  refusal_.clear();
  return true;
}

bool LiveParameters::step(Row row, int direction) {
  const bool changed = try_step(row, direction);
  const bool refused = !changed && !refusal_.empty();
  refused_ = refused ? std::optional(row) : std::nullopt;
  refused_direction_ = refused ? direction : 0;
  return changed;
}

bool LiveParameters::restore(const State& state) {
  const auto laws = static_cast<int>(choices_of_law().size());
  for (std::size_t i = 0; i < kRows; ++i) {
    const auto row = static_cast<Row>(i);
    const int steps = state.steps[i];
    const int most = loaded_.pixel ? static_cast<int>(kMostMapSide) : kMostSteps;
    const bool known = row == Row::Law ? steps >= 0 && steps < laws : std::abs(steps) <= most;
    const bool has_row = std::find(rows().begin(), rows().end(), row) != rows().end();
    if (!known || (!has_row && steps != 0)) return false;
  }
  if (state.refused && std::find(rows().begin(), rows().end(), *state.refused) == rows().end()) return false;
  if (state.steps != steps_ && !take(state.steps)) return false;
  refusal_.clear();
  refused_.reset();
  refused_direction_ = 0;
  if (state.refused) step(*state.refused, state.refused_direction > 0 ? 1 : -1);
  return true;
}

bool LiveParameters::try_step(Row row, int direction) {
  Steps next = steps_;
  int& steps = next[index(row)];
  if (loaded_.pixel) {
    std::optional<MapPlace> place;
    do {
      steps += direction;
      place = place_after(next);
    } while (place && !loaded_.pixel->map->has_curve(*place));
    return take(next);
  }
  if (row != Row::Law) {
    steps += direction;
    const bool stiffer_than_rigid = std::isinf(loaded_.parameters.contact.reduced_modulus.si) && steps > 0;
    return !(row == Row::ReducedModulus && stiffer_than_rigid) && take(next);
  }
  // the next law that is valid for these parameters
  const auto count = static_cast<int>(choices_of_law().size());
  for (int tries = 1; tries < count; ++tries) {
    steps = (steps + direction + count) % count;
    if (take(next)) return true;
  }
  return false;
}

bool LiveParameters::reset() {
  if (!changed()) return false;
  now_ = loaded_;
  curve_ = predict(loaded_);
  steps_ = {};
  refusal_.clear();
  refused_.reset();
  refused_direction_ = 0;
  return true;
}

std::string typographic(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "\u2212");
  if (text.ends_with("m2")) text.replace(text.size() - 1, 1, "\u00b2");
  if (const std::size_t micro = text.find(" u"); micro != std::string::npos) text.replace(micro + 1, 1, "\u00b5");
  return text;
}

std::string LiveParameters::value(Row row) const {
  const physics::ContactParameters& in = now_.parameters.contact;
  switch (row) {
    case Row::TipRadius:
      return typographic(format_quantity(in.tip_radius, physics::kLengthUnits, kDigits));
    case Row::SpringConstant:
      return format_quantity(in.spring_constant, physics::kStiffnessUnits, kDigits);
    case Row::Hamaker:
      return format_quantity(in.hamaker, physics::kEnergyUnits, kDigits);
    case Row::WorkOfAdhesion:
      return typographic(format_quantity(2.0 * in.mean_surface_energy, physics::kSurfaceEnergyUnits, kDigits));
    case Row::ReducedModulus:
      return std::isfinite(in.reduced_modulus.si)
                 ? format_quantity(in.reduced_modulus, physics::kPressureUnits, kDigits)
                 : "rigid";
    case Row::PixelColumn:
      return fmt::format("{}", now_.pixel->place.column);
    case Row::PixelRow:
      return fmt::format("{}", now_.pixel->place.row);
    case Row::Law:
      break;
  }
  return fmt::format("{}{}", automatic_law() ? "auto: " : "", law_name(now_.parameters));
}

}  // namespace afm::curves
