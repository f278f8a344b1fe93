// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

#include "core/file_descriptor.h"
#include "core/result.h"
#include "haptics/release_path.h"
#include "scene/shared/shared_segment.h"

// Process next to touchafm-servo that removes the force from the hand when the servo cannot: stopped, killed, or stuck
// in a driver. It has no thread, and opens and allocates nothing while it watches.
namespace afm::servo {

// Servo's end of the watchdog. Destroy it after the device.
class Watchdog {
 public:
  // `program` is the path of touchafm-servo; `segment` is the descriptor of the segment with the servo's state.
  static core::Result<std::unique_ptr<Watchdog>> start(const std::string& program, int segment);

  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
  ~Watchdog();  // the device is closed: the watchdog exits. Leaves no zombie

  // Passes on the newest way to write to the device. Any thread; never waits.
  void offer(const haptics::ReleasePath& path) const noexcept;

  // Announces that the servo ticks no more, and closes its device within kWatchdogCloseMs.
  void expect_end() const noexcept;

  // Readable if the watchdog has ended by itself, so that nothing guards the hand.
  int descriptor() const noexcept { return socket_.get(); }

 private:
  Watchdog(pid_t process, core::FileDescriptor socket) : process_(process), socket_(std::move(socket)) {}

  pid_t process_;
  core::FileDescriptor socket_;
};

// Body of the watchdog's process; returns when the servo has ended. Once TipState has been stored for the first time:
//
// - no new one for kWatchdogReleaseMs: it writes zero force through the newest path; the servo may continue afterwards
// - no new one for kWatchdogKillMs: it also sends SIGKILL to the servo, so that the kernel closes the device
// - the device not closed within kWatchdogCloseMs after the servo's last tick: the same
// - the servo gone without notice: the same
//
// Times are counted in the watchdog's own wake-ups, so that a pause of the whole machine does not count.
inline constexpr int kWatchdogReleaseMs = 20;
// a busy virtual machine has lost a processor for more than 200 ms
inline constexpr int kWatchdogKillMs = 1000;
inline constexpr int kWatchdogCloseMs = 1500;
void watch_servo(const core::FileDescriptor& servo, scene::SharedSegment& segment);

}  // namespace afm::servo
