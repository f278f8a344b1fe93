// SPDX-License-Identifier: Apache-2.0
#include "physics/curve_analysis.h"

namespace afm::physics {

CurveSummary summarise(std::span<const CurveSample> samples) {
  CurveSummary summary;
  const CurveSample* previous = nullptr;
  for (const CurveSample& sample : samples) {
    Extreme& extreme = sample.branch == Branch::Approach ? summary.approach : summary.retract;
    if (sample.force < extreme.force) extreme = {sample.z, sample.force};
    if (previous != nullptr) {
      summary.loop_energy = summary.loop_energy - 0.5 * (sample.force + previous->force) * (sample.z - previous->z);
    }
    previous = &sample;
  }
  return summary;
}

}  // namespace afm::physics
