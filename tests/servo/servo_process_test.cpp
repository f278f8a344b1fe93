// SPDX-License-Identifier: Apache-2.0
// Invariant: if either process dies: zero force, a message, exit code 1, and no orphan
// Invariant: touchafm-servo and touchafm-guard need neither Vulkan nor a window
#include "servo/servo_process.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "haptics/simulated_device.h"
#include "live_renderer.h"

// Real processes and real time. Durations are printed and decide nothing.
namespace servo_process_test {

using namespace afm::scene;
using namespace afm::test;
using afm::core::FileDescriptor;
using afm::servo::Servo;
using afm::servo::ServoProcess;
using afm::servo::ServoThread;
using testing::HasSubstr;

// A renderer in a separate process, which starts a servo, holds the tip on the sample and then draws until it is
// killed. The test shares the segment with both and inherits the servo when the renderer dies.
class RendererProcess {
 public:
  explicit RendererProcess(SharedSegment& segment) : log_(::memfd_create("stderr", MFD_CLOEXEC)) {
    EXPECT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1UL, 0UL, 0UL, 0UL), 0);
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    const FileDescriptor ready_read(ends[0]);
    FileDescriptor ready_write(ends[1]);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(log_.get(), STDERR_FILENO);
      draw(segment, ready_write.get());
    }
    // the renderer writes the servo's id once force is felt, or closes the pipe
    ready_write.close();
    EXPECT_EQ(::read(ready_read.get(), &servo_pid_, sizeof(servo_pid_)), static_cast<ssize_t>(sizeof(servo_pid_)));
  }
  RendererProcess(const RendererProcess&) = delete;
  RendererProcess& operator=(const RendererProcess&) = delete;
  ~RendererProcess() {
    signal(SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }

  void signal(int number) const { ::kill(pid_, number); }
  pid_t servo_pid() const { return servo_pid_; }

  // After the renderer's death the servo is ours to reap.
  int servo_exit_code() const {
    int status = -1;
    EXPECT_TRUE(eventually([&] { return ::waitpid(servo_pid_, &status, WNOHANG) == servo_pid_; }));
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  std::string log() const {
    std::string text(4096, '\0');
    const ssize_t length = ::pread(log_.get(), text.data(), text.size(), 0);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, length)));
    return text;
  }

 private:
  [[noreturn]] static void draw(SharedSegment& segment, int ready) {
    RendererSide side = segment.renderer_side();
    auto servo = ServoProcess::spawn(kServoProgram, segment, side, {.rate_hz = kRateHz});
    LiveRenderer renderer(side);
    if (!servo || !renderer.hold_attached()) ::_exit(1);
    const pid_t pid = (*servo)->pid();
    if (::write(ready, &pid, sizeof(pid)) != static_cast<ssize_t>(sizeof(pid))) ::_exit(1);
    for (;;) renderer.until([](const TipState&) { return false; });
  }

  FileDescriptor log_;
  pid_t pid_ = -1;
  pid_t servo_pid_ = -1;
};

// The time of the first sample at or after `since_ns` without force, or 0; takes samples out of the ring.
std::int64_t released_at(RendererSide& side, std::int64_t since_ns) {
  std::int64_t first_ns = 0;
  eventually([&] {
    while (const auto sample = side.pop_sample()) {
      if (first_ns == 0 && sample->time_ns >= since_ns && sample->hand_force_n == 0.0) first_ns = sample->time_ns;
    }
    return first_ns != 0;
  });
  return first_ns;
}

// A stall of the machine made the servo let go before the test could: try again.
bool let_go_before(const TipState& state) { return state.fault == FaultCode::LateTick; }

TEST(ServoProcess, ReleasesTheHandAndEndsWhenTheRendererIsKilled) {
  int rounds = 0;
  EXPECT_TRUE(eventually([&] {
    SharedSegment segment = create_segment();
    RendererProcess renderer(segment);
    RendererSide side = segment.renderer_side();

    const std::int64_t killed_ns = now_ns();
    renderer.signal(SIGKILL);
    const std::int64_t released_ns = released_at(side, killed_ns);
    EXPECT_NE(released_ns, 0);
    EXPECT_EQ(renderer.servo_exit_code(), 1);
    EXPECT_THAT(renderer.log(), HasSubstr("the renderer died: force released"));
    const TipState last = tip_state_of(side);
    EXPECT_EQ(last.hand.force_n, (std::array<double, 3>{}));
    if (let_go_before(last)) return false;
    EXPECT_EQ(last.fault, FaultCode::RendererDied);
    std::printf("force exactly zero %.1f ms after the kill\n", 1e-6 * static_cast<double>(released_ns - killed_ns));
    return ++rounds == 2;
  }));
}

