// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scenery/analogy.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace afm::exhibit {

namespace {

using glm::dmat4;
using glm::dvec3;

constexpr double kShortestSpring = 0.1;  // length relative to the resting one at which the coils touch

}  // namespace

Analogy::Analogy(ModelBuilder& build, scene::Scene& scene, scene::NodeIndex sample) {
  frame_ = build.model_in_frame_of("analogy", "analogy.glb", "analogy", sample);
  magnet_ = build.node("analogy/magnet");
  spring_ = build.node("analogy/spring");
  hand_ = build.node("analogy/hand");
  const scene::NodeIndex plate = build.node("analogy/plate");
  if (build.error()) return;
  plate_thickness_ = -bounds_below(scene, plate).low.z;
  magnet_height_ = bounds_below(scene, magnet_).high.z;
  spring_length_ = bounds_below(scene, spring_).high.z;
}

double Analogy::spring_length(const Heights& heights) const {
  return std::max(spring_length_ + heights.deflection, kShortestSpring * spring_length_);
}

double Analogy::spring_middle(const Heights& heights) const {
  return heights.poles + magnet_height_ + 0.5 * spring_length(heights);
}

void Analogy::place(const Heights& heights, std::vector<dmat4>& local) const {
  const double length = spring_length(heights), foot = heights.poles + magnet_height_;
  const auto raised = [](double height) { return glm::translate(dmat4(1.0), dvec3(0.0, 0.0, height)); };
  local[magnet_] = raised(heights.poles);
  local[spring_] = glm::scale(raised(foot), dvec3(1.0, 1.0, length / spring_length_));
  local[hand_] = raised(foot + length);
}

}  // namespace afm::exhibit
