// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/file_descriptor.h"
#include "servo/release_link.h"
#include "servo/servo_handover.h"

namespace afm::haptics {
class ServoLoop;
}

namespace afm::servo {

// Behaviour of touchafm-servo after its renderer has died: it keeps the device for this time and offers its segment to
// a new renderer.
struct Linger {
  double seconds = 0;   // time to wait for a new renderer; 0: exit at once
  std::string program;  // path of touchafm-servo
  int segment = -1;
  std::uint64_t scene_digest = 0;      // digest of the segment's scene
  std::vector<std::string> arguments;  // arguments as from servo_arguments()
};

// Silence of the watchdog after which the servo releases the hand, which nothing guards any more, and ends.
inline constexpr int kWatchdogSilentMs = 80;

// Thread that waits for the end of a servo: its renderer closes the socket, a signal asks it to exit, its watchdog
// ends or is stopped, or this object is destroyed. Real-time like the servo, because the hand is held until it reacts.
class RendererMonitor {
 public:
  // `signals` is a signalfd, `watchdog` the descriptor of a Watchdog; they, the loop and the link must outlive this
  // object.
  RendererMonitor(haptics::ServoLoop& loop, core::FileDescriptor lifeline, const core::FileDescriptor& signals,
                  int watchdog, ReleaseLink& link, Linger linger);
  RendererMonitor(const RendererMonitor&) = delete;
  RendererMonitor& operator=(const RendererMonitor&) = delete;
  ~RendererMonitor();

 private:
  enum class Update { Done, Signal, Unguarded, Readable, Nothing };

  void watch();
  Update wait_for(int descriptor, std::optional<int> milliseconds);
  bool guarded(bool beat) noexcept;
  bool find_successor();

  haptics::ServoLoop& loop_;
  core::FileDescriptor lifeline_;
  const core::FileDescriptor& signals_;
  int watchdog_;
  ReleaseLink& link_;
  Linger linger_;
  int missed_beats_ = 0;  // number of successive waits without a beat
  core::FileDescriptor done_;
  std::thread thread_;  // last member, because the thread uses all the others
};

}  // namespace afm::servo
