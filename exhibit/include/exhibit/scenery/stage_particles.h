// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "exhibit/state/particles_now.h"
#include "render/frame.h"
#include "scene/graph/scene.h"

namespace afm::exhibit {

class ModelBuilder;

// Particles on the drawn sample: copies of one mesh, a ring around the touched one, a footprint where each one that has
// moved lay at the start, with dots from there to where it lies, a cross on each place of the pattern, and the tip at
// its true size. Const after creation.
class StageParticles {
 public:
  // Stroke at which a set is drawn: that of the largest picture in which all its particles lie on the sample.
  static double stroke_m(const scene::ParticleSet& set);

  // Adds the nodes below `sample`, whose units are those of the layout.
  StageParticles(const scene::ParticleSet& set, ModelBuilder& build, scene::Scene& scene, scene::NodeIndex sample);

  // Apex on the bent lever, in metres of the nanoworld in the sample's frame, while the tip meets particles.
  static std::optional<glm::dvec3> apex_m(const ParticlesNow* now);

  // Places ring and tip; `now` may be null. `apex` is that of the drawn tip, in layout units.
  void place(const ParticlesNow* now, double layout_per_m, const glm::dvec3& apex,
             std::vector<glm::dmat4>& local) const;

  // The copies, at their start places where `now` is null or does not know better.
  void add_copies(const ParticlesNow* now, double layout_per_m, render::FrameState& frame) const;

  // All but the ring.
  std::vector<scene::NodeIndex> nodes() const { return {spheres_, targets_, footprints_, dots_, tip_}; }
  scene::NodeIndex tip() const { return tip_; }
  scene::NodeIndex ring() const { return ring_; }

  // True if a particle is touched.
  bool shows_ring(const ParticlesNow* now) const { return now != nullptr && touched(*now, particles_.size()); }

 private:
  struct Particle {
    double radius_m = 0;
    std::array<double, 2> start_m{};
    glm::vec3 color{1.0F};  // linear
  };

  void add_marks(const ParticlesNow& now, double layout_per_m, render::FrameState& frame) const;

  std::vector<Particle> particles_;
  std::uint32_t most_dots_ = 0;  // between a particle and its footprint
  double tip_radius_m_ = 0;
  std::vector<glm::dvec2> target_places_m_;
  double target_size_m_ = 0;
  scene::NodeIndex spheres_ = 0, targets_ = 0, footprints_ = 0, dots_ = 0, ring_ = 0, tip_ = 0;
};

}  // namespace afm::exhibit
