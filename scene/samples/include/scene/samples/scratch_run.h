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

// Playback of the scripted hand of a file with a soft sample.
namespace afm::scene {

// A sample that the tip scratches.
struct SoftSample {
  std::string name;
  physics::SoftSurface surface;
};

// Smallest rectangle along x and y that contains the start and the end of every move.
struct ScratchField {
  physics::Sideways<physics::Length> least, most;
};
ScratchField scratch_field(const ParticleSet& set);

// Load at the hand's lowest place on a sample that does not yield; 0 if the hand never presses.
physics::Force largest_load(const ParticleSet& set);

// State after one tick.
struct ScratchSample {
  double time_s = 0.0;
  physics::ScratchTick tick;
};

// Result of a move: its last tick, and means over its ticks.
struct ScratchedMove {
  ScratchSample end;
  physics::MarkVolumes volumes;    // volumes at the end of the move, since the start of the run
  bool marks = false;              // true: the tip leaves a mark in at least one tick
  physics::Force load, lateral;    // means of the second half of the move, where the groove has its full depth
  physics::Length depth;           // depth under load, mean of the second half of the move
  physics::GrooveSection section;  // section without load, at the end of a move that marks
};

struct ScratchRun {
  double seconds = 0.0;
  std::size_t ticks = 0, lagging = 0;
  double least_margin_j = 0.0;         // smallest certificate of all ticks
  std::vector<ScratchSample> samples;  // evenly spaced in time, including the last
  std::vector<ScratchedMove> moves;
  physics::ScanImage image;  // heights after the tip has left; one channel
};

// `set` is a loaded set with a soft sample; `samples` is at least 2.
ScratchRun play_scratch(const ParticleSet& set, physics::Frequency rate, std::size_t samples);

}  // namespace afm::scene