// Without a stopped job of an orphaned group, which the kernel would continue: the test is of the renderer's session.
// The watchdog would kill a servo that stays stopped.
TEST(ServoProcess, GoesOnWhenItIsStoppedAndItsRendererDies) {
  SharedSegment segment = create_segment();
  const RendererProcess renderer(segment);
  ::kill(renderer.servo_pid(), SIGSTOP);
  renderer.signal(SIGKILL);
  EXPECT_EQ(renderer.servo_exit_code(), 1);
  EXPECT_THAT(renderer.log(), HasSubstr("the renderer died: force released"));
}

TEST(ServoProcess, FadesWhenTheRendererIsStoppedAndStaysDisarmedWhenItGoesOn) {
  EXPECT_TRUE(eventually([&] {
    SharedSegment segment = create_segment();
    RendererProcess renderer(segment);
    RendererSide side = segment.renderer_side();
    const std::int64_t stopped_ns = now_ns();
    renderer.signal(SIGSTOP);
    const std::int64_t released_ns = released_at(side, stopped_ns);
    EXPECT_NE(released_ns, 0);
    const TipState stopped = tip_state_of(side);

    renderer.signal(SIGCONT);
    wait_a_little();
    EXPECT_EQ(tip_state_of(side).servo_state, ServoState::Disarmed);
    EXPECT_EQ(tip_state_of(side).hand.force_n, (std::array<double, 3>{}));
    renderer.signal(SIGKILL);
    EXPECT_EQ(renderer.servo_exit_code(), 1);
    if (let_go_before(stopped)) return false;
    EXPECT_EQ(stopped.fault, FaultCode::RendererHung);
    std::printf("force exactly zero %.1f ms after the stop\n", 1e-6 * static_cast<double>(released_ns - stopped_ns));
    return true;
  }));
}

TEST(ServoProcess, IsSeenDeadWhenItIsKilledAndCanBeStartedAgain) {
  SharedSegment segment = create_segment();
  RendererSide side = segment.renderer_side();
  auto servo = ServoProcess::spawn(kServoProgram, segment, side, {.rate_hz = kRateHz});
  ASSERT_TRUE(servo) << servo.error().message;
  LiveRenderer renderer(side);
  ASSERT_TRUE(renderer.until([](const TipState& state) { return state.tick > 20; }));
  EXPECT_TRUE((*servo)->alive());

  const std::int64_t killed_ns = now_ns();
  ::kill((*servo)->pid(), SIGKILL);
  ASSERT_TRUE(eventually([&] { return !(*servo)->alive(); }));
  std::printf("seen dead %.1f ms after the kill\n", 1e-6 * static_cast<double>(now_ns() - killed_ns));
  EXPECT_EQ((*servo)->exit_status(), 128 + SIGKILL);

  const std::uint64_t last_tick = tip_state_of(side).tick;
  servo = ServoProcess::spawn(kServoProgram, segment, side, {.rate_hz = kRateHz});
  ASSERT_TRUE(servo) << servo.error().message;
  EXPECT_TRUE(renderer.until([&](const TipState& state) { return state.tick != last_tick && state.tick > 20; }));
}

TEST(ServoProcess, LeavesInGoodOrderAndNoZombieBehind) {
  EXPECT_TRUE(eventually([&] {
    SharedSegment segment = create_segment();
    RendererSide side = segment.renderer_side();
    auto servo = ServoProcess::spawn(kServoProgram, segment, side, {.rate_hz = kRateHz});
    EXPECT_TRUE(servo);
    EXPECT_TRUE(LiveRenderer(side).hold_attached());
    const pid_t pid = (*servo)->pid();
    servo->reset();
    EXPECT_NE(::kill(pid, 0), 0);
    const TipState last = tip_state_of(side);
    EXPECT_EQ(last.hand.force_n, (std::array<double, 3>{}));
    if (let_go_before(last)) return false;
    EXPECT_EQ(last.fault, FaultCode::None);
    return true;
  }));
}

