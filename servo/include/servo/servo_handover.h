// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/file_descriptor.h"
#include "core/result.h"

namespace afm::haptics {
struct ServoSettings;
}

// Handover of a servo whose renderer died to a new renderer, without opening and calibrating the device again. They
// meet at a Unix socket in a private folder of the user ($XDG_RUNTIME_DIR/touchafm), and each trusts only processes of
// the same user. Several servos may wait.
namespace afm::servo {

// Options of touchafm-servo that determine how it runs and what it holds. A renderer with different options needs a
// different servo.
std::vector<std::string> servo_arguments(const haptics::ServoSettings& settings, const std::string& device);

// Waiting servo's end of the handover. Once it is closed, nobody can find the servo.
class HandoverPort {
 public:
  // `program` is the path of touchafm-servo. Failed: the folder or the socket cannot be created.
  static core::Result<HandoverPort> open(const std::string& program, std::uint64_t scene_digest,
                                         const std::vector<std::string>& arguments);
  HandoverPort(HandoverPort&&) noexcept = default;
  HandoverPort& operator=(HandoverPort&&) = delete;
  ~HandoverPort();

  int descriptor() const { return listener_.get(); }  // descriptor that is readable when a renderer has connected

  // Shows the segment and the servo's arguments to a new renderer, and waits at most a second for the answer. Stay:
  // `lifeline` closes when that renderer dies. Leave: the renderer needs a different servo. Nobody: the peer belonged
  // to another user, received nothing and does not count.
  enum class Answer { Stay, Leave, Nobody };
  Answer receive(int segment, const std::vector<std::string>& arguments, core::FileDescriptor& lifeline) const;

 private:
  HandoverPort(core::FileDescriptor listener, std::filesystem::path path)
      : listener_(std::move(listener)), path_(std::move(path)) {}

  core::FileDescriptor listener_;
  std::filesystem::path path_;
};

// Waiting servo, as seen by the renderer. Destroying it asks the servo to exit.
struct WaitingServo {
  core::FileDescriptor segment;
  core::FileDescriptor lifeline;  // socket that closes when this process dies
  core::FileDescriptor process;   // pidfd of the servo
  std::vector<std::string> arguments;

  void stay() const;  // sends the answer that keeps the servo running
};

// Sockets of the servos waiting for a renderer of `program`, those with this scene and these arguments first. A killed
// servo leaves its socket behind.
std::vector<std::filesystem::path> find_waiting_servos(const std::string& program, std::uint64_t scene_digest,
                                                       const std::vector<std::string>& arguments);

// Connects to a waiting servo. Empty if nobody answers within a second.
std::optional<WaitingServo> visit_servo(const std::filesystem::path& socket);

// Waits for the process behind a pidfd; false if it still runs after that time.
inline constexpr int kLeaveMs = 2000;  // longest wait for a servo that was asked to exit
bool process_ended_within(const core::FileDescriptor& process, int milliseconds);

}  // namespace afm::servo
