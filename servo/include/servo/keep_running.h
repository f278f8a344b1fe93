// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "core/file_descriptor.h"
#include "core/result.h"

namespace afm::servo {

// Limits of a program that is kept running. They count the time in which this process runs, so that neither a sleeping
// machine nor a stopped keeper looks like a program that hangs.
struct KeepLimits {
  std::chrono::milliseconds start{120'000};   // limit of the wait for the first beat
  std::chrono::milliseconds silence{10'000};  // longest time between two beats
  std::chrono::milliseconds end{8'000};       // allowed time after SIGTERM; longer than a program needs to end
};

// Runs `program` with `arguments` and restarts it after each failure, crash or silence, until it exits with success or
// with a permanent error (exit codes 2 to 4), or until SIGINT, SIGTERM or SIGHUP ends both. A program that falls silent
// after a heartbeat is killed, and so is one that does not end in time; if this process is killed, the program is, too.
// Failed: more than kMostRestarts failures within a minute. Main thread only.
core::Result<void> keep_running(const std::string& program, const std::vector<std::string>& arguments,
                                const KeepLimits& limits = {});

inline constexpr int kMostRestarts = 5;

// Descriptor to which the program sends its beats.
inline constexpr int kBeatDescriptor = 3;

// Other end of keep_running(), in the program that is kept running. One thread.
class KeptBeat {
 public:
  // Takes over the descriptor. WrongUsage: it is no socket.
  static core::Result<KeptBeat> at(int descriptor);

  // Call once a frame, or more often; never waits. False: the keeper has ended.
  bool beat() noexcept;

 private:
  explicit KeptBeat(core::FileDescriptor socket) : socket_(std::move(socket)) {}
  core::FileDescriptor socket_;
};

}  // namespace afm::servo
