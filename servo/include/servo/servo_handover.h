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
#include "haptics/servo_loop.h"

// Handover of a servo whose renderer died to a new renderer, without opening and calibrating the device again. The two
// meet at a Unix socket in a private folder of the user ($XDG_RUNTIME_DIR/touchafm); each trusts only processes of the
// same user. Several servos may wait.
namespace afm::servo {

// The options of touchafm-servo that say how it runs and what it holds: a renderer that wants others wants another
// servo.
std::vector<std::string> servo_arguments(const haptics::ServoSettings& settings, const std::string& device);

// The waiting servo's end. Closed, nobody can find it any more.
class HandoverPort {
 public:
  // `program`: the path of touchafm-servo. Failed: the folder or the socket cannot be made.
  static core::Result<HandoverPort> open(const std::string& program, std::uint64_t scene_digest,
                                         const std::vector<std::string>& arguments);
  HandoverPort(HandoverPort&&) noexcept = default;
  HandoverPort& operator=(HandoverPort&&) = delete;
  ~HandoverPort();

  int descriptor() const { return listener_.get(); }  // readable when somebody has come

  // Shows the segment and the servo's arguments to a new renderer and waits at most a second for the answer. With Stay,
  // `lifeline` closes when that renderer dies; Leave: it wants another servo; Nobody: it was of another user, saw
  // nothing and does not count.
  enum class Answer { Stay, Leave, Nobody };
  Answer receive(int segment, const std::vector<std::string>& arguments, core::FileDescriptor& lifeline) const;

 private:
  HandoverPort(core::FileDescriptor listener, std::filesystem::path path)
      : listener_(std::move(listener)), path_(std::move(path)) {}

  core::FileDescriptor listener_;
  std::filesystem::path path_;
};

// A servo that waits, as the renderer sees it. To drop it is to tell it to leave.
struct WaitingServo {
  core::FileDescriptor segment;
  core::FileDescriptor lifeline;  // closes when this process dies
  core::FileDescriptor process;   // a pidfd
  std::vector<std::string> arguments;

  void stay() const;  // the answer that makes it go on
};

// The sockets of those that wait for a renderer of `program`, first the ones of this scene and these arguments. A servo
// that was killed leaves its socket behind.
std::vector<std::filesystem::path> find_waiting_servos(const std::string& program, std::uint64_t scene_digest,
                                                       const std::vector<std::string>& arguments);

// Empty: nobody answers there, within a second.
std::optional<WaitingServo> visit_servo(const std::filesystem::path& socket);

// Waits for the process behind a pidfd; false if it still runs after so long.
inline constexpr int kLeaveMs = 2000;  // for a servo that was asked to exit
bool process_ended_within(const core::FileDescriptor& process, int milliseconds);

}  // namespace afm::servo
