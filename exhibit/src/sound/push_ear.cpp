// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/push_ear.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace afm::exhibit {

namespace {

constexpr double kLowestN = 1e-12, kLowestNoteOfHiss = 48, kNotesPerDecade = 9, kMostNotes = 48;
constexpr double kFarSideOfHiss = 0.9;
constexpr double kAstray = 0.5, kOnTheWay = 0.26;  // sines of 30 and 15 degrees
constexpr double kQuietPulse = 0.35;  // loudness of a particle that holds, and between the pulses of one that rolls

bool is_pushed(physics::PushState state) {
  return state != physics::PushState::Free && state != physics::PushState::Carried;
}

}  // namespace

Tone tone_of(const HeardPush& push) {
  const double notes = kNotesPerDecade * std::log10(std::max(1.0, push.force_n / kLowestN));
  return {.hz = note_hz(kLowestNoteOfHiss + std::min(notes, kMostNotes)),
          .level = push.pulse,
          .side = kFarSideOfHiss * push.side,
          .edge = 0.0,
          .hiss = 1.0};
}

PushEar::Astray PushEar::add(const scene::TipSample& sample) {
  const glm::dvec2 at_m(sample.surface.xy_m[0], sample.surface.xy_m[1]);
  const glm::dvec2 step_m = at_m - std::exchange(last_m_, at_m);
  const double step_way_m = glm::length(step_m);
  if (step_way_m > 0.0) heading_ += -std::expm1(-step_way_m / kHeadingM) * (step_m / step_way_m - heading_);
  way_m_ += step_way_m;
  const scene::PushSample& pushed = sample.push;
  const glm::dvec2 lateral_n(pushed.lateral_n[0], pushed.lateral_n[1]);
  const double force_n = glm::length(lateral_n);
  push_ = {};
  if (!is_pushed(pushed.state) || !(force_n > 0.0)) {
    astray_ = false;
    return Astray::No;
  }
  push_.force_n = force_n;
  const bool between = pushed.state == physics::PushState::Rolls && std::fmod(way_m_, kPulseM) > 0.5 * kPulseM;
  if (between || pushed.state == physics::PushState::Holds) push_.pulse = kQuietPulse;
  if (!(pushed.normal_n > 0.0)) return Astray::No;  // dragged particle, or none
  const glm::dvec2 to_particle = -lateral_n / force_n;
  push_.side = std::clamp(heading_.y * to_particle.x - heading_.x * to_particle.y, -1.0, 1.0);
  const double off = std::abs(push_.side);
  if (off < kOnTheWay) astray_ = false;
  if (off < kAstray || std::exchange(astray_, true)) return Astray::No;
  return push_.side < 0.0 ? Astray::Left : Astray::Right;
}

}  // namespace afm::exhibit
