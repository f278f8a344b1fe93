// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "physics/imaging/scan_image.h"
#include "physics/manipulation/ink.h"
#include "physics/units.h"
#include "scene/samples/particle_set.h"

// The scripted hand of a file with ink, played.
namespace afm::scene {

// A tip with ink, which it leaves while its apex is on the sample or pressed on it: z <= 0. A hand can write with
// one whose set has a tip and a lever.
struct InkSample {
  std::string name;
  physics::Ink ink;
  physics::Length thickness;                 // height of a layer
  physics::SurfaceEnergy surface_tension{};  // liquid that holds the tip; 0: no hand can write with it
};

// A move: what it has covered, and what the formulas say.
struct InkedMove {
  bool touches = false;
  physics::Time touched{};   // time on the sample, with the wait
  physics::Area covered;     // by this move
  physics::Length way;       // along the sample, on it
  physics::Length width;     // width of the line on the grid; 0: no line
  physics::Length by_speed;  // width by (M81), along a line
  physics::Length radius;    // dot where the move ends, by (M80); 0: no wait
};

struct InkRun {
  double seconds = 0.0;
  std::size_t ticks = 0;
  physics::Area covered, lost;  // in all, and beyond the grid
  physics::Length spacing;
  std::vector<InkedMove> moves;
  physics::ScanImage image;  // heights of the layer; one channel
};

// `set` has ink, and was loaded.
InkRun play_ink(const ParticleSet& set, physics::Frequency rate);

// Squares on which the hand of this set writes, and the margin around its places.
physics::Length ink_spacing(const ParticleSet& set);
physics::Length ink_margin(const ParticleSet& set);

}  // namespace afm::scene
