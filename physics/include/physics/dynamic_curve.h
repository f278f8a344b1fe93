// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/dynamic_model.h"
#include "physics/force_curve.h"
#include "physics/units.h"

namespace afm::physics {

// One cycle at a constant speed of the base along Z, in real time and without slow motion: each step of the plan takes
// step/speed. The lever arrives moving from far above and reverses at once at `to`.
//
// A row contains the result of DynamicModel::step(), with the lever's force averaged since the previous row. Rows in
// which a jump ended carry its kind; no rows are added for it, because it takes time. `events` contains the places.
//
// Throws std::invalid_argument as sample_count() does, if plan.from is not above Z_jtc, for a speed that is not
// positive and finite, and for a cycle of more than kLargestRamp sub-steps. Allocates. Any thread.
inline constexpr double kLargestRamp = 2e10;
ForceCurve record_curve(const DynamicModel& model, const SweepPlan& plan, Velocity speed);

}  // namespace afm::physics