// The renderer continues its heartbeats: the signal makes it let go, not a hang.
TEST(ServoProcess, EndsOnSigtermWithZeroAfterReleasingTheHand) {
  EXPECT_TRUE(eventually([&] {
    SharedSegment segment = create_segment();
    RendererSide side = segment.renderer_side();
    auto servo = ServoProcess::spawn(kServoProgram, segment, side, {.rate_hz = kRateHz});
    EXPECT_TRUE(servo);
    LiveRenderer renderer(side);
    EXPECT_TRUE(renderer.hold_attached());
    ::kill((*servo)->pid(), SIGTERM);
    EXPECT_TRUE(eventually([&] {
      renderer.beat();
      return !(*servo)->alive();
    }));
    EXPECT_EQ((*servo)->exit_status(), 0);
    const TipState last = tip_state_of(side);
    EXPECT_EQ(last.hand.force_n, (std::array<double, 3>{}));
    if (let_go_before(last)) return false;
    EXPECT_EQ(last.fault, FaultCode::None);
    return true;
  }));
}

TEST(ServoProcess, GivesForceOnlyWhileTurnOnIsHeldWhereRequested) {
  EXPECT_TRUE(eventually([&] {
    SharedSegment segment = create_segment();
    RendererSide side = segment.renderer_side();
    auto servo = ServoProcess::spawn(kServoProgram, segment, side, {.rate_hz = kRateHz, .dead_man = true});
    EXPECT_TRUE(servo);
    LiveRenderer renderer(side);
    EXPECT_TRUE(renderer.hold_attached(true));
    EXPECT_EQ(tip_state_of(side).dead_man, 1U);
    renderer.aim(0.025, 0.1);
    EXPECT_TRUE(renderer.until([](const TipState& state) {
      return state.servo_state == ServoState::Disarmed && state.hand.force_n == std::array<double, 3>{};
    }));
    const TipState released = tip_state_of(side);
    if (let_go_before(released)) return false;
    EXPECT_EQ(released.fault, FaultCode::DeadManReleased);
    return true;
  }));
}

TEST(ServoProcess, InheritsTheTwoDescriptorsAndNoOthers) {
  const FileDescriptor stray(::open("/dev/null", O_RDONLY));  // missing O_CLOEXEC, as in a careless library
  SharedSegment segment = create_segment();
  RendererSide side = segment.renderer_side();
  auto servo = ServoProcess::spawn(kServoProgram, segment, side, {.rate_hz = kRateHz});
  ASSERT_TRUE(servo);
  ASSERT_TRUE(LiveRenderer(side).until([](const TipState& state) { return state.tick > 20; }));
  std::vector<std::string> targets;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string((*servo)->pid()) + "/fd")) {
    if (std::stoi(entry.path().filename()) > STDERR_FILENO)
      targets.push_back(std::filesystem::read_symlink(entry.path()));
  }
  // and what it opened itself: its watchdog's socket, a second descriptor of its renderer's, its signals and its
  // monitor's wake-up
  EXPECT_THAT(targets,
              testing::UnorderedElementsAre(HasSubstr("memfd:touchafm"), HasSubstr("socket:"), HasSubstr("socket:"),
                                            HasSubstr("socket:"), HasSubstr("signalfd"), HasSubstr("eventfd")));
}

TEST(ServoProcess, SaysWhatIsMissingWhenItCannotBeStarted) {
  SharedSegment segment = create_segment();
  RendererSide side = segment.renderer_side();
  const auto servo = ServoProcess::spawn("/nowhere/touchafm-servo", segment, side, {.rate_hz = kRateHz});
  ASSERT_FALSE(servo);
  EXPECT_THAT(servo.error().message, HasSubstr("cannot start /nowhere/touchafm-servo: No such file"));
}

TEST(ServoThread, RunsTheSameLoopAndLeavesInGoodOrder) {
  SharedSegment segment = create_segment();
  RendererSide side = segment.renderer_side();
  auto servo =
      ServoThread::start(segment, side, {.rate_hz = kRateHz}, std::make_unique<afm::haptics::SimulatedDevice>());
  ASSERT_TRUE(servo);
  LiveRenderer renderer(side);
  ASSERT_TRUE(renderer.hold_attached());
  EXPECT_TRUE((*servo)->alive());
  EXPECT_EQ(tip_state_of(side).realtime, 0U);
  servo->reset();
  EXPECT_EQ(tip_state_of(side).hand.force_n, (std::array<double, 3>{}));
}

std::uint32_t percentile(const std::array<std::uint32_t, kHistogramBins>& bins, double share) {
  std::uint64_t total = 0;
  for (const std::uint32_t count : bins) total += count;
  std::uint64_t below = 0;
  for (std::uint32_t us = 0; us < kHistogramBins; ++us) {
    below += bins[us];
    if (static_cast<double>(below) >= share * static_cast<double>(total)) return us;
  }
  return kHistogramBins - 1;
}

