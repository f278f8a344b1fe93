// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <string>

#include "core/file_descriptor.h"
#include "haptics/release_path.h"

namespace afm::servo {

// Servo's end of its two guards: hands each the newest way to release the hand. Any thread; never waits for a guard.
class ReleaseLink {
 public:
  // Sockets to the watchdog, which outlives this object, and to the renderer, which is duplicated.
  ReleaseLink(int watchdog, int renderer);
  ReleaseLink(const ReleaseLink&) = delete;
  ReleaseLink& operator=(const ReleaseLink&) = delete;
  ~ReleaseLink() { expect_end(); }

  void offer(const haptics::ReleasePath& path) noexcept;

  // A new renderer takes the place of one that died: it also gets the newest path.
  void set_renderer(int socket) noexcept;

  // Announces that the servo no longer ticks, and closes its device within kWatchdogCloseMs.
  void expect_end() noexcept;

 private:
  void send_path(int socket) noexcept;

  std::mutex mutex_;  // guard of the members below
  int watchdog_;
  core::FileDescriptor renderer_;
  core::FileDescriptor device_;  // duplicate of the device's descriptor
  std::string letter_;
};

}  // namespace afm::servo
