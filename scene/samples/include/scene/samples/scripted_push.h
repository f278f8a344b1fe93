// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "physics/manipulation/operators_picture.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/units.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/task_score.h"

namespace afm::scene {

// Playing of a scripted hand's moves, and the distance of its picture from the particles.
struct PushScript {
  physics::Frequency rate{1000.0};  // ticks per second
  int samples = 100;                // number of printed moments, at least 2
  int level = 0;                    // 0: no picture; 1: computed picture without errors; 2: with drift and scatter
  int seed = 1;                     // seed of drift and scatter, 1 to 65535
  bool looks = true;                // true: the hand takes second looks
};

// One printed tick, in the frame of the scanner.
struct PushMoment {
  double time_s = 0.0;
  physics::PushTick tick;
};

struct ScriptedPush {
  double seconds = 0.0;
  std::size_t ticks = 0, lagging = 0;
  double least_margin_j = 0.0;                       // smallest certificate of all ticks
  bool more_changes = false;                         // true: more changes occurred than `changes` holds
  std::vector<PushMoment> samples;                   // moments at equal intervals, including the last
  std::vector<PushMoment> changes;                   // ticks in which state or particle changes
  std::vector<PushMoment> ends;                      // last tick of each move, after its wait
  std::vector<physics::ParticlePlace> at;            // places of the particles at the end, in the frame of the scanner
  TaskScore score;                                   // score of a set with a pattern
  physics::Sideways<physics::Length> drift;          // displacement of the sample at the end
  std::optional<physics::OperatorsPicture> picture;  // picture at the end; from level 1 on

  // True if everything that was pushed has been measured since; otherwise no pattern is done.
  bool judged() const;

  // Places by which the pattern is judged; with a picture, the places that it shows.
  std::vector<physics::ParticlePlace> judged_places() const;
};

double margin_j(const physics::PushTick& tick);  // certificate: energy given, less energy lost and stored

// Plays the moves of the set, which has at least one. With a picture the hand aims by it: after a second look it shifts
// the written places by the offset found; the task ends only once everything pushed has been measured again.
ScriptedPush play(const ParticleSet& set, const PushScript& script);

}  // namespace afm::scene