TEST(ServoProcess, CountsEveryTickInItsHistograms) {
  SharedSegment segment = create_segment();
  RendererSide side = segment.renderer_side();
  auto servo = ServoProcess::spawn(kServoProgram, segment, side, {.rate_hz = kRateHz});
  ASSERT_TRUE(servo);
  LiveRenderer renderer(side);
  ASSERT_TRUE(renderer.hold_attached());
  ASSERT_TRUE(renderer.until([](const TipState& state) { return state.tick > 2500; }));
  const std::uint64_t ticks_before = tip_state_of(side).tick;
  servo->reset();
  const ServoTiming timing = *side.servo_timing();
  EXPECT_EQ(timing.rate_hz, kRateHz);
  EXPECT_GE(timing.ticks, ticks_before);
  std::uint64_t woken = 0;
  std::uint64_t worked = 0;
  for (const std::uint32_t count : timing.wake_us) woken += count;
  for (const std::uint32_t count : timing.work_us) worked += count;
  EXPECT_EQ(woken, timing.ticks);
  EXPECT_EQ(worked, timing.ticks);
  std::printf("SCHED_FIFO %u, pages locked %u, %lu ticks, %lu missed\n", timing.priority, timing.pages_locked,
              static_cast<unsigned long>(timing.ticks), static_cast<unsigned long>(timing.missed));
  for (const auto& [name, bins, largest] : {std::tuple("wake", &timing.wake_us, timing.wake_max_us),
                                            std::tuple("work", &timing.work_us, timing.work_max_us)}) {
    std::printf("%s us: p50 %u, p99 %u, p99.9 %u, max %u\n", name, percentile(*bins, 0.5), percentile(*bins, 0.99),
                percentile(*bins, 0.999), largest);
  }
}

// Runs a program to its end and returns its exit code and its output.
std::pair<int, std::string> run(std::vector<std::string> arguments) {
  std::string command;
  for (const std::string& argument : arguments) command += "'" + argument + "' ";
  FILE* pipe = ::popen((command + "2>&1").c_str(), "r");
  std::string said;
  std::array<char, 4096> buffer{};
  while (const std::size_t length = std::fread(buffer.data(), 1, buffer.size(), pipe))
    said.append(buffer.data(), length);
  return {WEXITSTATUS(::pclose(pipe)), said};
}

TEST(ServoProgram, SaysThatTouchafmStartsIt) {
  for (const auto& arguments : std::vector<std::vector<std::string>>{{kServoProgram},
                                                                     {kServoProgram, "--segment", "3"},
                                                                     {kServoProgram, "--segment"},
                                                                     {kServoProgram, "--colour", "9"}}) {
    const auto [code, said] = run(arguments);
    EXPECT_EQ(code, 2);
    EXPECT_THAT(said, HasSubstr("touchafm starts this program"));
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
  }
}

TEST(ServoProgram, RefusesADescriptorThatIsNoSegment) {
  const auto [code, said] = run({kServoProgram, "--segment", "0", "--parent-socket", "0"});
  EXPECT_EQ(code, 1);
  EXPECT_THAT(said, HasSubstr("shared segment"));
}

// A touchafm of another build, older or newer than the servo beside it.
TEST(ServoProgram, RefusesASegmentOfAnotherVersionAndPrintsBoth) {
  constexpr off_t kVersionOffset = 8;
  for (const std::uint32_t other : {kSegmentVersion - 1, kSegmentVersion + 1}) {
    const SharedSegment segment = create_segment();
    ASSERT_EQ(::pwrite(segment.descriptor(), &other, sizeof(other), kVersionOffset),
              static_cast<ssize_t>(sizeof(other)));
    const FileDescriptor inherited(::dup(segment.descriptor()));
    const std::string number = std::to_string(inherited.get());
    const auto [code, said] = run({kServoProgram, "--segment", number, "--parent-socket", "0"});
    EXPECT_EQ(code, 1);
    EXPECT_THAT(said, HasSubstr("segment of version " + std::to_string(other) + ": this program uses version " +
                                std::to_string(kSegmentVersion) + ";"));
  }
}

TEST(ServoProgram, NeedsNeitherVulkanNorAWindow) {
  for (const std::string& program : {kServoProgram, afm::support::built("bin/touchafm-guard")}) {
    const auto [code, said] = run({"readelf", "--dynamic", program});
    ASSERT_EQ(code, 0) << said;
    EXPECT_THAT(said, HasSubstr("libc.so"));
    for (const char* library : {"libvulkan", "libglfw", "libX11", "libwayland", "libpng"}) {
      EXPECT_THAT(said, testing::Not(HasSubstr(library)));
    }
  }
}

}  // namespace servo_process_test
