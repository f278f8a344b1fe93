// SPDX-License-Identifier: Apache-2.0
#include "servo/release_link.h"

#include <fcntl.h>

#include <array>

#include "descriptor_letter.h"
#include "force_guard.h"

namespace afm::servo {

namespace {

core::FileDescriptor duplicate(int descriptor) { return core::FileDescriptor(::fcntl(descriptor, F_DUPFD_CLOEXEC, 0)); }

}  // namespace

// A letter's memory is reserved, so that no offer allocates.
ReleaseLink::ReleaseLink(int watchdog, int renderer) : watchdog_(watchdog), renderer_(duplicate(renderer)) {
  letter_.reserve(kMostLetterBytes);
}

void ReleaseLink::offer(const haptics::ReleasePath& path) noexcept {
  if (path.descriptor < 0 || path.zero.size() >= kMostLetterBytes) return;
  const std::lock_guard lock(mutex_);
  letter_.assign(1, guard_letter::kPath);
  letter_ += path.zero;
  device_ = duplicate(path.descriptor);
  send_path(watchdog_);
  send_path(renderer_.get());
}

void ReleaseLink::set_renderer(int socket) noexcept {
  const std::lock_guard lock(mutex_);
  renderer_ = duplicate(socket);
  if (device_.is_open()) send_path(renderer_.get());
}

void ReleaseLink::expect_end() noexcept {
  const std::lock_guard lock(mutex_);
  for (const int guard : {watchdog_, renderer_.get()}) Letter().send(guard, guard_letter::kEnd);
}

void ReleaseLink::send_path(int socket) noexcept {
  const std::array descriptor{device_.get()};
  Letter().send(socket, letter_, descriptor);
}

}  // namespace afm::servo
