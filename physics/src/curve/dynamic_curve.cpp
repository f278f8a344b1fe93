// SPDX-License-Identifier: Apache-2.0
#include "physics/dynamic_curve.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/quantity_text.h"

namespace afm::physics {
namespace {

DynamicModel ramping(const DynamicModel& model, const SweepPlan& plan, Velocity speed) {
  const std::string at_speed = "a sweep at " + format_quantity(speed, kVelocityUnits);
  // written so that NaN fails
  if (!(speed > Velocity() && isfinite(speed))) throw std::invalid_argument(at_speed + " does not move");
  if (!(plan.from > model.figures().z_jtc)) {
    throw std::invalid_argument("a sweep from " + format_quantity(plan.from, kLengthUnits) +
                                " begins below jump-to-contact at " +
                                format_quantity(model.figures().z_jtc, kLengthUnits) + ": start above it");
  }
  const DynamicModel paced = model.simulating(plan.step / speed);
  const double sub_steps = static_cast<double>(sample_count(plan)) * (paced.simulated_per_step() / paced.sub_step());
  if (sub_steps > kLargestRamp || paced.slow_motion() > 1.0) {
    throw std::invalid_argument(at_speed + " takes too long to compute: sweep faster or over less");
  }
  return paced;
}

}  // namespace

ForceCurve record_curve(const DynamicModel& model, const SweepPlan& plan, Velocity speed) {
  const std::uint64_t count = sample_count(plan);
  DynamicModel ramp = ramping(model, plan, speed);
  ramp.settle(plan.from + plan.step, -speed);

  ForceCurve curve;
  curve.samples.reserve(static_cast<std::size_t>(count));
  for (std::uint64_t i = 0; i < count; ++i) {
    const Length z = sample_z(plan, i);
    const TipResponse response = ramp.step(z);
    CurveSample sample{z,
                       response.force,
                       response.tip_height,
                       response.cantilever_deflection,
                       response.sample_deformation,
                       i <= count / 2 ? Branch::Approach : Branch::Retract,
                       response.phase,
                       std::nullopt};
    for (std::uint32_t e = 0; e < response.event_count; ++e) {
      curve.events.push_back(response.events[e]);
      sample.event = response.events[e].kind;
    }
    curve.samples.push_back(sample);
  }
  return curve;
}

}  // namespace afm::physics
