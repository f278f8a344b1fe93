// SPDX-License-Identifier: Apache-2.0
#include "exhibit/jump_cue.h"

#include <algorithm>

namespace afm::exhibit {

namespace {

constexpr double kNearRadius = 0.4, kFarRadius = 4.0;
constexpr glm::vec3 kInColor(0.25F, 1.1F, 2.0F), kOffColor(2.2F, 0.75F, 0.05F);

}  // namespace

std::optional<JumpCue> jump_cue(std::span<const scene::TipEvent> events, std::int64_t now_ns) {
  auto later = std::upper_bound(events.begin(), events.end(), now_ns,
                                [](std::int64_t t, const scene::TipEvent& e) { return t < e.time_ns; });
  // a slip is felt many times a second: nothing that may flash
  while (later != events.begin() && (later - 1)->kind == physics::EventKind::Slip) --later;
  if (later == events.begin()) return std::nullopt;
  const scene::TipEvent& newest = *(later - 1);
  const double age_s = static_cast<double>(now_ns - newest.time_ns) * 1e-9;
  if (age_s > kCueSeconds) return std::nullopt;
  return JumpCue{newest.kind, age_s};
}

CueRing cue_ring(const JumpCue& cue) {
  const double t = std::clamp(cue.age_s / kCueSeconds, 0.0, 1.0);
  const bool in = cue.kind == physics::EventKind::JumpToContact;
  const double way = in ? 1.0 - t : t;
  const auto strength = static_cast<float>((1.0 - t) * (1.0 - t));
  return {(in ? kInColor : kOffColor) * strength, kNearRadius + (kFarRadius - kNearRadius) * way};
}

}  // namespace afm::exhibit
