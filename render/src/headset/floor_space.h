// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "headset/openxr_calls.h"

namespace afm::render {

// Reference frame with its origin on the floor below the wearer, who looks along -z when the session begins or the
// headset is recentred. Uses the runtime's floor frame if there is one. Otherwise it lowers the frame at eye level by
// its height above the floor of the play area or, failing that, by the eye height of a standing person.
class FloorSpace {
 public:
  // `local_floor` is true if the instance has XR_EXT_local_floor.
  FloorSpace(const OpenXrInstance& calls, XrSession session, bool local_floor);

  // The frame at the time of a video frame. Measures the floor at the first call and after recentring.
  XrSpace at(XrTime time);
  void recentered() { measured_ = false; }

  // Description of how the floor was found.
  const std::string& source() const { return source_; }

  static constexpr float kStandingEyesM = 1.65F;

 private:
  XrSpace create(XrReferenceSpaceType type, float up_m) const;
  float height_above_floor(XrTime time);

  const OpenXrInstance& calls_;
  XrSession session_;
  bool has_stage_ = false;
  bool has_floor_ = false;
  bool measured_ = false;
  XrSpace local_ = XR_NULL_HANDLE, stage_ = XR_NULL_HANDLE, floor_ = XR_NULL_HANDLE;
  std::string source_;
};

}  // namespace afm::render
