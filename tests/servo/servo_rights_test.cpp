// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gmock/gmock.h>
#include <linux/capability.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>
#include <string>

#include "live_renderer.h"

// The servo with different rights of the user. Each case is a child process, which drops root's privileges permanently,
// sets the limits of the case and then starts the servo.
namespace servo_rights_test {

using namespace afm::scene;
using namespace afm::test;
using afm::servo::ServoProcess;
using testing::AllOf;
using testing::HasSubstr;

constexpr rlim_t kWantedPriority = 80;

// Sets a limit and drops the capability that overrides it, so that root is treated like a user. Empty: both stay as
// they are on this machine.
void restrict_to(std::optional<rlim_t> value, __rlimit_resource what, unsigned long capability) {
  if (!value) return;
  const rlimit both{.rlim_cur = *value, .rlim_max = *value};
  if (::setrlimit(what, &both) != 0) ::_exit(2);
  // fails for a user, who does not have it anyway
  ::prctl(PR_CAPBSET_DROP, capability, 0, 0, 0);
}

rlim_t highest(__rlimit_resource what) {
  rlimit limit{};
  ::getrlimit(what, &limit);
  return limit.rlim_max;
}

struct Started {
  TipState state;
  ServoTiming timing;
  std::string said;
};

Started start_with(std::optional<rlim_t> priority, std::optional<rlim_t> locked_bytes) {
  const afm::core::FileDescriptor log(::memfd_create("stderr", MFD_CLOEXEC));
  SharedSegment segment = create_segment();
  RendererSide side = segment.renderer_side();
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(log.get(), STDERR_FILENO);
    restrict_to(priority, RLIMIT_RTPRIO, CAP_SYS_NICE);
    restrict_to(locked_bytes, RLIMIT_MEMLOCK, CAP_IPC_LOCK);
    auto servo = ServoProcess::spawn(kServoProgram, segment, side, {.rate_hz = kRateHz});
    LiveRenderer renderer(side);
    const bool ran = servo && renderer.until([](const TipState& state) { return state.tick > 20; });
    if (servo) servo->reset();
    ::_exit(ran ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  Started started{.state = side.tip_state().value_or(TipState{}),
                  .timing = side.servo_timing().value_or(ServoTiming{}),
                  .said = std::string(4096, '\0')};
  const ssize_t length = ::pread(log.get(), started.said.data(), started.said.size(), 0);
  started.said.resize(static_cast<std::size_t>(std::max<ssize_t>(0, length)));
  return started;
}

// Rights granted by this machine's two limits, without root.
TEST(ServoRights, FollowFromTheTwoLimitsAlone) {
  const rlim_t priority = highest(RLIMIT_RTPRIO);
  const rlim_t locked_bytes = highest(RLIMIT_MEMLOCK);
  const Started started = start_with(priority, locked_bytes);
  EXPECT_EQ(started.timing.policy_fifo, priority >= kWantedPriority ? 1U : 0U);
  if (locked_bytes == RLIM_INFINITY) {
    EXPECT_EQ(started.timing.pages_locked, 1U);
  }
  EXPECT_EQ(started.state.realtime, started.timing.policy_fifo * started.timing.pages_locked);
  EXPECT_EQ(started.said.empty(), started.state.realtime == 1U);
}

TEST(ServoRights, WithoutAPriorityLeaveItRunningAndSaidToBeSlow) {
  const Started started = start_with(0, std::nullopt);
  EXPECT_EQ(started.state.realtime, 0U);
  EXPECT_EQ(started.timing.policy_fifo, 0U);
  EXPECT_THAT(started.said, AllOf(HasSubstr("not real-time: SCHED_FIFO 80 was refused (Operation not permitted, the "
                                            "limit is 0)"),
                                  HasSubstr("echo \"$(id -un) - rtprio 80\" | sudo tee -a "
                                            "/etc/security/limits.d/touchafm.conf, then log in again")));
}

TEST(ServoRights, WithALockedMemoryLimitOfZeroNameIt) {
  const Started started = start_with(std::nullopt, 0);
  EXPECT_EQ(started.state.realtime, 0U);
  EXPECT_EQ(started.timing.pages_locked, 0U);
  EXPECT_THAT(started.said, AllOf(HasSubstr("not real-time: locking the pages was refused (Operation not permitted, "
                                            "the limit is 0 KiB)"),
                                  HasSubstr("echo \"$(id -un) - memlock unlimited\" | sudo tee -a "
                                            "/etc/security/limits.d/touchafm.conf, then log in again")));
}

TEST(ServoRights, WithALockedMemoryLimitThatIsTooSmallNameIt) {
  const Started started = start_with(std::nullopt, 64 * 1024);
  EXPECT_EQ(started.state.realtime, 0U);
  EXPECT_EQ(started.timing.pages_locked, 0U);
  EXPECT_THAT(started.said, HasSubstr("the limit is 64 KiB)"));
}

TEST(ServoRights, OfNobodyLeaveItRunningInEveryRespect) {
  const Started started = start_with(0, 0);
  EXPECT_EQ(started.state.realtime, 0U);
  EXPECT_EQ(started.timing.policy_fifo, 0U);
  EXPECT_EQ(started.timing.pages_locked, 0U);
  EXPECT_THAT(started.said, AllOf(HasSubstr("rtprio 80"), HasSubstr("memlock unlimited")));
}

}  // namespace servo_rights_test
