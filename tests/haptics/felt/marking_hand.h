// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "haptics/device.h"
#include "haptics/felt_marks.h"
#include "haptics/particle_scale.h"
#include "scene/shared/particle_blocks.h"

namespace afm::test {

// A hand on a sample with permanent marks, at 1000 ticks per second.
class MarkingHand {
 public:
  static constexpr double kTickS = 1e-3;
  static constexpr double kNm = 1e-9;

  MarkingHand(const scene::SharedParticles& particles, double start_z_nm)
      : particles_(std::make_unique<scene::SharedParticles>(particles)),
        scale_(*haptics::particle_scale(*particles_, haptics::omni_like("hand"))),
        at_nm_(0.0, 0.0, start_z_nm) {}
  virtual ~MarkingHand() = default;

  haptics::ParticlePush at(double x_nm, double y_nm, double z_nm) {
    const haptics::ParticlePush push = marks().step({x_nm * kNm, y_nm * kNm}, z_nm * kNm, kTickS);
    marks().next_tile();
    at_nm_ = {x_nm, y_nm, z_nm};
    for (const haptics::ParticlePush::Event& event : push.happened()) events_.push_back(event);
    return push;
  }

  // Moves on a straight line; returns the newest tick.
  haptics::ParticlePush go(double x_nm, double y_nm, double z_nm, double nm_per_tick) {
    const glm::dvec3 from = at_nm_, way = glm::dvec3(x_nm, y_nm, z_nm) - from;
    const int ticks = std::max(1, static_cast<int>(std::ceil(glm::length(way) / nm_per_tick)));
    haptics::ParticlePush push;
    for (int i = 1; i <= ticks; ++i) {
      const glm::dvec3 to = from + way * (static_cast<double>(i) / ticks);
      push = at(to.x, to.y, to.z);
      check();
    }
    return push;
  }

  void wait(int ticks) {
    for (int i = 0; i < ticks; ++i) at(at_nm_.x, at_nm_.y, at_nm_.z);
  }

  std::size_t count(physics::EventKind kind) const {
    return static_cast<std::size_t>(
        std::count_if(events_.begin(), events_.end(), [&](const auto& event) { return event.kind == kind; }));
  }

  const haptics::ParticleScale& scale() const { return scale_; }
  const glm::dvec3& place_nm() const { return at_nm_; }

 protected:
  virtual haptics::FeltMarks& marks() = 0;
  virtual void check() {}  // hook after each tick of go()

  const scene::SharedParticles& particles() const { return *particles_; }

 private:
  std::unique_ptr<scene::SharedParticles> particles_;
  haptics::ParticleScale scale_;
  glm::dvec3 at_nm_;
  std::vector<haptics::ParticlePush::Event> events_;
};

}  // namespace afm::test
