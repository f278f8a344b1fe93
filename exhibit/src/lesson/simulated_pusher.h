// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/result.h"

namespace afm::curves {
struct SampleModel;
}
namespace afm::scene {
struct ParticleSet;
}

namespace afm::exhibit {

class LessonRun;

// The hand of a simulated student who pushes particles: the servo's own code moves them, in simulated time. The student
// sees them 0.25 s late, trembles by 0.3 mm in the root mean square, and steers towards the line from particle to
// target. Repeatable for a seed on the same build. One thread.
class SimulatedPusher {
 public:
  // `set` must outlive the object. Fails if the servo cannot render sample or particles.
  static core::Result<std::unique_ptr<SimulatedPusher>> create(const curves::SampleModel& sample,
                                                               const scene::ParticleSet& set, std::uint64_t seed);
  virtual ~SimulatedPusher() = default;

  // Takes the step Push at which the run is to its end; `now_s` is the lesson's time, which it moves on. Failed if that
  // takes more than ten minutes.
  virtual core::Result<void> push(LessonRun& run, double& now_s) = 0;
};

}  // namespace afm::exhibit
