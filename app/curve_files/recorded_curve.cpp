// SPDX-License-Identifier: Apache-2.0
#include "app/curve_files/recorded_curve.h"

namespace afm::app {

RecordedCurve recorded_curve(const physics::ForceCurve& curve, physics::Stiffness spring_constant) {
  RecordedCurve recorded{physics::points_of(curve.samples), {}, {}};
  recorded.metadata.spring_constant = spring_constant;
  recorded.metadata.instrument = "TouchAFM";
  recorded.metadata.software = kComputedBy;
  recorded.metadata.software_version = AFM_VERSION;
  return recorded;
}

}  // namespace afm::app
