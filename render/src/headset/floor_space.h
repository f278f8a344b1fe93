// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "headset/openxr_calls.h"

namespace afm::render {

// The frame with its origin on the floor below the wearer, who looks along -z when the session begins or the headset is
// recentred: the runtime's, where it has one; else its frame at eye level, lowered by its height above the floor of the
// play area; else by that of a standing person's eyes.
class FloorSpace {
 public:
  // `local_floor`: the instance has XR_EXT_local_floor.
  FloorSpace(const OpenXrInstance& calls, XrSession session, bool local_floor);

  // At a frame's time. Measures the floor at the first frame and after a recentring.
  XrSpace at(XrTime time);
  void recentered() { measured_ = false; }

  // How the floor was found, in words.
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
