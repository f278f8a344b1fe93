// SPDX-License-Identifier: Apache-2.0
// Invariant: a servo tick's only system call is the sleep
#include <gtest/gtest.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <memory>

#include "core/clock.h"
#include "haptics/realtime.h"
#include "haptics/servo_loop.h"
#include "haptics/simulated_device.h"
#include "live_renderer.h"

// The servo under a filter of the kernel that kills it at once for any system call but the two that it may make: sleep,
// and the clock where the kernel does not map it. A tick that logged, took a lock that somebody holds, asked for memory
// or read a file would not survive.
namespace servo_syscall_test {

using namespace afm::scene;
using namespace afm::test;
using afm::haptics::ServoLoop;

constexpr sock_filter load(std::size_t offset) {
  return {BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<std::uint32_t>(offset)};
}
constexpr sock_filter allow() { return {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW}; }
constexpr sock_filter skip_unless(std::uint32_t number) { return {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, number}; }

bool allow_only_sleep_clock_and_exit() {
  std::array<sock_filter, 8> program{load(offsetof(seccomp_data, nr)),
                                     skip_unless(SYS_clock_nanosleep),
                                     allow(),
                                     skip_unless(SYS_clock_gettime),
                                     allow(),
                                     skip_unless(SYS_exit),
                                     allow(),
                                     {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_KILL_PROCESS}};
  const sock_fprog filter{.len = program.size(), .filter = program.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter, 0, 0) == 0;
}

// Reports of the servo's process, in memory shared with the test.
struct Told {
  rusage before{};
  std::uint64_t ticks = 0;
};

// Runs a servo in a child process until `side` says goodbye; returns how it ended.
class FilteredServo {
 public:
  FilteredServo(SharedSegment& segment, void (*within_the_filter)()) {
    void* memory = ::mmap(nullptr, sizeof(Told), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    told_ = new (memory) Told;
    pid_ = ::fork();
    if (pid_ != 0) return;

    afm::haptics::SimulatedDevice device;
    auto loop = afm::haptics::ServoLoop::create(segment, device, {.rate_hz = kRateHz});
    if (!loop) ::_exit(2);
    afm::haptics::enter_realtime(afm::haptics::kServoPriority, afm::haptics::PageLock::Lock);
    const afm::core::MonotonicClock clock;
    ::getrusage(RUSAGE_SELF, &told_->before);
    if (!allow_only_sleep_clock_and_exit()) ::_exit(3);
    if (within_the_filter != nullptr) within_the_filter();
    (*loop)->run(clock);
    told_->ticks = (*loop)->timing().ticks;
    ::syscall(SYS_exit, 0);
  }
  FilteredServo(const FilteredServo&) = delete;
  FilteredServo& operator=(const FilteredServo&) = delete;
  ~FilteredServo() { ::munmap(told_, sizeof(Told)); }

  // Waits for the process to end and returns its status as from waitpid().
  int end() {
    int status = -1;
    ::wait4(pid_, &status, 0, &after_);
    return status;
  }

  const Told& told() const { return *told_; }
  const rusage& after() const { return after_; }

 private:
  Told* told_;
  rusage after_{};
  pid_t pid_ = -1;
};

TEST(ServoSystemCalls, AreToSleepAndNothingElseOverAWholeCycle) {
  SharedSegment segment = create_segment();
  RendererSide side = segment.renderer_side();
  FilteredServo servo(segment, nullptr);
  LiveRenderer renderer(side);
  EXPECT_TRUE(renderer.hold_attached());
  // off the sample again, and another material
  renderer.aim(0.072, 0.4);
  EXPECT_TRUE(renderer.played());
  side.store(Selection{.material = kGold, .revision = 2});
  EXPECT_TRUE(renderer.until([](const TipState& state) { return state.material == kGold; }));
  side.store(RendererHeartbeat{.time_ns = now_ns(), .leaving = 1});

  const int status = servo.end();
  ASSERT_TRUE(WIFEXITED(status)) << "killed by signal " << WTERMSIG(status) << " (" << SIGSYS
                                 << " is a forbidden system call)";
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_GT(servo.told().ticks, 1000U);
  EXPECT_EQ(servo.after().ru_majflt, servo.told().before.ru_majflt);
  // at most one voluntary switch per tick, to sleep
  const long gave_up = servo.after().ru_nvcsw - servo.told().before.ru_nvcsw;
  EXPECT_LE(gave_up, static_cast<long>(servo.told().ticks) + 1);
}

TEST(ServoSystemCalls, OfAnyOtherKindEndTheServoOfThisTest) {
  SharedSegment segment = create_segment();
  FilteredServo servo(segment, [] { ::getppid(); });
  const int status = servo.end();
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGSYS);
}

}  // namespace servo_syscall_test
