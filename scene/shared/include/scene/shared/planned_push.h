// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "scene/shared/field_visitor.h"
#include "scene/shared/particle_blocks.h"

namespace afm::scene {

// Straight way on which a person plans to push a sphere, in the sample's frame, metres. Written by touchafm whenever it
// changes, recorded with every tick.
struct PlannedPush {
  std::array<double, 2> from_m{};       // centre of the sphere when it was planned
  std::array<double, 2> to_m{};         // place that it is to reach
  std::int32_t particle = kNoParticle;  // none: no plan, and all fields have their defaults
  std::uint32_t guided = 0;             // 1: a groove guides the hand (haptics/felt_groove.h)

  bool operator==(const PlannedPush&) const = default;
};

template <class Visit, RecordOf<PlannedPush>... Record>
constexpr void for_each_field(Visit&& visit, Record&... plan) {
  visit("plan_from_m", plan.from_m...);
  visit("plan_to_m", plan.to_m...);
  visit("plan_particle", plan.particle...);
  visit("plan_guided", plan.guided...);
}
static_assert(all_fields_described<PlannedPush>());

// Shortest way of a plan, and the farthest coordinate of its ends: beyond the range of any scanner.
inline constexpr double kShortestPlanM = 1e-10;
inline constexpr double kFarthestPlanM = 1e-3;

}  // namespace afm::scene
