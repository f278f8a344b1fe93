// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

#include "core/file_descriptor.h"
#include "core/result.h"
#include "haptics/release_path.h"
#include "scene/shared/shared_segment.h"

// A process beside touchafm-servo that takes the force off the hand when the servo cannot do it any more: stopped,
// killed, or caught in a driver that does not return. It has no thread, opens nothing and allocates nothing while it
// watches.
namespace afm::servo {

// The servo's end. Its owner drops the device before it.
class Watchdog {
 public:
  // `program` is the path of touchafm-servo; `segment` the descriptor of what the servo's state is stored in.
  static core::Result<std::unique_ptr<Watchdog>> start(const std::string& program, int segment);

  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
  ~Watchdog();  // the device is closed: the watchdog leaves. Leaves no zombie

  // The newest way to the device. From any thread; waits for nothing.
  void offer(const haptics::ReleasePath& path) const noexcept;

  // The servo ticks no more and closes its device, within kWatchdogCloseMs.
  void expect_end() const noexcept;

  // Readable when the watchdog has ended by itself, and nothing guards the hand.
  int descriptor() const noexcept { return socket_.get(); }

 private:
  Watchdog(pid_t process, core::FileDescriptor socket) : process_(process), socket_(std::move(socket)) {}

  pid_t process_;
  core::FileDescriptor socket_;
};

// The watchdog's own process, until the servo has ended. Once TipState has been stored for the first time:
//
// - no new one for kWatchdogReleaseMs: zero is written through the newest path; the servo may go on afterwards
// - no new one for kWatchdogKillMs: the same, and the servo gets SIGKILL, so that the kernel closes the device
// - the device not closed within kWatchdogCloseMs after the servo's last tick: the same
// - the servo gone without a word: the same
//
// Times are counted in the watchdog's own wake-ups, so that a stop of the whole machine does not count.
inline constexpr int kWatchdogReleaseMs = 20;
// a busy virtual machine was seen to lose a processor for more than 200 ms
inline constexpr int kWatchdogKillMs = 1000;
inline constexpr int kWatchdogCloseMs = 1500;
void watch_servo(const core::FileDescriptor& servo, scene::SharedSegment& segment);

}  // namespace afm::servo
