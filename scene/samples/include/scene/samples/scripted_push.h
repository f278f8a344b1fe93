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
  int samples = 100;                // at least 2
  int level = 0;                    // 0: no picture; 1: the computed picture is true; 2: drift and scatter
  int seed = 1;                     // seed of drift and scatter, 1 to 65535
  bool looks = true;                // the hand looks again
};

// One tick that is printed, in the frame of the scanner.
struct PushMoment {
  double time_s = 0.0;
  physics::PushTick tick;
};

struct ScriptedPush {
  double seconds = 0.0;
  std::size_t ticks = 0, lagging = 0;
  double least_margin_j = 0.0;                       // least certificate of all ticks
  bool more_changes = false;                         // more than `changes` has
  std::vector<PushMoment> samples;                   // moments at equal intervals, with the last
  std::vector<PushMoment> changes;                   // ticks in which state or particle changes
  std::vector<PushMoment> ends;                      // end of each move and its wait
  std::vector<physics::ParticlePlace> at;            // places of the particles at the end, in the frame of the scanner
  TaskScore score;                                   // only for a set with a pattern
  physics::Sideways<physics::Length> drift;          // way of the sample at the end
  std::optional<physics::OperatorsPicture> picture;  // only from level 1 on

  // True if all that was pushed has been measured since; otherwise no pattern is done.
  bool judged() const;

  // Places by which the pattern is judged: with a picture those that it shows.
  std::vector<physics::ParticlePlace> judged_places() const;
};

double margin_j(const physics::PushTick& tick);  // given energy, less what is lost and stored

// The moves of the set, which has at least one. With a picture the hand aims by it: after a second look, as far beside
// the written places as the look has found; the task ends only once all that was pushed has been measured again.
ScriptedPush play(const ParticleSet& set, const PushScript& script);

}  // namespace afm::scene
