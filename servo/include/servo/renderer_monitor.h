// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/file_descriptor.h"
#include "haptics/servo_loop.h"
#include "servo/servo_handover.h"

namespace afm::servo {

// Behaviour of touchafm-servo after its renderer has died: it keeps the device for this time and offers its segment to
// a new renderer.
struct Linger {
  double seconds = 0;   // 0: end at once
  std::string program;  // the path of touchafm-servo
  int segment = -1;
  std::uint64_t scene_digest = 0;      // of the segment
  std::vector<std::string> arguments;  // servo_arguments()
};

// The path of the running program; empty if the system does not tell.
std::string executable_path();

// A thread that waits for what ends a servo: its renderer's end of the socket closes, a signal asks to end, its
// watchdog dies, or this object goes. Real-time like the servo, because the hand is held until it is heard.
class RendererMonitor {
 public:
  // `signals` is a signalfd, `watchdog` the descriptor of a Watchdog; they and the loop must outlive this.
  RendererMonitor(haptics::ServoLoop& loop, core::FileDescriptor lifeline, const core::FileDescriptor& signals,
                  int watchdog, Linger linger);
  RendererMonitor(const RendererMonitor&) = delete;
  RendererMonitor& operator=(const RendererMonitor&) = delete;
  ~RendererMonitor();

 private:
  enum class Update { Done, Signal, Unguarded, Readable, Nothing };

  void watch();
  Update wait_for(int descriptor, std::optional<int> milliseconds) const;
  bool find_successor();

  haptics::ServoLoop& loop_;
  core::FileDescriptor lifeline_;
  const core::FileDescriptor& signals_;
  int watchdog_;
  Linger linger_;
  core::FileDescriptor done_;
  std::thread thread_;  // last: it uses all of them
};

}  // namespace afm::servo
