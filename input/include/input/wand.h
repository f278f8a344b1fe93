// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "scene/shared/field_visitor.h"

namespace afm::input {

// Buttons named by function, whatever their names on the device; the values are bits of WandState::buttons.
enum class WandButton : std::uint32_t {
  Select = 1,     // selects the target of the ray
  Grab = 2,       // while held, the scene moves with the wand
  Scale = 4,      // while held, the wand makes the scene larger and smaller
  Home = 8,       // resets the transform of the scene
  Recenter = 16,  // sets the wand's current direction as straight ahead
  Stop = 32,      // removes the force at once
};

constexpr std::uint32_t bit(WandButton button) { return static_cast<std::uint32_t>(button); }

// Motion of the scene while Grab is held: by the wand's pose, or by pushing a cap that springs back.
enum class WandMotion : std::uint32_t { Absolute = 0, Rate = 1 };

// State that every wand reports. Room frame, metres, right-handed, +y up; the ray leaves the wand along its -z.
// Trivially copyable, so that it can cross threads in a core::LatestValue.
struct WandState {
  std::int64_t time_ns = 0;  // arrival time of the newest report
  glm::dvec3 position_m{0.0};
  glm::dquat room_from_wand{1.0, 0.0, 0.0, 0.0};
  bool orientation_valid = false;  // false: the wand has no direction
  bool position_valid = false;     // false: position_m is an assumed position of the hand
  bool connected = false;
  WandMotion motion = WandMotion::Absolute;
  std::uint32_t buttons = 0;  // bits of WandButton
  std::uint32_t stops = 0;    // number of presses of Stop so far, including those shorter than a frame
  // deflection of the cap or stick along, and about, the room's axes: -1 to 1
  glm::dvec3 push{0.0};
  glm::dvec3 turn{0.0};

  bool pressed(WandButton button) const { return (buttons & bit(button)) != 0; }
};

template <class Visit, scene::RecordOf<WandState>... Record>
constexpr void for_each_field(Visit&& visit, Record&... wand) {
  visit("time_ns", wand.time_ns...);
  visit("position_m", wand.position_m...);
  visit("room_from_wand", wand.room_from_wand...);
  visit("orientation_valid", wand.orientation_valid...);
  visit("position_valid", wand.position_valid...);
  visit("connected", wand.connected...);
  visit("motion", wand.motion...);
  visit("buttons", wand.buttons...);
  visit("stops", wand.stops...);
  visit("push", wand.push...);
  visit("turn", wand.turn...);
}
static_assert(scene::all_fields_described<WandState>());

struct Ray {
  glm::dvec3 origin_m{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};  // unit vector
};

inline Ray ray_of(const WandState& wand) {
  return {.origin_m = wand.position_m, .direction = wand.room_from_wand * glm::dvec3(0.0, 0.0, -1.0)};
}

}  // namespace afm::input
