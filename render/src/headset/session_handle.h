// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device/device.h"
#include "headset/runtime_parts.h"

namespace afm::render {

// A session on the device that the runtime has chosen; destroyed with this, and with it all that was made of it. Throws
// OpenXrFailure.
class SessionHandle {
 public:
  SessionHandle(const HeadsetRuntimeParts& runtime, const Device& device);
  SessionHandle(const SessionHandle&) = delete;
  SessionHandle& operator=(const SessionHandle&) = delete;
  ~SessionHandle() { calls_.DestroySession(session_); }
  operator XrSession() const { return session_; }

  // In the runtime's order.
  std::vector<std::int64_t> formats() const;

 private:
  const OpenXrInstance& calls_;
  XrSession session_ = XR_NULL_HANDLE;
};

}  // namespace afm::render
