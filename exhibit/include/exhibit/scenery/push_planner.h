// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "exhibit/state/particles_now.h"
#include "input/wand.h"

namespace afm::exhibit {

class WallScene;
struct WallState;

// A ray in the frame of the sample in front, in metres of the nanoworld; empty if no sample is in front.
std::optional<input::Ray> ray_on_sample(const WallScene& scene, const WallState& state, const input::Ray& ray);

// The plan of a push, made with a pointer or with keys: a sphere, and the place to which it is to be pushed straight.
// Places are those of the pattern or any other on the sample. A groove along the line is off until it is switched on,
// and stays on for the next plan. Every function returns its effect as one line for the log. One thread.
class PushPlanner {
 public:
  // `set` must outlive the object.
  explicit PushPlanner(const scene::ParticleSet& set);

  // Handles a press of a pointer with this ray_on_sample(): on a sphere it plans that sphere, or removes its plan;
  // elsewhere on the sample it makes that place the target. No effect if the ray meets neither.
  std::optional<std::string> point(const input::Ray& ray, const ParticlesNow& now);

  // Plans the next sphere that can be pushed; after the last one, removes the plan.
  std::string next_particle(const ParticlesNow& now);

  // Next place of the pattern for the planned sphere; without a pattern, 3 rho away in one of eight directions.
  std::string next_place(const ParticlesNow& now);

  std::string toggle_groove();

  // Removes plan and groove.
  void clear();

  scene::PlannedPush plan() const;

 private:
  bool can_be_pushed(std::size_t particle) const;
  double radius_m(std::size_t particle) const;
  glm::dvec2 place_m(std::size_t particle, const ParticlesNow& now) const;
  std::size_t assigned_place(std::size_t particle, const ParticlesNow& now) const;
  std::vector<glm::dvec2> places_m(std::size_t particle, const ParticlesNow& now) const;
  std::string choose(std::size_t particle, const ParticlesNow& now);
  bool go_to(const glm::dvec2& place_m, const ParticlesNow& now);
  std::string go_to_place(std::size_t first, const ParticlesNow& now);
  std::string end();
  std::string described(const ParticlesNow& now) const;

  const scene::ParticleSet& set_;
  double half_side_m_;                 // half the side of the drawn sample
  std::vector<glm::dvec2> starts_m_;   // start places of the particles
  std::vector<glm::dvec2> targets_m_;  // places of the pattern
  scene::PlannedPush plan_;            // newest plan, without its groove
  bool groove_ = false;
  std::size_t place_ = 0;  // index of the place last chosen by key
};

}  // namespace afm::exhibit
