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
  double seconds = 0;   // 0: exit at once
  std::string program;  // path of touchafm-servo
  int segment = -1;
  std::uint64_t scene_digest = 0;      // scene of the segment
  std::vector<std::string> arguments;  // servo_arguments()
};

// Path of the running program; empty if the system does not provide it.
std::string executable_path();

// Thread that waits for the end of a servo: its renderer closes the socket, a signal asks it to exit, its watchdog
// dies, or this object is destroyed. Real-time like the servo, because the hand is held until it reacts.
class RendererMonitor {
 public:
  // `signals` is a signalfd, `watchdog` the descriptor of a Watchdog; they and the loop must outlive this object.
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
  std::thread thread_;  // last member: it uses all the others
};

}  // namespace afm::servo
