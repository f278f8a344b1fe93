// SPDX-License-Identifier: Apache-2.0
#include "curves/recorded_curve.h"
#include "core/version.h"

namespace afm::curves {

RecordedCurve recorded_curve(const physics::ForceCurve& curve, physics::Stiffness spring_constant) {
  RecordedCurve recorded{physics::points_of(curve.samples), {}, {}};
  recorded.metadata.spring_constant = spring_constant;
  recorded.metadata.instrument = "TouchAFM";
  recorded.metadata.software = kComputedBy;
  recorded.metadata.software_version = core::kVersion;
  return recorded;
}

}  // namespace afm::curves
