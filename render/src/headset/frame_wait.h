// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "headset/openxr.h"

namespace afm::render {

// Waits for the runtime's next frame on a separate thread, because the runtime may block it indefinitely. Used by one
// other thread, which begins one wait at a time.
class FrameWait {
 public:
  FrameWait(PFN_xrWaitFrame wait, XrSession session) : call_(wait), session_(session), thread_([this] { run(); }) {}
  FrameWait(const FrameWait&) = delete;
  FrameWait& operator=(const FrameWait&) = delete;
  // Blocks until a running wait ends.
  ~FrameWait();

  void begin();
  bool under_way() const { return under_way_; }

  struct Answer {
    XrResult result = XR_SUCCESS;
    XrFrameState frame{};
  };
  // Result of the last wait, if it ends within `patience`.
  std::optional<Answer> answer_within(std::chrono::milliseconds patience);

 private:
  void run();

  PFN_xrWaitFrame call_;
  XrSession session_;
  bool under_way_ = false;  // only for the thread that calls begin()
  std::mutex changing_;
  std::condition_variable changed_;
  bool asked_ = false, ending_ = false;
  std::optional<Answer> answer_;
  std::thread thread_;  // last member, because it uses all the others
};

}  // namespace afm::render
