// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thread>

#include "core/file_descriptor.h"
#include "force_guard.h"
#include "scene/shared/shared_segment.h"

namespace afm::servo {

// Second guard of the hand, a thread of the renderer, for a servo whose watchdog is gone too: zero force once the servo
// has ended or not ticked for kRendererReleaseMs, and its end after kRendererKillMs. Silent as long as the watchdog is
// there, which acts first.
inline constexpr int kRendererReleaseMs = 60;  // three times the watchdog's release time
inline constexpr int kRendererKillMs = 1500;
inline constexpr int kRendererCloseMs = 3000;  // time longer than a servo needs to end by itself
class RendererGuard {
 public:
  // `lifeline` is a socket to the servo, `process` its pidfd; they and the segment outlive this object.
  RendererGuard(int lifeline, int process, scene::SharedSegment& segment);
  RendererGuard(const RendererGuard&) = delete;
  RendererGuard& operator=(const RendererGuard&) = delete;
  ~RendererGuard();

 private:
  void watch();

  core::FileDescriptor dismissal_;
  ForceGuard guard_;
  std::thread thread_;  // last member, because the thread uses all the others
};

}  // namespace afm::servo
