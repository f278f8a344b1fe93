// SPDX-License-Identifier: Apache-2.0
#include "headset/frame_wait.h"

#include <utility>

#include "core/check.h"

namespace afm::render {

FrameWait::~FrameWait() {
  {
    const std::scoped_lock lock(changing_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void FrameWait::begin() {
  AFM_CHECK(!under_way_);
  under_way_ = true;
  {
    const std::scoped_lock lock(changing_);
    asked_ = true;
  }
  changed_.notify_all();
}

std::optional<FrameWait::Answer> FrameWait::answer_within(std::chrono::milliseconds patience) {
  std::unique_lock lock(changing_);
  if (!changed_.wait_for(lock, patience, [this] { return answer_.has_value(); })) return std::nullopt;
  under_way_ = false;
  return std::exchange(answer_, std::nullopt);
}

void FrameWait::run() {
  std::unique_lock lock(changing_);
  while (true) {
    changed_.wait(lock, [this] { return asked_ || ending_; });
    if (ending_) return;
    asked_ = false;
    lock.unlock();
    const XrFrameWaitInfo info{.type = XR_TYPE_FRAME_WAIT_INFO, .next = nullptr};
    Answer answer;
    answer.frame.type = XR_TYPE_FRAME_STATE;
    answer.result = call_(session_, &info, &answer.frame);
    lock.lock();
    answer_ = answer;
    changed_.notify_all();
  }
}

}  // namespace afm::render
