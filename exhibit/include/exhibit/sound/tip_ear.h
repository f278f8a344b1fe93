// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "exhibit/sound/heard_event.h"
#include "exhibit/sound/pitch.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// An event with its time and, where it has one, its force.
struct Heard {
  HeardEvent event = HeardEvent::SnapIn;
  std::int64_t time_ns = 0;  // CLOCK_MONOTONIC, interpolated where the servo interpolates
  double force_n = 0;        // on the tip, positive away from the sample; of a slip its size; 0: none
  std::int32_t material = -1;
};

// What is heard of an event of the servo.
Heard heard_of(const scene::TipEvent& event);

// Where a signal comes from: a jump from where its force does, all others from the middle.
double side_of(const Heard& heard, const Ear& ear);

// True while the force has its tone.
bool is_audible(const scene::TipSample& sample);

// What is heard of the servo's samples, one after the other: the force comes on and goes off, and the tip touches. A
// touch is heard again only after the tip was free or was pulled. One thread.
class TipEar {
 public:
  // In the order of their times; at most one event a sample.
  std::optional<Heard> add(const scene::TipSample& sample);

 private:
  std::optional<HeardEvent> change_of_force(scene::ServoState state);
  bool touches(const scene::TipSample& sample);

  scene::ServoState state_ = scene::ServoState::Disarmed;
  bool on_ = false;
  bool may_touch_ = false;
  double last_force_n_ = 0;
  std::int64_t last_ns_ = 0;
};

}  // namespace afm::exhibit
