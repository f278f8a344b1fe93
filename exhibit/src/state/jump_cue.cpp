// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/jump_cue.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "exhibit/words/phrases.h"
#include "exhibit/words/signed_text.h"

namespace afm::exhibit {

namespace {

constexpr double kNearRadius = 0.4, kFarRadius = 4.0;
constexpr glm::vec3 kInColor(0.25F, 1.1F, 2.0F), kOffColor(2.2F, 0.75F, 0.05F);

// Force that the paper gives for the jump: F_attr or F_ad; in tapping mode, the mean force after it.
float force_of(const scene::TipEvent& event) {
  const bool before = event.kind == physics::EventKind::JumpOffContact;
  return static_cast<float>(before ? event.force_before_n : event.force_after_n);
}

}  // namespace

void JumpCues::add(const scene::TipEvent& event) {
  if (!physics::begins_cycle(event.kind) && !physics::ends_cycle(event.kind)) return;
  if (next_ && next_->since_ns <= event.time_ns) shown_ = std::exchange(next_, std::nullopt);
  if (!shown_ || event.time_ns - shown_->since_ns >= kLeastNs) {
    shown_ = {event.kind, force_of(event), event.time_ns};
    next_.reset();
  } else {
    next_ = {event.kind, force_of(event), shown_->since_ns + kLeastNs};
  }
}

std::optional<JumpCues::Shown> JumpCues::begun(std::int64_t now_ns) const {
  const std::optional<Shown>& shown = next_ && next_->since_ns <= now_ns ? next_ : shown_;
  return shown && now_ns >= shown->since_ns ? shown : std::nullopt;
}

std::optional<std::int64_t> JumpCues::begun_ns(std::int64_t now_ns) const {
  const std::optional<Shown> shown = begun(now_ns);
  return shown ? std::optional(shown->since_ns) : std::nullopt;
}

std::optional<JumpCue> JumpCues::at(std::int64_t now_ns) const {
  const std::optional<Shown> shown = begun(now_ns);
  if (!shown) return std::nullopt;
  const double age_s = static_cast<double>(now_ns - shown->since_ns) * 1e-9;
  if (age_s > kCueSeconds) return std::nullopt;
  return JumpCue{shown->kind, shown->force_n, age_s};
}

std::optional<JumpCue> jump_cue(std::span<const scene::TipEvent> events, std::int64_t now_ns) {
  JumpCues cues;
  for (const scene::TipEvent& event : events) {
    if (event.time_ns > now_ns) break;
    cues.add(event);
  }
  return cues.at(now_ns);
}

CueRing cue_ring(const JumpCue& cue) {
  const double t = std::clamp(cue.age_s / kRingSeconds, 0.0, 1.0);
  const bool in = physics::begins_cycle(cue.kind);
  const double way = in ? 1.0 - t : t;
  const auto strength = static_cast<float>((1.0 - t) * (1.0 - t));
  return {(in ? kInColor : kOffColor) * strength, kNearRadius + (kFarRadius - kNearRadius) * way};
}

std::string cue_text(const JumpCue& cue, const Phrases& phrases) {
  const std::string force = force_text(static_cast<double>(cue.force_n));
  switch (cue.kind) {
    case physics::EventKind::JumpToContact:
      return phrases.text<Phrase::CueSnapIn>(force);
    case physics::EventKind::JumpToRepulsion:
      return fmt::format("{} {}", phrases[Phrase::SwingRepulsive], force);
    case physics::EventKind::JumpToAttraction:
      return fmt::format("{} {}", phrases[Phrase::SwingAttractive], force);
    default:
      return phrases.text<Phrase::CuePullOff>(force);
  }
}

}  // namespace afm::exhibit
