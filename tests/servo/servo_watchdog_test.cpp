// SPDX-License-Identifier: Apache-2.0
// Invariant: a servo that is stopped, killed or stuck in its driver leaves no force on a reachable device
#include "servo/watchdog.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>

#include "haply_hand.h"
#include "haptics/devices/haply_service.h"
#include "live_renderer.h"
#include "servo/servo_client.h"
#include "support/stall_watch.h"

// The guard that releases the hand if the servo cannot, with a stand-in for Haply's service, which keeps the last
// force. Real processes and real time: each bound that protects the hand is doubled, and judged while the machine is
// awake.
namespace afm::servo {
namespace servo_watchdog_test {

using namespace test;
using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr auto kReleaseBound = milliseconds(2 * (kWatchdogReleaseMs + 20));
constexpr auto kKillBound = milliseconds(2 * kWatchdogKillMs);
constexpr auto kSilenceBound = milliseconds(2 * 250);

// Output on stderr of the processes that start during the object's lifetime.
class CapturedErrors {
 public:
  CapturedErrors() : file_(::memfd_create("stderr", MFD_CLOEXEC)), before_(::dup(STDERR_FILENO)) {
    ::dup2(file_.get(), STDERR_FILENO);
  }
  CapturedErrors(const CapturedErrors&) = delete;
  CapturedErrors& operator=(const CapturedErrors&) = delete;
  ~CapturedErrors() { ::dup2(before_.get(), STDERR_FILENO); }

  std::string text() const {
    std::string text(1 << 16, '\0');
    const ssize_t length = ::pread(file_.get(), text.data(), text.size(), 0);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, length)));
    return text;
  }

 private:
  core::FileDescriptor file_, before_;
};

// The only child of a process, or -1.
pid_t child_of(pid_t process) {
  std::ifstream children("/proc/" + std::to_string(process) + "/task/" + std::to_string(process) + "/children");
  pid_t child = -1;
  children >> child;
  return child;
}

class ServoWatchdog : public testing::Test {
 protected:
  ServoWatchdog() { ::setenv("TOUCHAFM_HAPLY_PORT", std::to_string(service.port()).c_str(), 1); }
  ~ServoWatchdog() override { ::unsetenv("TOUCHAFM_HAPLY_PORT"); }

  void rest(milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    renderer.until([&](const scene::TipState&) { return std::chrono::steady_clock::now() > end; });
  }

  // The paper's procedure, until the pull of the sample is on the hand.
  bool hold_attached() {
    side.store(scene::Selection{.material = kMica, .revision = 1});
    return eventually([&] {
      if (!servo->alive()) start_servo();  // the machine was stopped for longer than the watchdog waits
      return attach(service, side, [&] { renderer.beat(); });
    });
  }

  double held_n() const { return force_at(service); }

  // A window for expect_within: the force is on, `number` goes to `process`, and `condition` is waited for.
  support::Timed timed_signal(const pid_t& process, int number, const std::function<bool()>& condition) {
    start();
    if (HasFailure()) return {};
    return support::timed([&] {
      ::kill(process, number);
      eventually(condition);
    });
  }
  bool released() { return held_n() == 0.0; }
  bool says(std::string_view line) const { return errors.text().find(line) != std::string::npos; }
  bool servo_gone() { return !servo->alive(); }

  void start_servo() {
    servo = std::move(*ServoProcess::spawn(kServoProgram, segment, side, {.rate_hz = kRateHz}, "haply"));
  }
  void start() {
    start_servo();
    ASSERT_TRUE(hold_attached()) << held_n() << " N";
    servo_pid = servo->pid();
    watchdog = child_of(servo_pid);
    ASSERT_GT(watchdog, 0);
  }

  bool watchdog_gone() {
    return eventually([&] { return ::kill(watchdog, 0) != 0; });
  }

  HaplyService service;
  scene::SharedSegment segment = create_segment();
  scene::RendererSide side = segment.renderer_side();
  LiveRenderer renderer{side};
  CapturedErrors errors;
  std::unique_ptr<ServoProcess> servo;
  pid_t servo_pid = -1, watchdog = -1;
};

TEST_F(ServoWatchdog, MakesTheDeviceLetGoAndEndsAServoThatIsStopped) {
  support::expect_within(kReleaseBound, [&] { return timed_signal(servo_pid, SIGSTOP, [&] { return released(); }); });
  ASSERT_TRUE(eventually([&] { return servo_gone(); }));
  support::expect_within(kKillBound, [&] { return timed_signal(servo_pid, SIGSTOP, [&] { return servo_gone(); }); });
  EXPECT_EQ(servo->exit_status(), 128 + SIGKILL);
  EXPECT_TRUE(watchdog_gone());
  EXPECT_EQ(held_n(), 0.0);
  EXPECT_THAT(errors.text(), HasSubstr("watchdog: the servo stopped responding"));
}

