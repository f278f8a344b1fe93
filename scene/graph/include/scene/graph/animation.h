// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace afm::scene {

using NodeIndex = std::uint32_t;

enum class Interpolation { Step, Linear, CubicSpline };

// Value over time: `width` numbers per key; with CubicSpline three times as many: in-tangent, value and out-tangent.
// There is at least one key, and the times increase.
struct Track {
  Interpolation interpolation = Interpolation::Linear;
  std::size_t width = 0;
  std::vector<float> times_s;
  std::vector<float> values;
};

// Tracks of an animation for one node; a property without a track keeps its rest value.
struct AnimatedNode {
  NodeIndex node = 0;
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 scale{1.0};
  std::optional<Track> translations{};
  std::optional<Track> rotations{};  // quaternions x, y, z, w
  std::optional<Track> scales{};
  std::optional<Track> weights{};
};

struct Animation {
  std::string name;
  std::vector<AnimatedNode> nodes;
  float length_s = 0.0F;  // time of the last key
};

// Value at a time; constant before the first and after the last key. Rotations follow the shortest great circle (glTF
// 2.0, appendix C). Writes `track.width` numbers.
void sample(const Track& track, float time_s, std::vector<float>& value);
glm::dquat sample_rotation(const Track& track, float time_s);

// Skin of a mesh: one matrix per joint, from the mesh to the joint's rest frame.
struct Skin {
  std::string name;
  std::vector<NodeIndex> joints;
  std::vector<glm::mat4> joint_from_mesh;
};

}  // namespace afm::scene
