// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "headset/openxr_calls.h"
#include "render/headset.h"

namespace afm::render {

// A headset's controllers as OpenXR actions, one set for both hands. The hand that pressed an input last
// points. Turn-On is not among them: it stays on the haptic device that the hand holds.
class ControllerActions {
 public:
  // Suggests bindings for every controller in the core specification; the runtime lets its user change them.
  ControllerActions(const OpenXrInstance& calls, XrSession session);

  // Reads the controllers in a session with input focus. The pose is predicted for the time of a frame, in `base`, and
  // transformed to the room.
  HeadsetController read(XrSpace base, XrTime time, const scene::HeadPose& room_from_base);

  // Vibrates the controller that points.
  void pulse() const;

 private:
  // Actions in the order of kControllerActions in the source.
  enum Which : std::size_t { Aim, Select, Grab, Scale, Home, Fly, Pulse, kCount };

  XrAction create(Which which) const;
  void suggest() const;
  bool pressed(Which which, std::size_t hand) const;

  const OpenXrInstance& calls_;
  XrSession session_;
  XrActionSet set_ = XR_NULL_HANDLE;
  std::array<XrPath, 2> hands_{};
  std::array<XrAction, kCount> actions_{};
  std::array<XrSpace, 2> aims_{};
  std::size_t hand_ = 1;  // index of the hand that points; initially the right one, the more common
};

}  // namespace afm::render
