// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "headset/openxr.h"

namespace afm::render {

// Waits for the runtime's next frame on a separate thread, which the runtime may keep waiting for as long as it likes.
// Used by one other thread, which begins one wait at a time.
class FrameWait {
 public:
  FrameWait(PFN_xrWaitFrame wait, XrSession session) : call_(wait), session_(session), thread_([this] { run(); }) {}
  FrameWait(const FrameWait&) = delete;
  FrameWait& operator=(const FrameWait&) = delete;
  // Waits for a wait that is under way.
  ~FrameWait();

  void begin();
  bool under_way() const { return under_way_; }

  struct Answer {
    XrResult result = XR_SUCCESS;
    XrFrameState frame{};
  };
  // The answer to begin(), if it comes within `patience`.
  std::optional<Answer> answer_within(std::chrono::milliseconds patience);

 private:
  void run();

  PFN_xrWaitFrame call_;
  XrSession session_;
  bool under_way_ = false;  // as begin()'s thread knows it
  std::mutex changing_;
  std::condition_variable changed_;
  bool asked_ = false, ending_ = false;
  std::optional<Answer> answer_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace afm::render
