// SPDX-License-Identifier: Apache-2.0
#include "force_guard.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "core/file_descriptor.h"
#include "live_renderer.h"

namespace afm::servo {
namespace force_guard_test {

// A servo without a device may end with beats unread. The kernel then reports an error before its last letter.
TEST(ForceGuard, LeavesAServoAloneThatAnnouncedItsEndAndLeftBeatsUnread) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()), 0);
  const core::FileDescriptor guarding(ends[0]);
  core::FileDescriptor servo(ends[1]);
  const pid_t process = ::fork();
  if (process == 0) {
    for (const int end : ends) ::close(end);
    for (;;) ::pause();
  }
  const core::FileDescriptor handle(static_cast<int>(::syscall(SYS_pidfd_open, process, 0)));
  scene::SharedSegment segment = test::create_segment();
  ForceGuard guard(guarding.get(), handle.get(), segment, {.wake = 5, .release = 60, .kill = 1000, .close = 1500});

  ASSERT_EQ(::send(guarding.get(), guard_letter::kBeat.data(), guard_letter::kBeat.size(), 0), 1);
  ASSERT_EQ(::send(servo.get(), guard_letter::kEnd.data(), guard_letter::kEnd.size(), 0), 1);
  servo.close();
  EXPECT_EQ(guard.watch(ForceGuard::Beats::No), ForceGuard::End::InOrder);
  EXPECT_EQ(::waitpid(process, nullptr, WNOHANG), 0) << "it was killed while it ended";
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
}

}  // namespace force_guard_test
}  // namespace afm::servo
