// SPDX-License-Identifier: Apache-2.0
#include "curves/tapping/tapping_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <variant>

#include "core/log.h"
#include "curves/viscosity_units.h"
#include "physics/quantity_text.h"
#include "physics/tapping/swing_map.h"
#include "physics/van_der_waals.h"

namespace afm::curves {
namespace {

using core::wrong_usage;

constexpr double kDefaultRows = 400.0;
constexpr const char* kInsteadOfAverages = "take direct, or in place of a sweep, which averages, a curve of this point";

template <class Q>
core::Result<Q> read_quantity(const char* option, const std::string& text, const physics::UnitList<Q>& units) {
  const auto parsed = physics::parse_quantity(text, units);
  if (!parsed.value) return wrong_usage(fmt::format("{}: {}", option, parsed.error));
  return *parsed.value;
}

// Quantity in a text, or the default if the text is empty.
template <class Q>
core::Result<Q> read_quantity_or(const char* option, const std::string& text, const physics::UnitList<Q>& units,
                                 Q fallback) {
  if (text.empty()) return fallback;
  return read_quantity(option, text, units);
}

core::Result<physics::Viscosity> read_viscosity(const std::string& text) {
  if (text.empty()) return physics::Viscosity();
  const auto parsed = physics::parse_si(text, "a viscosity", kViscosityUnits, physics::Infinity::Refused);
  if (const auto* error = std::get_if<std::string>(&parsed)) return wrong_usage("--viscosity: " + *error);
  return physics::Viscosity(std::get<double>(parsed));
}

core::Result<physics::SweepPlan> read_plan(const PathOptions& path, physics::Length from, physics::Length to) {
  physics::SweepPlan plan;
  const auto start = read_quantity_or("--from", path.from, physics::kLengthUnits, from);
  if (!start) return tl::unexpected(start.error());
  const auto end = read_quantity_or("--to", path.to, physics::kLengthUnits, to);
  if (!end) return tl::unexpected(end.error());
  plan.from = *start;
  plan.to = *end;
  const auto step = read_quantity_or("--step", path.step, physics::kLengthUnits, (plan.from - plan.to) / kDefaultRows);
  if (!step) return tl::unexpected(step.error());
  plan.step = *step;
  return plan;
}

core::Result<physics::TapMethod> read_method(const std::string& text, const physics::DrivenLever& lever) {
  const bool averages = lever.quality_factor >= physics::AveragedFlow::kLeastQuality;
  if (text.empty()) return averages ? physics::TapMethod::Averaged : physics::TapMethod::Direct;
  if (text == "direct") return physics::TapMethod::Direct;
  if (averages) return physics::TapMethod::Averaged;
  return wrong_usage(fmt::format("--method averaged needs a quality factor of at least {:g}, not {:g}; {}",
                                 physics::AveragedFlow::kLeastQuality, lever.quality_factor, kInsteadOfAverages));
}

// States from both starts by direct integration, or all states of the averaged flow; `complete`: plus those that only
// direct integration finds.
std::vector<TapStateRow> states_at(const std::shared_ptr<const physics::TapSurface>& surface,
                                   const physics::DrivenLever& lever, physics::TapMethod method, bool complete,
                                   physics::Length z) {
  std::vector<TapStateRow> rows;
  const auto add = [&](const char* start, const physics::RestingTap& tap,
                       std::optional<physics::DirectSwing> swing = std::nullopt) {
    rows.push_back({start, tap, physics::cleveland_energy(lever, tap.state.amplitude, tap.state.phase), swing});
  };
  const auto add_direct = [&](const char* start, const physics::DirectSwing& swing) {
    add(start, physics::resting_tap(swing), swing);
  };
  if (method == physics::TapMethod::Averaged) {
    physics::AveragedFlow flow(surface, lever);
    std::vector<physics::TapState> averaged;
    for (const physics::RestingTap& tap : flow.resting_at(z)) {
      averaged.push_back(tap.state);
      add("", tap);
    }
    if (!complete) return rows;
    physics::SwingMap map(surface, lever);
    for (const physics::DirectSwing& swing : map.stable_beside(averaged, z)) add_direct("", swing);
    std::sort(rows.begin(), rows.end(),
              [](const TapStateRow& a, const TapStateRow& b) { return a.tap.state.amplitude < b.tap.state.amplitude; });
    return rows;
  }
  physics::TappingOscillator tip(surface, lever);
  tip.place(z, {lever.free_amplitude, lever.free_phase});
  add_direct("free swing", tip.settle());
  tip.place(z, {});
  add_direct("rest", tip.settle());
  return rows;
}

core::Result<physics::DrivenLever> read_lever(const ContactSetup& setup, const TappingOptions& options) {
  const auto& [contact, lever] = std::tie(setup.material.contact, setup.material.lever);
  const auto amplitude = read_quantity("--free-amplitude", options.free_amplitude, physics::kLengthUnits);
  if (!amplitude) return tl::unexpected(amplitude.error());
  const auto drive = read_quantity_or("--drive", options.drive, physics::kFrequencyUnits, lever.resonance);
  if (!drive) return tl::unexpected(drive.error());
  return physics::driven_lever(contact.spring_constant, lever, {*amplitude, *drive});
}

// Curve that its watch has ended.
struct EndedTapping {
  std::size_t done, all;
};

// Callback that logs progress once a second for a curve that takes longer.
physics::TapProgress watched_progress(const TapWatch& watch) {
  return [&watch, told = std::chrono::steady_clock::now()](std::size_t done, std::size_t all) mutable {
    if (watch && !watch(done, all)) throw EndedTapping{done, all};
    const auto now = std::chrono::steady_clock::now();
    if (now - told < std::chrono::seconds(1)) return;
    told = now;
    core::log_line(fmt::format("tapping curve: {} of {} heights, {} %", done, all, 100 * done / all));
  };
}

core::Result<void> compute(const PathOptions& path, const TappingOptions& options, const TapWatch& watch,
                           TappingRun& run) {
  const auto& contact = run.setup.material.contact;
  const auto lever = read_lever(run.setup, options);
  if (!lever) return tl::unexpected(lever.error());
  run.lever = *lever;
  const auto method = read_method(options.method, run.lever);
  if (!method) return tl::unexpected(method.error());
  run.method = *method;
  const auto surface =
      std::make_shared<const physics::TapSurface>(run.setup.law(), contact, run.setup.law_options, run.viscosity);
  if (!options.at.empty()) {
    const auto at = read_quantity("--at", options.at, physics::kLengthUnits);
    if (!at) return tl::unexpected(at.error());
    run.at = *at;
    run.states = states_at(surface, run.lever, run.method, options.method.empty(), *at);
    return {};
  }
  const auto [from, to] = usual_tap_path(run.lever.free_amplitude);
  const auto plan = read_plan(path, from, to);
  if (!plan) return tl::unexpected(plan.error());
  run.path.plan = *plan;
  run.path.only_at_rest = options.method.empty();
  if (!path.speed.empty()) {
    const auto speed = read_quantity("--speed", path.speed, physics::kVelocityUnits);
    if (!speed) return tl::unexpected(speed.error());
    run.path.speed = *speed;
  }
  run.curve = physics::record_tapping_curve(surface, run.lever, run.path, run.method, watched_progress(watch));
  if (run.curve.lost_at) {
    run.averages_lost_at = run.curve.lost_at;
    const std::string where = physics::format_quantity(*run.averages_lost_at, physics::kLengthUnits);
    if (!options.method.empty()) {
      return wrong_usage(
          fmt::format("--method averaged: no averages follow the swing at {}; {}", where, kInsteadOfAverages));
    }
    core::log_line(fmt::format("no averages follow the swing at {}: integrating directly, which takes longer", where));
    run.method = physics::TapMethod::Direct;
    run.curve = physics::record_tapping_curve(surface, run.lever, run.path, run.method, watched_progress(watch));
  }
  const auto& rows = run.curve.points;
  const auto restless = std::count_if(rows.begin(), rows.end(), [](const auto& row) { return !row.repeats; });
  if (restless > 0) {
    core::log_line(fmt::format("at {} of {} heights the swing does not repeat from one period to the next", restless,
                               rows.size()));
  }
  return {};
}

core::Result<void> compute(const PathOptions& path, const TappingOptions& options, const TapWatch& /*watch*/,
                           FrequencyShiftRun& run) {
  const auto& [contact, lever] = std::tie(run.setup.material.contact, run.setup.material.lever);
  const auto amplitude = read_quantity("--amplitude", options.amplitude, physics::kLengthUnits);
  if (!amplitude) return tl::unexpected(amplitude.error());
  run.amplitude = *amplitude;
  const physics::TapSurface surface(run.setup.law(), contact, run.setup.law_options, run.viscosity);
  if (!options.at.empty()) {
    const auto at = read_quantity("--at", options.at, physics::kLengthUnits);
    if (!at) return tl::unexpected(at.error());
    run.at = *at;
    run.curve.points = {physics::frequency_shift_at(surface, lever.resonance, *amplitude, *at)};
    return {};
  }
  const auto plan = read_plan(path, *amplitude + physics::Length(5e-9), *amplitude - physics::Length(1e-9));
  if (!plan) return tl::unexpected(plan.error());
  run.plan = *plan;
  run.curve = physics::record_frequency_shift(surface, lever.resonance, *amplitude, *plan);
  return {};
}

// Computes both modes' common steps: model, checks and the viscosity; then the mode's own.
template <class Run>
core::Result<Run> computed(const ContactSetup& setup, const PathOptions& path, const TappingOptions& options,
                           const TapWatch& watch = {}) {
  Run run{};
  run.setup = setup;
  const auto viscosity = read_viscosity(options.viscosity);
  if (!viscosity) return tl::unexpected(viscosity.error());
  run.viscosity = *viscosity;
  try {
    physics::validate(setup.material.contact);
    run.place = setup.place();
    run.model = setup.used_model();
    if (const auto done = compute(path, options, watch, run); !done) return tl::unexpected(done.error());
  } catch (const std::invalid_argument& error) {
    return wrong_usage(error.what());
  } catch (const EndedTapping& ended) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("the tapping curve was ended after {} of {} heights", ended.done, ended.all));
  }
  return run;
}

}  // namespace

