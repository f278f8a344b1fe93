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

// Reads a script of the head: a line `seconds, x, y, z` or `seconds, x, y, z, qx, qy, qz, qw` for each place, in metres
// of the room, times rising from 0; # begins a comment. BadInputFile: names file and line.
core::Result<std::vector<HeadKey>> load_head_script(const std::string& path);

// A head for a desk without a tracker. It follows a script, over and over, or goes where steps send it, at a walking
// pace: nothing jumps. Steps end the script. One thread.
class SimulatedHead {
 public:
  // `script` may be empty: the head stays at `start` until the first step.
  SimulatedHead(const scene::HeadPose& start, std::vector<HeadKey> script);

  // By so much, in the room's frame; on the way it may be given again.
  void step(const glm::dvec3& by_m);

  // Back to the start, also of the script.
  void home();

  // Times never run backwards. Empty: neither a script nor a step moves it.
  std::optional<scene::HeadPose> pose(std::int64_t now_ns);

  static constexpr double kPaceMPerS = 0.6;

 private:
  scene::HeadPose at_script_time(double time_s) const;

  scene::HeadPose start_, shown_;
  std::vector<HeadKey> script_;
  std::optional<std::int64_t> begun_ns_;  // of the script
  std::optional<glm::dvec3> target_m_;    // of the steps
  std::int64_t shown_ns_ = 0;
};

}  // namespace afm::input
