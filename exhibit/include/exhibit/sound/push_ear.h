// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>

#include "exhibit/sound/pitch.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// Sound properties of a particle that the tip touches, or of a sample that it scratches.
struct HeardPush {
  double force_n = 0;  // magnitude of the sideways force; 0: no touch
  double side = 0;     // sine of the angle from the path of the tip to the particle; positive: on the right
  double pulse = 1;    // loudness, 0 to 1: lower while the particle holds; a rolling one pulses as it turns
};

// A hiss whose pitch rises with the force, nine semitones for a factor of ten, and which moves to the ear on whose side
// the particle is.
Tone tone_of(const HeardPush& push);

// Derives a HeardPush from the servo's samples. One thread.
class PushEar {
 public:
  static constexpr double kHeadingM = 5e-9;  // path over which the direction of the tip is smoothed
  static constexpr double kPulseM = 13e-9;   // path of one pulse: 30 degrees of a sphere of 50 nm

  enum class Astray { No, Left, Right };

  // Adds a sample; call in order of time. Left or Right once when a particle has come 30 degrees off the path
  // of the tip, and again only after it was within 15 degrees, or not touched.
  Astray add(const scene::TipSample& sample);

  const HeardPush& push() const { return push_; }  // push in the newest sample

 private:
  HeardPush push_;
  glm::dvec2 last_m_{0.0};
  glm::dvec2 heading_{0.0};  // direction of the tip; shorter than 1 while it turns
  double way_m_ = 0;
  bool astray_ = false;
};

}  // namespace afm::exhibit
