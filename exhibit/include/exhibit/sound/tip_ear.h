// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "exhibit/sound/heard_event.h"
#include "exhibit/sound/pitch.h"
#include "exhibit/sound/push_ear.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// An event with its time and, if any, its force.
struct Heard {
  HeardEvent event = HeardEvent::SnapIn;
  std::int64_t time_ns = 0;  // CLOCK_MONOTONIC, interpolated if the servo interpolates
  double force_n = 0;        // force on the tip, positive away from the sample; slip or particle: magnitude; 0: none;
                             // negative: particle astray on the left
  std::int32_t material = -1;
};

// Converts an event of the servo.
Heard heard_of(const scene::TipEvent& event);

// Stereo position of a signal: for a jump, that of its force; for a particle astray, its side; otherwise the middle.
double side_of(const Heard& heard, const Ear& ear);

// Returns whether the force is audible as a tone.
bool is_audible(const scene::TipSample& sample);

// Derives events from the servo's samples: the force is switched on or off, the tip touches, or a pushed particle goes
// astray. Another touch is reported only after the tip was free or pulled. One thread.
class TipEar {
 public:
  // Adds a sample; call in order of time. Returns at most one event.
  std::optional<Heard> add(const scene::TipSample& sample);

  // Push in the newest sample.
  const HeardPush& push() const { return push_.push(); }

 private:
  std::optional<HeardEvent> change_of_force(scene::ServoState state);
  bool touches(const scene::TipSample& sample);

  scene::ServoState state_ = scene::ServoState::Disarmed;
  PushEar push_;
  bool on_ = false;
  bool may_touch_ = false;
  double last_force_n_ = 0;
  std::int64_t last_ns_ = 0;
};

}  // namespace afm::exhibit
