// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device/device.h"
#include "headset/runtime_parts.h"

namespace afm::render {

// Session on the device that the runtime has chosen. Destroying this destroys the session and everything created from
// it. Throws OpenXrFailure.
class SessionHandle {
 public:
  SessionHandle(const HeadsetRuntimeParts& runtime, const Device& device);
  SessionHandle(const SessionHandle&) = delete;
  SessionHandle& operator=(const SessionHandle&) = delete;
  ~SessionHandle() { calls_.DestroySession(session_); }
  operator XrSession() const { return session_; }

  // Formats in the runtime's order of preference.
  std::vector<std::int64_t> formats() const;

 private:
  const OpenXrInstance& calls_;
  XrSession session_ = XR_NULL_HANDLE;
};

}  // namespace afm::render
