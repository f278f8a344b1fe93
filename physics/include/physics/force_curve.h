// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "physics/direction_rule.h"
#include "physics/force_model.h"
#include "physics/units.h"

namespace afm::physics {

// One cycle along Z: from -> to -> from, `to` below `from`.
struct SweepPlan {
  Length from;
  Length to;
  Length step;
};

// Largest number of samples of a sweep. A larger number is probably a mistake in a unit.
inline constexpr std::uint64_t kLargestSweep = 10'000'000;

// Number of samples of the whole cycle: `from`, every step down to `to` (the last step may be shorter), and the same
// places back up. Throws std::invalid_argument unless all three are finite, to < from, step > 0 and the cycle has at
// most kLargestSweep samples.
std::uint64_t sample_count(const SweepPlan& plan);

// Z of one sample, index < sample_count(plan).
Length sample_z(const SweepPlan& plan, std::uint64_t index);

enum class Branch { Approach, Retract };

// One row of a curve. A jump adds two rows at its own Z, before and after it, marked with its kind, so that a curve's
// extremes and area are exact for any step.
struct CurveSample {
  Length z;
  Force force;
  Length tip_height;
  Length cantilever_deflection;
  Length sample_deformation;
  Branch branch = Branch::Approach;
  Phase phase = Phase::Free;
  std::optional<EventKind> event;
};

struct ForceCurve {
  std::vector<CurveSample> samples;
  std::vector<ModelEvent> events;
};

// One cycle of a model that comes from far above, where it is free. Throws as sample_count() does, and if plan.from is
// not above Z_jtc, where an approach must begin. Allocates. Any thread.
ForceCurve record_curve(ApproachRetractModel model, const SweepPlan& plan);
ForceCurve record_curve(DirectionRuleModel model, const SweepPlan& plan);

}  // namespace afm::physics
