// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "exhibit/models/model_builder.h"
#include "scene/graph/scene.h"

namespace afm::exhibit {

// Millet's analogy of the approach-retract cycle: a magnet on a spring above an iron plate. The hand that holds the
// spring represents the piezo, the spring the cantilever, the magnet the tip and the plate the sample.
class Analogy {
 public:
  Analogy() = default;
  // Adds its nodes below `sample`, whose +z is the plate's normal.
  Analogy(ModelBuilder& build, scene::Scene& scene, scene::NodeIndex sample);

  // Heights above the plate, in units of the sample's frame: the magnet's poles and, at the resting length of the
  // spring above them, the hand.
  struct Heights {
    double poles = 0;       // height of the tip: Z minus the deflection
    double deflection = 0;  // length of the spring minus its resting length
  };
  void place(const Heights& heights, std::vector<glm::dmat4>& local) const;

  double plate_thickness() const { return plate_thickness_; }

  // Heights of the centres of magnet and spring, for their labels.
  double magnet_middle(const Heights& heights) const { return heights.poles + 0.5 * magnet_height_; }
  double spring_middle(const Heights& heights) const;

  scene::NodeIndex frame() const { return frame_; }
  scene::NodeIndex magnet() const { return magnet_; }

 private:
  double spring_length(const Heights& heights) const;

  scene::NodeIndex frame_ = 0, magnet_ = 0, spring_ = 0, hand_ = 0;
  double magnet_height_ = 0, spring_length_ = 1, plate_thickness_ = 0;
};

}  // namespace afm::exhibit
