// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>
#include <utility>

#include "core/file_descriptor.h"
#include "core/result.h"
#include "scene/shared/shared_segment.h"

// touchafm-guard, the process next to touchafm-servo that removes the force from the hand when the servo cannot:
// stopped, killed, or stuck in a driver. It has no thread, and opens and allocates nothing while it watches. Its name,
// its group and, where systemd offers one, its scope differ from the servo's, so that no command meant for the servo
// takes both; of all signals only KILL and STOP reach it.
namespace afm::servo {

// Servo's end of the watchdog. Destroy it after the device.
class Watchdog {
 public:
  // `program` is the path of touchafm-guard; `segment` is the descriptor of the segment with the servo's state. Waits
  // for its first beat, at most 5 s. Failed: it cannot be started, or does not beat.
  static core::Result<std::unique_ptr<Watchdog>> start(const std::string& program, int segment);

  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
  ~Watchdog();  // call after the device is closed: the watchdog exits. Leaves no zombie

  // Socket of its beats, one every 10 ms; closed by its end. Take beats with take_beat().
  int descriptor() const noexcept { return socket_.get(); }

 private:
  Watchdog(pid_t process, core::FileDescriptor socket) : process_(process), socket_(std::move(socket)) {}

  pid_t process_;
  core::FileDescriptor socket_;
};

// Takes one beat from a watchdog's socket without waiting. False: the watchdog has ended, and nothing guards the hand.
bool take_beat(int socket) noexcept;

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
