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
#include "haptics/servo_loop.h"
#include "scene/shared/shared_segment.h"
#include "servo/servo_handover.h"

// Starts a servo, monitors it and ends it.
namespace afm::servo {

// A running servo. Used by the thread that stores heartbeats; the segment and its RendererSide must outlive it.
//
// The destructor ends it in good order: it stores a heartbeat that says `leaving`, which fades the force, and waits.
// The caller stores no other heartbeat from then on.
class Servo {
 public:
  Servo() = default;
  Servo(const Servo&) = delete;
  Servo& operator=(const Servo&) = delete;
  virtual ~Servo() = default;

  virtual bool alive() noexcept = 0;

  // Once it has ended: its exit code, or 128 and the number of the signal that ended it, as a shell counts.
  virtual std::optional<int> exit_status() noexcept = 0;
};

// touchafm-servo as a child process, which inherits the standard streams, the segment and one end of a socket pair, and
// nothing else. When this process dies, in whatever way, the kernel closes the other end, and the servo releases the
// hand.
class ServoProcess final : public Servo {
 public:
  // `program` is the path of touchafm-servo; `settings` are what ServoLoop takes; `device` names the device as
  // touchafm's --haptics does. A servo that cannot have it says why on stderr and ends with an exit code of the
  // program.
  static core::Result<std::unique_ptr<ServoProcess>> spawn(const std::string& program, scene::SharedSegment& segment,
                                                           scene::RendererSide& side,
                                                           const haptics::ServoSettings& settings,
                                                           const std::string& device = "sim");

  // Waits at most 2 s for the servo to leave; then it is terminated, then killed. Leaves no zombie.
  ~ServoProcess() override;

  bool alive() noexcept override;
  std::optional<int> exit_status() noexcept override;
  pid_t pid() const noexcept { return pid_; }

 private:
  ServoProcess(pid_t pid, core::FileDescriptor lifeline, scene::RendererSide& side);

  bool ended_within(int milliseconds) noexcept;

  pid_t pid_;
  core::FileDescriptor lifeline_;
  scene::RendererSide& side_;
  std::optional<int> exit_status_;
  core::OnInterruption terminate_;
};

// A servo that another renderer started, which has died. It is no child of this process.
class AdoptedServo final : public Servo {
 public:
  // `side` is of the segment that came with it.
  static std::unique_ptr<AdoptedServo> adopt(WaitingServo waiting, scene::RendererSide& side);

  // Ends it as ServoProcess does.
  ~AdoptedServo() override;

  bool alive() noexcept override { return !exit_status().has_value(); }
  std::optional<int> exit_status() noexcept override;  // 1, whatever it was

 private:
  AdoptedServo(WaitingServo waiting, scene::RendererSide& side) : waiting_(std::move(waiting)), side_(side) {}

  WaitingServo waiting_;
  scene::RendererSide& side_;
};

// The same loop as a thread of this process, for sanitizers and debuggers. Its pages are
// not locked, so it reports itself as not real-time; a debugger's stop disarms it.
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
