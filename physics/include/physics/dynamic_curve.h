// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/dynamic_model.h"
#include "physics/force_curve.h"
#include "physics/units.h"

namespace afm::physics {

// One cycle at a steady speed of the base along Z, in real time and without slow motion: each step of the plan takes
// step/speed. The lever comes moving from far above and turns at once at `to`.
//
// A row holds what DynamicModel::step() gives, the lever's force averaged since the row before; the rows of a jump that
// ended there carry its kind, and no rows are added for it, since nothing in it is sudden. `events` has the places.
//
// Throws std::invalid_argument as sample_count() does, if plan.from does not lie above Z_jtc, for a speed that is not
// positive and finite, and for a cycle of more than kLargestRamp sub-steps. Allocates; for any thread.
inline constexpr double kLargestRamp = 2e10;
ForceCurve record_curve(const DynamicModel& model, const SweepPlan& plan, Velocity speed);

}  // namespace afm::physics
