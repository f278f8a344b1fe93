// SPDX-License-Identifier: Apache-2.0
#include "headset/floor_space.h"

#include <algorithm>

#include "headset/openxr_pose.h"

namespace afm::render {

FloorSpace::FloorSpace(const OpenXrInstance& calls, XrSession session, bool local_floor)
    : calls_(calls), session_(session) {
  const auto types = openxr_list<XrReferenceSpaceType>(
      "xrEnumerateReferenceSpaces", {}, [&](auto... more) { return calls.EnumerateReferenceSpaces(session, more...); });
  const auto has = [&](XrReferenceSpaceType type) {
    return std::find(types.begin(), types.end(), type) != types.end();
  };
  has_floor_ = local_floor && has(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT);
  has_stage_ = has(XR_REFERENCE_SPACE_TYPE_STAGE);
  if (has_floor_) {
    floor_ = create(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT, 0.0F);
    source_ = "as the runtime has it";
    return;
  }
  local_ = create(XR_REFERENCE_SPACE_TYPE_LOCAL, 0.0F);
  if (has_stage_) stage_ = create(XR_REFERENCE_SPACE_TYPE_STAGE, 0.0F);
}

XrSpace FloorSpace::create(XrReferenceSpaceType type, float up_m) const {
  XrReferenceSpaceCreateInfo info{.type = XR_TYPE_REFERENCE_SPACE_CREATE_INFO,
                                  .next = nullptr,
                                  .referenceSpaceType = type,
                                  .poseInReferenceSpace = kOpenXrOrigin};
  info.poseInReferenceSpace.position.y = up_m;
  XrSpace space = XR_NULL_HANDLE;
  check_openxr(calls_.CreateReferenceSpace(session_, &info, &space), "xrCreateReferenceSpace");
  return space;
}

float FloorSpace::height_above_floor(XrTime time) {
  auto found = openxr_struct<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
  if (has_stage_ && XR_SUCCEEDED(calls_.LocateSpace(local_, stage_, time, &found)) && is_placed(found.locationFlags)) {
    source_ = "that of the play area";
    return found.pose.position.y;
  }
  source_ = "unknown to the runtime and taken to be 1.65 m below the headset's origin";
  return kStandingEyesM;
}

XrSpace FloorSpace::at(XrTime time) {
  if (has_floor_ || measured_) return floor_;
  if (floor_ != XR_NULL_HANDLE) calls_.DestroySpace(floor_);
  floor_ = create(XR_REFERENCE_SPACE_TYPE_LOCAL, -height_above_floor(time));
  measured_ = true;
  return floor_;
}

}  // namespace afm::render
