// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "headset/openxr_calls.h"
#include "render/headset.h"

namespace afm::render {

// The controllers of a headset as OpenXR's actions, one set for both hands. The hand that pressed something last is the
// one that points. Turn-On is none of them: it stays on the device that holds the hand.
class ControllerActions {
 public:
  // Suggests bindings for every controller that the specification's core knows; the runtime lets its user change them.
  ControllerActions(const OpenXrInstance& calls, XrSession session);

  // In a session that has the input; the place is that of the time of a frame, in `base` and from there in the room.
  HeadsetController read(XrSpace base, XrTime time, const scene::HeadPose& room_from_base);

  // A push of the hand that points.
  void pulse() const;

 private:
  // In the order of kControllerActions in the source.
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
  std::size_t hand_ = 1;  // most people's
};

}  // namespace afm::render
