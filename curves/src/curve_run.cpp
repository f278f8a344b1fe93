// SPDX-License-Identifier: Apache-2.0
#include "curves/curve_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "physics/curve_analysis.h"
#include "physics/direction_rule.h"
#include "physics/dynamic_curve.h"
#include "physics/dynamic_model.h"
#include "physics/force_model.h"
#include "physics/law_tables.h"
#include "physics/quantity_text.h"

namespace afm::curves {
namespace {

using core::wrong_usage;

template <class Q>
core::Result<Q> parse_option(const char* option, const std::string& text, const physics::UnitList<Q>& units) {
  const auto parsed = physics::parse_quantity(text, units);
  if (!parsed.value) return wrong_usage(fmt::format("{}: {}", option, parsed.error));
  return *parsed.value;
}

physics::Length default_start(const physics::CycleFigures& figures) {
  const double above = std::max(1.1 * figures.z_joc.si, figures.z_jtc.si + 5e-9);
  return physics::Length(std::ceil(above * 1e9) / 1e9);
}

// Default turning point, deep enough for the sample to push: a soft, sticky one must be pressed by far more than 5 nm.
physics::Length default_end(const physics::LawTables& tables) {
  physics::Length end(-5e-9);
  for (int i = 0; i < 40 && tables.attached.force(end).si <= 0.0; ++i) end = 1.25 * end;
  return physics::Length(std::floor(end.si * 1e9 + 1e-6) / 1e9);
}

constexpr double kMostDefaultSteps = 20'000;
// Limit of the steps if only the events are needed but depend on the samples.
constexpr double kMostEventSteps = 2e5;

physics::SweepPlan no_finer_than(physics::SweepPlan plan, double steps) {
  plan.step = std::max(plan.step, (plan.from - plan.to) / steps);
  return plan;
}

core::Result<physics::SweepPlan> sweep_plan(const PathOptions& path, const physics::LawTables& tables) {
  const physics::CycleFigures& figures = tables.figures;
  physics::SweepPlan plan;
  plan.from = default_start(figures);
  if (!path.from.empty()) {
    const auto from = parse_option("--from", path.from, physics::kLengthUnits);
    if (!from) return tl::unexpected(from.error());
    plan.from = *from;
  }
  plan.to = default_end(tables);
  if (!path.to.empty()) {
    const auto to = parse_option("--to", path.to, physics::kLengthUnits);
    if (!to) return tl::unexpected(to.error());
    plan.to = *to;
  }
  plan.step = physics::Length(std::max(1e-11, (plan.from - plan.to).si / kMostDefaultSteps));
  if (!path.step.empty()) {
    const auto step = parse_option("--step", path.step, physics::kLengthUnits);
    if (!step) return tl::unexpected(step.error());
    plan.step = *step;
  }
  return plan;
}

core::Result<physics::Velocity> ramp_speed(const PathOptions& path) {
  if (path.speed.empty()) return physics::Velocity(1e-6);
  auto speed = parse_option("--speed", path.speed, physics::kVelocityUnits);
  if (speed && !(speed->si > 0.0)) return wrong_usage(fmt::format("--speed: {} is not positive", path.speed));
  return speed;
}

core::Result<void> sweep_static(const PathOptions& path, CurveRun& run) {
  if (!path.speed.empty()) {
    return wrong_usage(fmt::format("--speed has no effect on model {}; remove it", run.setup.model.text));
  }
  if (!path.seed.empty()) {
    return wrong_usage(fmt::format("--seed has no effect on model {}; remove it", run.setup.model.text));
  }
  const physics::ApproachRetractModel model(
      physics::build_law_tables(run.setup.law(), run.setup.material.contact, run.setup.law_options));
  run.figures = model.figures();
  const auto plan = sweep_plan(path, model.tables());
  if (!plan) return tl::unexpected(plan.error());
  run.plan = *plan;
  if (run.setup.model.direction_rule) {
    if (path.events_only) run.plan = no_finer_than(run.plan, kMostEventSteps);
    run.curve = physics::record_curve(physics::DirectionRuleModel(run.setup.material.contact), run.plan);
  } else {
    // at rest the events are those of the tables for any step
    run.curve = physics::record_curve(model, path.events_only ? no_finer_than(run.plan, 100.0) : run.plan);
  }
  return {};
}

core::Result<std::uint64_t> noise_seed(const PathOptions& path) {
  std::uint64_t seed = physics::DynamicModel::kDefaultSeed;
  const char* end = path.seed.data() + path.seed.size();
  if (path.seed.empty()) return seed;
  if (const auto read = std::from_chars(path.seed.data(), end, seed); read.ec != std::errc() || read.ptr != end) {
    return wrong_usage(fmt::format("--seed: \"{}\" is not a whole number from 0 to 18446744073709551615", path.seed));
  }
  return seed;
}

core::Result<void> sweep_dynamic(const PathOptions& path, CurveRun& run) {
  const auto seed = noise_seed(path);
  if (!seed) return tl::unexpected(seed.error());
  const auto speed = ramp_speed(path);
  if (!speed) return tl::unexpected(speed.error());
  constexpr physics::Time kServoTick(1e-3);
  const physics::DynamicModel model(run.setup.law(), run.setup.material.contact, run.setup.material.lever, kServoTick,
                                    run.setup.law_options, *seed);
  run.figures = model.figures();
  run.motion = {*speed, model.slow_motion(), *seed};
  const auto at_rest = physics::build_law_tables(run.setup.law(), run.setup.material.contact, run.setup.law_options);
  const auto plan = sweep_plan(path, *at_rest);
  if (!plan) return tl::unexpected(plan.error());
  run.plan = path.events_only ? no_finer_than(*plan, kMostEventSteps) : *plan;
  run.curve = physics::record_curve(model, run.plan, *speed);
  return {};
}

}  // namespace

core::Result<CurveRun> run_curve(const ContactSetup& setup, const PathOptions& path) {
  CurveRun run{setup, {}, {}, {}, {}, {}, {}};
  try {
    physics::validate(setup.material.contact);
    run.place = setup.place();
    run.model = setup.used_model();
    const auto done = setup.model.dynamic ? sweep_dynamic(path, run) : sweep_static(path, run);
    if (!done) return tl::unexpected(done.error());
  } catch (const std::invalid_argument& error) {
    return wrong_usage(error.what());
  }
  return run;
}

const physics::ModelEvent* find_event(const physics::ForceCurve& curve, physics::EventKind kind) {
  const auto at = std::find_if(curve.events.begin(), curve.events.end(),
                               [&](const physics::ModelEvent& event) { return event.kind == kind; });
  return at == curve.events.end() ? nullptr : &*at;
}

std::optional<physics::Energy> loop_energy(const CurveRun& run) {
  if (run.curve.samples.empty() || run.curve.samples.back().phase == physics::Phase::Attached) return std::nullopt;
  // only samples show the loop of the direction rule or of a moving tip; the law's own area is exact
  if (run.setup.model.direction_rule || run.setup.model.dynamic)
    return physics::summarise(run.curve.samples).loop_energy;
  const bool jumped = find_event(run.curve, physics::EventKind::JumpToContact) != nullptr;
  return jumped ? run.figures.loop_energy : physics::Energy();
}

}  // namespace afm::curves
