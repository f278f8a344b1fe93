// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/samples/particle_set.h"

namespace afm::scene {

// Smallest rectangle along x and y that contains all centres, and all rods in any direction.
struct ParticleField {
  physics::Sideways<physics::Length> least, most;

  physics::Sideways<physics::Length> middle() const { return (least + most) * 0.5; }
  bool holds(const physics::Sideways<physics::Length>& place) const {
    return place.x >= least.x && place.x <= most.x && place.y >= least.y && place.y <= most.y;
  }
};
ParticleField field_of(const ParticleSet& set);

}  // namespace afm::scene
