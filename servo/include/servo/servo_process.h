// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "core/file_descriptor.h"
#include "core/interruption.h"
#include "core/result.h"
#include "haptics/device.h"
#include "haptics/edit_thread.h"
#include "haptics/servo_settings.h"
#include "scene/shared/shared_segment.h"
#include "servo/running_servo.h"
#include "servo/servo_handover.h"

// Starts a servo, monitors it and ends it.
namespace afm::haptics {
class ServoLoop;
}  // namespace afm::haptics

namespace afm::servo {

class RendererGuard;

// touchafm-servo as a child process. It inherits only the standard streams, the segment and one end of a socket pair.
// When this process dies, for whatever reason, the kernel closes the other end, and the servo releases the hand. When
// the servo dies or is silent, and its watchdog with it, a thread of this process releases the hand.
class ServoProcess final : public Servo {
 public:
  // `program` is the path of touchafm-servo; `settings` are those of ServoLoop; `device` is a value of touchafm's
  // --haptics. If the servo cannot open the device, it prints the reason to stderr and ends with one of the program's
  // exit codes.
  static core::Result<std::unique_ptr<ServoProcess>> spawn(const std::string& program, scene::SharedSegment& segment,
                                                           scene::RendererSide& side,
                                                           const haptics::ServoSettings& settings,
                                                           const std::string& device = "sim");

  // Waits at most 2 s for the servo to exit, then terminates and finally kills it. Leaves no zombie.
  ~ServoProcess() override;

  bool alive() noexcept override;
  std::optional<int> exit_status() noexcept override;
  pid_t pid() const noexcept { return pid_; }

 private:
  ServoProcess(pid_t pid, core::FileDescriptor lifeline, scene::SharedSegment& segment, scene::RendererSide& side);

  bool ended_within(int milliseconds) noexcept;

  pid_t pid_;
  core::FileDescriptor process_;  // pidfd of the child
  core::FileDescriptor lifeline_;
  scene::RendererSide& side_;
  std::optional<int> exit_status_;
  core::OnInterruption terminate_;
  std::unique_ptr<RendererGuard> guard_;  // last member, because it must end first
};

// Servo started by another renderer, which has died. It is not a child of this process.
class AdoptedServo final : public Servo {
 public:
  // `segment` came with it, and `side` belongs to it.
  static std::unique_ptr<AdoptedServo> adopt(WaitingServo waiting, scene::SharedSegment& segment,
                                             scene::RendererSide& side);

  // Ends it like ServoProcess does.
  ~AdoptedServo() override;

  bool alive() noexcept override { return !exit_status().has_value(); }
  std::optional<int> exit_status() noexcept override;  // code 1 once it has ended, because its own is unknown

 private:
  AdoptedServo(WaitingServo waiting, scene::SharedSegment& segment, scene::RendererSide& side);

  WaitingServo waiting_;
  scene::RendererSide& side_;
  std::unique_ptr<RendererGuard> guard_;  // last member, because it must end first
};

// The servo's loop as a thread of this process, for sanitizers and debuggers. Its pages are not locked, so it reports
// itself as not real-time; a debugger's stop disarms it.
class ServoThread final : public Servo {
 public:
  static core::Result<std::unique_ptr<ServoThread>> start(scene::SharedSegment& segment, scene::RendererSide& side,
                                                          const haptics::ServoSettings& settings,
                                                          std::unique_ptr<haptics::HapticDevice> device);
  ~ServoThread() override;

  bool alive() noexcept override { return !exit_status().has_value(); }
  std::optional<int> exit_status() noexcept override;

 private:
  ServoThread(std::unique_ptr<haptics::HapticDevice> device, std::unique_ptr<haptics::ServoLoop> loop,
              scene::RendererSide& side);

  std::unique_ptr<haptics::HapticDevice> device_;
  std::unique_ptr<haptics::ServoLoop> loop_;
  haptics::EditThread edits_;
  scene::RendererSide& side_;
  std::atomic<int> exit_status_{kRunning};
  std::thread thread_;
  core::OnInterruption release_;

  static constexpr int kRunning = -1;
};

}  // namespace afm::servo
