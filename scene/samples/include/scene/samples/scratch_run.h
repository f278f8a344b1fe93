// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "physics/imaging/scan_image.h"
#include "physics/manipulation/marking.h"
#include "physics/manipulation/scratching_tip.h"
#include "physics/units.h"
#include "scene/samples/particle_set.h"

// The scripted hand of a file with a soft sample, played.
namespace afm::scene {

// A sample that the tip scratches.
struct SoftSample {
  std::string name;
  physics::SoftSurface surface;
};

// Smallest rectangle along x and y that has the start and the end of every move.
struct ScratchField {
  physics::Sideways<physics::Length> least, most;
};
ScratchField scratch_field(const ParticleSet& set);

// Load of the lowest place of the hand if the tip did not sink; 0 if the hand never presses.
physics::Force largest_load(const ParticleSet& set);

// State after one tick.
struct ScratchSample {
  double time_s = 0.0;
  physics::ScratchTick tick;
};

// A move: its end, and means of its ticks.
struct ScratchedMove {
  ScratchSample end;
  physics::MarkVolumes volumes;    // at its end, since the start
  bool marks = false;              // in any tick
  physics::Force load, lateral;    // means of the second half of the move, where a groove has its depth
  physics::Length depth;           // under load, the same
  physics::GrooveSection section;  // along a move that marks, at its end, without load
};

struct ScratchRun {
  double seconds = 0.0;
  std::size_t ticks = 0, lagging = 0;
  double least_margin_j = 0.0;         // least certificate of all ticks
  std::vector<ScratchSample> samples;  // evenly spaced in time, including the last
  std::vector<ScratchedMove> moves;
  physics::ScanImage image;  // heights at the end, when the tip has left; one channel
};

// `set` has a soft sample, and was loaded; `samples` is at least 2.
ScratchRun play_scratch(const ParticleSet& set, physics::Frequency rate, std::size_t samples);

}  // namespace afm::scene
