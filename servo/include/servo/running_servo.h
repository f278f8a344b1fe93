// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace afm::servo {

// Running servo. Used by the thread that stores heartbeats; the segment and its RendererSide must outlive it.
//
// The destructor ends it in good order: it stores a heartbeat marked `leaving`, which fades out the force, and waits.
// The caller must not store any other heartbeat afterwards.
class Servo {
 public:
  Servo() = default;
  Servo(const Servo&) = delete;
  Servo& operator=(const Servo&) = delete;
  virtual ~Servo() = default;

  virtual bool alive() noexcept = 0;

  // Exit code once it has ended, or 128 plus the number of the signal that killed it, as in a shell.
  virtual std::optional<int> exit_status() noexcept = 0;
};

}  // namespace afm::servo
