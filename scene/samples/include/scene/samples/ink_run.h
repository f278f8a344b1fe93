// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "physics/imaging/scan_image.h"
#include "physics/manipulation/ink.h"
#include "physics/units.h"
#include "scene/samples/particle_set.h"

// Playback of the scripted hand of a file with ink.
namespace afm::scene {

// Ink on a tip, deposited while the apex is on the sample or pressed into it: z <= 0. A person can write with it if the
// set has a tip and a lever.
struct InkSample {
  std::string name;
  physics::Ink ink;
  physics::Length thickness;                 // height of one layer of ink
  physics::SurfaceEnergy surface_tension{};  // liquid that holds the tip; 0: unsuitable for a person's hand
};

// Measured and predicted result of a move.
struct InkedMove {
  bool touches = false;
  physics::Time touched{};   // time on the sample, including the wait
  physics::Area covered;     // area covered by this move
  physics::Length way;       // path along the sample while touching
  physics::Length width;     // width of the line on the grid; 0: no line
  physics::Length by_speed;  // width predicted by (M81) for a line
  physics::Length radius;    // radius of the dot at the move's end, by (M80); 0: no wait
};

struct InkRun {
  double seconds = 0.0;
  std::size_t ticks = 0;
  physics::Area covered, lost;  // total covered area, and area beyond the grid
  physics::Length spacing;
  std::vector<InkedMove> moves;
  physics::ScanImage image;  // heights of the layer in one channel
};

// Plays the moves of a loaded set that has ink.
InkRun play_ink(const ParticleSet& set, physics::Frequency rate);

// Size of the squares on which the hand of this set writes, and the margin around its places.
physics::Length ink_spacing(const ParticleSet& set);
physics::Length ink_margin(const ParticleSet& set);

}  // namespace afm::scene
