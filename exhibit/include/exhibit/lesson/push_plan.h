// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "core/enumerators.h"

namespace afm::exhibit {

// What ends a step Push: all but a loss once the tip has been lifted for scene::PatternTask::kRestNs.
enum class PushUntil { Moved, Target, Pattern, Lost };
struct PushUntilRow {
  PushUntil until;
  std::string_view word, meaning;
  bool from_targets;  // judged by the distance from targets; otherwise by the way of the particle from its start
};
inline constexpr std::array kPushUntils{
    PushUntilRow{PushUntil::Moved, "moved", "the particle is so far from its start", false},
    PushUntilRow{PushUntil::Target, "target", "the particle lies on a target", true},
    PushUntilRow{PushUntil::Pattern, "pattern", "the pattern of the set is done", true},
    PushUntilRow{PushUntil::Lost, "lost", "the tip has slipped past the particle", false}};
static_assert(core::has_row_for_each(kPushUntils, &PushUntilRow::until));
constexpr const PushUntilRow& row_of(PushUntil until) { return kPushUntils[core::index_of(until)]; }

struct PushPlan {
  PushUntil until = PushUntil::Pattern;
  std::size_t particle = 0;  // number in the set, from 0; for all but Pattern
  std::size_t target = 0;    // the same of a target, for Target
  double distance_m = 0;     // for Moved
};

}  // namespace afm::exhibit