TEST_F(ServoWatchdog, MakesTheDeviceLetGoWhenTheServoIsKilled) {
  support::expect_within(kReleaseBound, [&] { return timed_signal(servo_pid, SIGKILL, [&] { return released(); }); });
  EXPECT_TRUE(watchdog_gone());
  EXPECT_EQ(held_n(), 0.0);
  EXPECT_THAT(errors.text(), HasSubstr("watchdog: the servo was killed"));
}

TEST_F(ServoWatchdog, IsMissedByItsServo) {
  support::expect_within(milliseconds(200),
                         [&] { return timed_signal(watchdog, SIGKILL, [&] { return released(); }); });
  EXPECT_TRUE(eventually([&] { return servo_gone(); }));
  EXPECT_TRUE(eventually([&] { return says("the servo's watchdog ended or is stopped: force released"); }));
}

// The servo notices after 80 ms and fades in 90.
TEST_F(ServoWatchdog, IsMissedByItsServoWhenItIsStopped) {
  support::expect_within(milliseconds(200),
                         [&] { return timed_signal(watchdog, SIGSTOP, [&] { return released(); }); });
  EXPECT_TRUE(eventually([&] { return servo_gone(); }));
  EXPECT_TRUE(watchdog_gone());
}

// A blocked log, as after Ctrl-S in the terminal, or with a pager that waits.
TEST_F(ServoWatchdog, IsMissedInTimeWhileNobodyReadsTheLog) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK), 0);
  const core::FileDescriptor reader(ends[0]), writer(ends[1]);
  const std::string full(65536, 'x');
  while (::write(writer.get(), full.data(), full.size()) > 0) {
  }
  while (::write(writer.get(), full.data(), 1) > 0) {
  }
  ::fcntl(writer.get(), F_SETFL, 0);
  const core::FileDescriptor before(::dup(STDERR_FILENO));
  ::dup2(writer.get(), STDERR_FILENO);
  support::expect_within(milliseconds(200),
                         [&] { return timed_signal(watchdog, SIGKILL, [&] { return released(); }); });
  EXPECT_TRUE(eventually([&] { return servo_gone(); }));
  ::dup2(before.get(), STDERR_FILENO);
}

// Only a kill and a stop affect it.
TEST_F(ServoWatchdog, StaysWhateverSignalItGets) {
  ASSERT_NO_FATAL_FAILURE(start());
  for (const int number : {SIGHUP, SIGINT, SIGTERM, SIGQUIT, SIGALRM, SIGUSR1}) ::kill(watchdog, number);
  rest(milliseconds(200));
  EXPECT_EQ(::kill(watchdog, 0), 0);
  EXPECT_TRUE(servo->alive());
}

// A command that is meant for the servo by its name must leave the watchdog.
TEST_F(ServoWatchdog, HasANameAndAGroupThatDifferFromTheServos) {
  ASSERT_NO_FATAL_FAILURE(start());
  std::ifstream comm("/proc/" + std::to_string(watchdog) + "/comm");
  std::string name;
  comm >> name;
  EXPECT_EQ(name, "touchafm-guard");
  EXPECT_NE(::getpgid(watchdog), ::getpgid(servo_pid));
}

TEST_F(ServoWatchdog, LeavesWithItsServoAndSaysNothing) {
  ASSERT_NO_FATAL_FAILURE(start());
  servo.reset();
  EXPECT_EQ(held_n(), 0.0);
  EXPECT_TRUE(eventually([&] { return ::kill(watchdog, 0) != 0; }));
  EXPECT_THAT(errors.text(), Not(HasSubstr("watchdog")));
}

// A debugger that stops both.
TEST(SilentServo, IsSeenByTheRendererToo) {
  auto started = ServoClient::start(paper_model(), 0, {}, kServoProgram);
  ASSERT_TRUE(started) << started.error().message;
  ServoClient& client = **started;
  const auto polled_until = [&](const auto& condition) {
    return eventually([&] { return client.poll(now_ns()) && condition(client.tip()); });
  };
  ASSERT_TRUE(polled_until([](const scene::TipState& tip) { return tip.tick > 0; }));
  EXPECT_EQ(client.tip().fault, scene::FaultCode::None);
  const pid_t servo = child_of(::getpid());
  const pid_t watchdog = child_of(servo);
  ASSERT_GT(watchdog, 0);
  support::expect_within(kSilenceBound, [&] {
    const support::Timed seen = support::timed([&] {
      ::kill(watchdog, SIGSTOP);
      ::kill(servo, SIGSTOP);
      EXPECT_TRUE(polled_until([](const scene::TipState& tip) { return tip.fault == scene::FaultCode::ServoSilent; }));
    });
    EXPECT_EQ(client.tip().servo_state, scene::ServoState::Fault);
    ::kill(servo, SIGCONT);
    ::kill(watchdog, SIGCONT);
    EXPECT_TRUE(polled_until([](const scene::TipState& tip) { return tip.fault != scene::FaultCode::ServoSilent; }));
    return seen;
  });
}

}  // namespace servo_watchdog_test
}  // namespace afm::servo
