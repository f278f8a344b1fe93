// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "exhibit/state/particles_now.h"
#include "render/frame.h"
#include "scene/graph/scene.h"

namespace afm::exhibit {

class ModelBuilder;

// Particles on the drawn sample: copies of a mesh for spheres and of one for each species of rods, a ring around the
// touched one, a footprint at the original place of each moved particle, with dots from there to its current place, a
// cross on each place of the pattern, for a rod on each of its ends, the pads of both kinds, a line of dots for the
// plan of a push, with a ring around the planned sphere and another around its place, and the tip at its true size. A
// sphere that hangs on the tip is drawn there. Many small dots surround a particle whose place is computed, and a few
// large ones a stale one, which is dark: the three states differ even without colours. Const after creation.
class StageParticles {
 public:
  // Stroke at which a set is drawn: that of the largest picture in which all its particles lie on the sample.
  static double stroke_m(const scene::ParticleSet& set);

  // Adds the nodes below `sample`, whose units are those of the layout.
  StageParticles(const scene::ParticleSet& set, ModelBuilder& build, scene::Scene& scene, scene::NodeIndex sample);

  // Apex on the bent lever, in metres of the nanoworld in the sample's frame; empty unless the tip meets particles.
  static std::optional<glm::dvec3> apex_m(const ParticlesNow* now);

  // Places ring and tip; `now` may be null. `apex` is the apex of the drawn tip, in layout units.
  void place(const ParticlesNow* now, double layout_per_m, const glm::dvec3& apex,
             std::vector<glm::dmat4>& local) const;

  // Copies of all particles; those whose place `now` lacks, or all if it is null, are at their start.
  void add_copies(const ParticlesNow* now, double layout_per_m, render::FrameState& frame) const;

  // All nodes except the ring.
  std::vector<scene::NodeIndex> nodes() const;
  scene::NodeIndex tip() const { return tip_; }
  scene::NodeIndex ring() const { return ring_; }

  // True if a particle is touched.
  bool shows_ring(const ParticlesNow* now) const { return now != nullptr && touched(*now, particles_.size()); }

 private:
  struct Particle {
    std::size_t species = 0;
    double radius_m = 0;
    double half_m = 0;   // half the length of a rod; 0: no rod
    double outer_m = 0;  // radius as seen from above
    std::array<double, 2> start_m{};
    glm::dvec4 start_turn{0.0, 0.0, 0.0, 1.0};  // unit quaternion, w last
    glm::vec3 color{1.0F};                      // linear RGB
  };

  struct DrawnPad {
    scene::NodeIndex node = 0;
    glm::dvec2 middle_m{0.0};
  };

  void add_flat_and_pads(const scene::ParticleSet& set, ModelBuilder& build, scene::NodeIndex sample);
  void add_targets(double layout_per_m, render::FrameState& frame) const;
  glm::dvec2 touched_m(const Particle& particle, const scene::ParticlePose& pose, const ParticlesNow& now) const;
  double height_m(std::size_t particle, const scene::ParticlePose& pose, const ParticlesNow& now) const;
  void add_marks(const ParticlesNow& now, double layout_per_m, render::FrameState& frame) const;
  void add_doubts(const ParticlesNow& now, double layout_per_m, render::FrameState& frame) const;
  void add_plan(const ParticlesNow& now, double layout_per_m, render::FrameState& frame) const;

  std::vector<Particle> particles_;
  std::uint32_t most_dots_ = 0;  // largest number of dots between a particle and its footprint
  double tip_radius_m_ = 0;
  std::vector<glm::dvec2> target_places_m_;
  double target_size_m_ = 0;
  std::vector<std::optional<scene::NodeIndex>> flat_;  // node of each species of rods or islands
  std::vector<DrawnPad> pads_;
  scene::NodeIndex spheres_ = 0, targets_ = 0, footprints_ = 0, dots_ = 0, ring_ = 0, tip_ = 0;
  scene::NodeIndex plan_line_ = 0, plan_ends_ = 0, doubts_ = 0;
};

}  // namespace afm::exhibit
