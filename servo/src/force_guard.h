// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/file_descriptor.h"
#include "descriptor_letter.h"
#include "haptics/release_path.h"
#include "scene/shared/shared_segment.h"

// Removal of the force from the hand when the servo cannot do it, because it is stopped, killed, or stuck in a driver.
// Two guards watch a servo: its watchdog, a process, and a thread of its renderer with longer times.
namespace afm::servo {

// Letters from the servo to a guard, and the beat that the watchdog returns.
namespace guard_letter {
inline constexpr char kPath = 'P';  // prefix of the bytes of zero force, sent with the device's descriptor
inline constexpr std::string_view kEnd = "E";
inline constexpr std::string_view kBeat = "B";
}  // namespace guard_letter

// Times counted in a guard's own wake-ups, so that a pause of the whole machine does not count. All in ms.
struct GuardTimes {
  int wake;
  int release;  // time since the servo's last tick: zero force is sent; the servo may continue afterwards
  int kill;     // time since the servo's last tick: SIGKILL, so that the kernel closes the device
  int close;    // time since the announcement of the servo's end: SIGKILL
};

class ForceGuard {
 public:
  // `servo` is a socket to the servo, `process` its pidfd; `segment` holds its state. All outlive this object.
  ForceGuard(int servo, int process, scene::SharedSegment& segment, const GuardTimes& times)
      : servo_(servo), process_(process), state_(segment.renderer_side()), times_(times) {}

  // The servo's end, and what it took: nothing; zero force after a death without notice; a kill of a servo that does
  // not tick; a kill of one that does not close its device. Dismissed: `dismissal` became readable.
  enum class End { InOrder, Killed, Stuck, NotClosed, Dismissed };

  // Watches until the servo's end. Neither opens nor allocates anything. `beats`: sends kBeat every 10 ms.
  enum class Beats { No, Yes };
  End watch(Beats beats, int dismissal = -1);

 private:
  enum class Heard { Nothing, Message, Gone, Dismissed };

  Heard hear(int dismissal);
  bool ticked();
  void release() const;
  void take_over() const;

  int servo_;
  int process_;
  scene::RendererSide state_;
  GuardTimes times_;
  core::FileDescriptor device_;
  std::array<char, kMostLetterBytes> zero_{};
  std::size_t zero_size_ = 0;
  Letter letter_;
  std::uint64_t tick_ = 0;
  int silent_wakes_ = 0;
  bool ticking_ = false;  // true: the first tick has been seen
  bool ending_ = false;   // true: kEnd was received
};

}  // namespace afm::servo
