// SPDX-License-Identifier: Apache-2.0
#include "physics/force_curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "physics/quantity_text.h"

namespace afm::physics {
namespace {

std::string text(Length length) { return format_quantity(length, kLengthUnits); }

// Number of samples from `from` to `to`, both included.
std::uint64_t samples_one_way(const SweepPlan& plan) {
  if (!isfinite(plan.from) || !isfinite(plan.to) || !isfinite(plan.step)) {
    throw std::invalid_argument("a sweep from " + text(plan.from) + " to " + text(plan.to) + " in steps of " +
                                text(plan.step) + " is not finite");
  }
  if (plan.to >= plan.from) {
    throw std::invalid_argument("a sweep goes down: its end " + text(plan.to) + " is not below its start " +
                                text(plan.from));
  }
  if (plan.step <= Length()) throw std::invalid_argument("sweep step " + text(plan.step) + " is not positive");

  // a hundred-millionth of a step is a rounding error of the division, not an additional sample
  const double steps = std::ceil((plan.from - plan.to) / plan.step - 1e-8);
  if (2.0 * steps + 1.0 > static_cast<double>(kLargestSweep)) {
    throw std::invalid_argument("a sweep from " + text(plan.from) + " to " + text(plan.to) + " in steps of " +
                                text(plan.step) + " has more than " + std::to_string(kLargestSweep) +
                                " samples: take a larger step");
  }
  return static_cast<std::uint64_t>(std::max(steps, 1.0)) + 1;
}

CurveSample row(const LawTables& tables, Branch branch, Length z, Force force, Phase phase) {
  const LeverState lever = lever_state(tables, phase, z, force);
  return {z,      force, lever.tip_height, lever.cantilever_deflection, lever.sample_deformation,
          branch, phase, std::nullopt};
}

template <class Model>
ForceCurve record(Model model, const SweepPlan& plan) {
  const std::uint64_t count = sample_count(plan);
  const CycleFigures& thresholds = model.figures();
  if (plan.from <= thresholds.z_jtc) {
    throw std::invalid_argument("a sweep from " + text(plan.from) + " begins below jump-to-contact at " +
                                text(thresholds.z_jtc) + ": start above it");
  }

  // the path begins where the tip is free
  constexpr Length kHigher(1e-6);
  model.step(std::max(thresholds.z_joc, plan.from) + kHigher);

  ForceCurve curve;
  curve.samples.reserve(static_cast<std::size_t>(count) + 8);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Length z = sample_z(plan, i);
    const Branch branch = i <= count / 2 ? Branch::Approach : Branch::Retract;
    const TipResponse response = model.step(z);
    for (std::uint32_t e = 0; e < response.event_count; ++e) {
      const ModelEvent& event = response.events[e];
      const bool to_contact = event.kind == EventKind::JumpToContact;
      CurveSample before =
          row(model.tables(), branch, event.z, event.force_before, to_contact ? Phase::Free : Phase::Attached);
      CurveSample after =
          row(model.tables(), branch, event.z, event.force_after, to_contact ? Phase::Attached : Phase::Free);
      before.event = after.event = event.kind;
      curve.samples.push_back(before);
      curve.samples.push_back(after);
      curve.events.push_back(event);
    }
    curve.samples.push_back(row(model.tables(), branch, z, response.force, response.phase));
  }
  return curve;
}

}  // namespace

std::uint64_t sample_count(const SweepPlan& plan) { return 2 * samples_one_way(plan) - 1; }

Length sample_z(const SweepPlan& plan, std::uint64_t index) {
  // the way up uses the places of the way down
  const std::uint64_t turn = samples_one_way(plan) - 1;
  const std::uint64_t steps = index <= turn ? index : 2 * turn - index;
  if (steps == turn) return plan.to;
  return plan.from - plan.step * static_cast<double>(steps);
}

ForceCurve record_curve(ApproachRetractModel model, const SweepPlan& plan) { return record(std::move(model), plan); }
ForceCurve record_curve(DirectionRuleModel model, const SweepPlan& plan) { return record(std::move(model), plan); }

}  // namespace afm::physics
