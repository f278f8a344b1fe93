// SPDX-License-Identifier: Apache-2.0
#include "servo/watchdog.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "haptics/devices/haply_service.h"
#include "live_renderer.h"
#include "servo/servo_client.h"

// What takes the force off the hand when the servo cannot: on a stand-in for Haply's service, which holds the last
// force that it was sent. Real processes and real time; a bound that protects the hand counts twice.
namespace afm::servo {
namespace {

using namespace test;
using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr auto kReleaseBound = milliseconds(2 * (kWatchdogReleaseMs + 20));
constexpr auto kKillBound = milliseconds(2 * kWatchdogKillMs);
constexpr auto kSilenceBound = milliseconds(2 * 250);

// What the processes that begin within its life write to stderr.
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

  // The hand moves at 0.1 m/s, slower than any limit.
  void move_to(double up_m) {
    constexpr double kStepM = 0.1 * 0.002;
    for (double here_m = service.up_m; here_m != up_m; service.up_m = here_m) {
      here_m = here_m < up_m ? std::min(here_m + kStepM, up_m) : std::max(here_m - kStepM, up_m);
      renderer.beat();
      wait_a_little();
    }
  }
  void rest(milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    renderer.until([&](const scene::TipState&) { return std::chrono::steady_clock::now() > end; });
  }

  // The paper's procedure, until the pull of the sample is on the hand.
  bool hold_attached() {
    side.store(scene::Selection{.material = kMica, .revision = 1});
    return eventually([&] {
      if (!servo->alive()) start_servo();  // the machine was stopped for longer than the watchdog waits
      move_to(0.19);
      rest(milliseconds(300));
      for (const bool pressed : {true, false}) {
        service.button = pressed;
        rest(milliseconds(300));
      }
      rest(milliseconds(700));
      move_to(0.105);
      move_to(0.14);
      return held_n() > 0.3 && renderer.holds();
    });
  }

  // What the service holds: the newest force that it was sent.
  double held_n() {
    const auto forces = service.forces();
    if (forces.empty()) return 0.0;
    const auto& [x, y, z] = forces.back();
    return std::hypot(x, y, z);
  }

  // How long the hand is pulled on.
  std::chrono::duration<double, std::milli> until_released() {
    const auto begin = std::chrono::steady_clock::now();
    eventually([&] { return held_n() == 0.0; });
    return std::chrono::steady_clock::now() - begin;
  }

  void start_servo() {
    servo = std::move(*ServoProcess::spawn(kServoProgram, segment, side, {.rate_hz = kRateHz}, "haply"));
  }
  void start() {
    start_servo();
    ASSERT_TRUE(hold_attached()) << held_n() << " N";
    watchdog = child_of(servo->pid());
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
  pid_t watchdog = -1;
};

TEST_F(ServoWatchdog, TellsTheDeviceToLetGoAndEndsAServoThatIsStopped) {
  ASSERT_NO_FATAL_FAILURE(start());
  ::kill(servo->pid(), SIGSTOP);
  const auto begin = std::chrono::steady_clock::now();
  const auto released = until_released();
  ASSERT_TRUE(eventually([&] { return !servo->alive(); }));
  const std::chrono::duration<double, std::milli> ended = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(released, kReleaseBound);
  EXPECT_LT(ended, kKillBound);
  EXPECT_EQ(servo->exit_status(), 128 + SIGKILL);
  EXPECT_TRUE(watchdog_gone());
  EXPECT_EQ(held_n(), 0.0);
  EXPECT_THAT(errors.text(), HasSubstr("watchdog: the servo stopped responding"));
  std::printf("stopped: zero after %.1f ms, ended after %.1f ms\n", released.count(), ended.count());
}

TEST_F(ServoWatchdog, TellsTheDeviceToLetGoWhenTheServoIsKilled) {
  ASSERT_NO_FATAL_FAILURE(start());
  ::kill(servo->pid(), SIGKILL);
  const auto released = until_released();
  EXPECT_LT(released, kReleaseBound);
  EXPECT_TRUE(watchdog_gone());
  EXPECT_EQ(held_n(), 0.0);
  EXPECT_THAT(errors.text(), HasSubstr("watchdog: the servo was killed"));
  std::printf("killed: zero after %.1f ms\n", released.count());
}

TEST_F(ServoWatchdog, IsMissedByItsServo) {
  ASSERT_NO_FATAL_FAILURE(start());
  ::kill(watchdog, SIGKILL);
  const auto released = until_released();
  EXPECT_LT(released, milliseconds(200));
  EXPECT_TRUE(eventually([&] { return !servo->alive(); }));
  EXPECT_THAT(errors.text(), HasSubstr("the servo's watchdog ended: force released"));
}

TEST_F(ServoWatchdog, LeavesWithItsServoAndSaysNothing) {
  ASSERT_NO_FATAL_FAILURE(start());
  servo.reset();
  EXPECT_EQ(held_n(), 0.0);
  EXPECT_NE(::kill(watchdog, 0), 0);
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
  ::kill(watchdog, SIGSTOP);
  ::kill(servo, SIGSTOP);
  const std::int64_t stopped_ns = now_ns();
  EXPECT_TRUE(polled_until([](const scene::TipState& tip) { return tip.fault == scene::FaultCode::ServoSilent; }));
  const std::int64_t silent_ns = now_ns() - stopped_ns;
  EXPECT_EQ(client.tip().servo_state, scene::ServoState::Fault);
  EXPECT_LT(silent_ns, std::chrono::nanoseconds(kSilenceBound).count());
  std::printf("seen after %.1f ms\n", 1e-6 * static_cast<double>(silent_ns));
  ::kill(servo, SIGCONT);
  ::kill(watchdog, SIGCONT);
  EXPECT_TRUE(polled_until([](const scene::TipState& tip) { return tip.fault != scene::FaultCode::ServoSilent; }));
}

}  // namespace
}  // namespace afm::servo