UsualTapPath usual_tap_path(physics::Length free_amplitude) {
  return {free_amplitude + std::max(physics::Length(2e-9), 0.1 * free_amplitude), 0.1 * free_amplitude};
}

core::Result<physics::SurfaceEnergy> work_of_adhesion_for(const ContactSetup& setup, physics::Length contact_gap) {
  const physics::ContactParameters& contact = setup.material.contact;
  // range of an atomic distance, down to where no sphere is smaller
  if (!(contact_gap >= physics::Length(1e-11) && contact_gap <= physics::Length(5e-9))) {
    return wrong_usage(fmt::format("--contact-gap: {} is not within 10 pm to 5 nm",
                                   physics::format_quantity(contact_gap, physics::kLengthUnits)));
  }
  const physics::VanDerWaals attraction(contact.hamaker, contact.tip_radius, setup.law_options);
  return -attraction.force(contact_gap) / (2.0 * std::numbers::pi * contact.tip_radius);
}

core::Result<DrivenSample> driven_sample(const ContactSetup& setup, const TappingOptions& options) {
  const auto viscosity = read_viscosity(options.viscosity);
  if (!viscosity) return tl::unexpected(viscosity.error());
  try {
    physics::validate(setup.material.contact);
    const auto lever = read_lever(setup, options);
    if (!lever) return tl::unexpected(lever.error());
    return DrivenSample{
        std::make_shared<const physics::TapSurface>(setup.law(), setup.material.contact, setup.law_options, *viscosity),
        *lever, *viscosity};
  } catch (const std::invalid_argument& error) {
    return wrong_usage(error.what());
  }
}

core::Result<TappingRun> run_tapping(const ContactSetup& setup, const PathOptions& path, const TappingOptions& options,
                                     const TapWatch& watch) {
  return computed<TappingRun>(setup, path, options, watch);
}

core::Result<FrequencyShiftRun> run_frequency_shift(const ContactSetup& setup, const PathOptions& path,
                                                    const TappingOptions& options) {
  return computed<FrequencyShiftRun>(setup, path, options);
}

}  // namespace afm::curves
