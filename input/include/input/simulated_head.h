// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/display/wall.h"

namespace afm::input {

// Position of the head at one time of a script.
struct HeadKey {
  double time_s = 0;
  scene::HeadPose pose;
};

// Reads a head script: one line `seconds, x, y, z` or `seconds, x, y, z, qx, qy, qz, qw` per pose, in metres of the
// room, with times that increase from 0; # begins a comment. BadInputFile names file and line.
core::Result<std::vector<HeadKey>> load_head_script(const std::string& path);

// Head for a desk without a tracker. It repeats a script, or moves to where steps send it, at walking pace and without
// jumps. The first step ends the script. One thread.
class SimulatedHead {
 public:
  // `script` may be empty: the head stays at `start` until the first step.
  SimulatedHead(const scene::HeadPose& start, std::vector<HeadKey> script);

  // Moves the target by this vector, in the room's frame; steps add up while the head is moving.
  void step(const glm::dvec3& by_m);

  // Returns to the start, and restarts the script.
  void home();

  // Head at a time; times never decrease. Empty if neither a script nor a step moves the head.
  std::optional<scene::HeadPose> pose(std::int64_t now_ns);

  static constexpr double kPaceMPerS = 0.6;

 private:
  scene::HeadPose at_script_time(double time_s) const;

  scene::HeadPose start_, shown_;
  std::vector<HeadKey> script_;
  std::optional<std::int64_t> begun_ns_;  // time at which the script started
  std::optional<glm::dvec3> target_m_;    // target set by steps
  std::int64_t shown_ns_ = 0;
};

}  // namespace afm::input
