// SPDX-License-Identifier: Apache-2.0
// Invariant: a servo survives its renderer and serves the next one without reopening its device
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include "core/clock.h"
#include "servo/servo_client.h"
#include "servo/servo_handover.h"
#include "support/paper_model.h"
#include "support/places.h"
#include "support/scratch_folder.h"

// A renderer is killed, and another one comes. Real processes: what must happen is waited for, how long it takes
// decides nothing.
namespace afm::servo {
namespace servo_takeover_test {

const std::string kProgram = support::built("bin/touchafm");
const std::string kServoProgram = support::built("bin/touchafm-servo");
constexpr std::uint64_t kScene = 42;
constexpr double kHeldHeightM = 0.073;
constexpr double kLong_s = 100.0;

bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

auto start(double linger_s, std::uint64_t digest = kScene) {
  return ServoClient::start(test::paper_model(), digest, {.settings = {.linger_s = linger_s}}, kProgram);
}

// Options of another renderer that differ from those of Predecessor(kLong_s)'s servo.
struct OtherWish {
  const char* name;
  void (*change)(ServoChoice&, scene::SharedModel&);
};

bool until(ServoClient& link, const std::function<bool(const scene::TipState&)>& condition) {
  return eventually([&] { return link.poll(core::MonotonicClock().now_ns()) && condition(link.tip()); });
}

bool no_thread_runs(pid_t process) {
  std::error_code gone;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task", gone)) {
    std::ifstream file(thread.path() / "stat");
    const std::string stat{std::istreambuf_iterator<char>(file), {}};
    const std::size_t state = stat.rfind(") ");  // after the name
    if (state != std::string::npos && std::string("TtZX").find(stat[state + 2]) == std::string::npos) return false;
  }
  return true;
}

// A renderer in a separate process: it has chosen gold, edited mica, holds the hand at a place where no servo starts,
// and sends heartbeats until it is killed. Its servo then becomes a child of this process.
class Predecessor {
 public:
  explicit Predecessor(double linger_s, std::uint64_t digest = kScene) {
    EXPECT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1UL, 0UL, 0UL, 0UL), 0);
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    const core::FileDescriptor ready(ends[0]);
    core::FileDescriptor told(ends[1]);
    pid_ = ::fork();
    if (pid_ == 0) draw(linger_s, digest, told.get());
    told.close();
    EXPECT_EQ(::read(ready.get(), &servo_, sizeof(servo_)), static_cast<ssize_t>(sizeof(servo_)));
  }
  Predecessor(const Predecessor&) = delete;
  Predecessor& operator=(const Predecessor&) = delete;

  ~Predecessor() {
    kill();
    if (servo_ > 0) ::kill(servo_, SIGTERM);
    if (servo_ > 0) ::kill(servo_, SIGCONT);
    if (servo_ > 0) ::waitpid(servo_, nullptr, 0);
  }

  // Exit code of the servo, once it has ended.
  std::optional<int> servo_exit_code() {
    int status = -1;
    if (servo_ < 0 || ::waitpid(servo_, &status, WNOHANG) != servo_) return std::nullopt;
    servo_ = -1;
    return WEXITSTATUS(status);
  }

  // A signal reaches a process's threads one after the other.
  void stop_servo() const {
    ::kill(servo_, SIGSTOP);
    EXPECT_TRUE(eventually([this] { return no_thread_runs(servo_); }));
  }
  void kill_servo() {
    ::kill(servo_, SIGKILL);
    ::waitpid(servo_, nullptr, 0);
    servo_ = -1;
  }

  void kill() {
    if (pid_ < 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }

 private:
  [[noreturn]] static void draw(double linger_s, std::uint64_t digest, int told) {
    auto link = start(linger_s, digest);
    if (!link) ::_exit(1);
    (*link)->choose(test::kGold);
    (*link)->change(test::kMica, test::paper_model().materials[test::kGold]);
    (*link)->script({.target_m = {0.0, kHeldHeightM, 0.0}, .duration_s = 0.05, .revision = 7});
    const bool held = until(**link, [](const scene::TipState& tip) {
      return tip.material == test::kGold && tip.acknowledged.hand_script == 7 && tip.tick > 100 &&
             std::abs(tip.hand.position_m[1] - kHeldHeightM) < 0.002;
    });
    pid_t servo = -1;
    std::ifstream("/proc/self/task/" + std::to_string(::getpid()) + "/children") >> servo;
    if (!held || ::write(told, &servo, sizeof(servo)) != static_cast<ssize_t>(sizeof(servo))) ::_exit(1);
    until(**link, [](const scene::TipState&) { return false; });
    ::_exit(1);
  }

  pid_t pid_ = -1;
  pid_t servo_ = -1;
};

// The servos of one test do not meet those of another.
class ServoTakeover : public testing::Test {
 protected:
  ServoTakeover() { ::setenv("XDG_RUNTIME_DIR", runtime.path().c_str(), 1); }

  support::ScratchFolder runtime;
};

TEST_F(ServoTakeover, GoesOnWithTheServoOfADeadRenderer) {
  Predecessor predecessor(kLong_s);
  predecessor.kill();
  core::Result<std::unique_ptr<ServoClient>> link = start(kLong_s);
  // the servo needs a moment to notice; before that a successor starts its own
  EXPECT_TRUE(eventually([&] {
    if (link && (*link)->tip().tick > 0) return true;
    link = start(kLong_s);
    return false;
  }));
  // as the predecessor left it, but for what the hand swings: it was not put back to its 60 mm, the material and the
  // count of ticks go on
  EXPECT_GT((*link)->tip().tick, 100U);
  EXPECT_NEAR((*link)->tip().hand.position_m[1], kHeldHeightM, 0.005);
  EXPECT_EQ((*link)->tip().material, test::kGold);
  EXPECT_EQ((*link)->tip().servo_state, scene::ServoState::Disarmed);

  // the successor receives messages: scripts and choices count from one, as with any renderer
  (*link)->choose(test::kSiliconNitride);
  (*link)->script({.target_m = {0.0, 0.066, 0.0}, .duration_s = 0.05, .revision = 1});
  EXPECT_TRUE(until(**link, [](const scene::TipState& tip) {
    return tip.material == test::kSiliconNitride && tip.acknowledged.hand_script == 1 &&
           std::abs(tip.hand.position_m[1] - 0.066) < 0.002;
  }));
  // the predecessor's change is undone: mica pulls off where mica should
  (*link)->choose(test::kMica);
  EXPECT_TRUE(until(**link, [](const scene::TipState& tip) { return tip.material == test::kMica; }));
  const double z_joc_m = 0.050 / (*link)->tip().active.scale.hand_m_per_m;
  EXPECT_NEAR(z_joc_m, 14.0e-9, 0.1e-9);
}

TEST_F(ServoTakeover, AsksAServoOfAnotherSceneToLeaveAndStartsANewOne) {
  Predecessor predecessor(kLong_s);
  predecessor.kill();
  core::Result<std::unique_ptr<ServoClient>> link = start(kLong_s, kScene + 1);
  EXPECT_TRUE(eventually([&] {
    if (const auto code = predecessor.servo_exit_code()) return code == 1;
    link = start(kLong_s, kScene + 1);
    return false;
  }));
  ASSERT_TRUE(link);
  EXPECT_TRUE(until(**link, [](const scene::TipState& tip) { return tip.tick > 20 && tip.material < 0; }));
}

class ServoTakeoverOfAnother : public ServoTakeover, public testing::WithParamInterface<OtherWish> {};

// A servo with different options never holds a hand, not even one without a dead-man switch.
TEST_P(ServoTakeoverOfAnother, AsksItToLeaveAndStartsANewOne) {
  Predecessor predecessor(kLong_s);
  predecessor.kill();
  ServoChoice choice{.settings = {.linger_s = kLong_s}};
  const auto model = std::make_unique<scene::SharedModel>(test::paper_model());
  GetParam().change(choice, *model);
  core::Result<std::unique_ptr<ServoClient>> link;
  EXPECT_TRUE(eventually([&] {
    if (const auto code = predecessor.servo_exit_code()) return code == 1;
    link = ServoClient::start(*model, kScene, choice, kProgram);
    return false;
  }));
  ASSERT_TRUE(link);
  EXPECT_TRUE(until(**link, [](const scene::TipState& tip) { return tip.tick > 20; }));
  EXPECT_LT((*link)->tip().material, 0) << "gold was the predecessor's";
  EXPECT_EQ((*link)->tip().dead_man != 0, choice.settings.dead_man);
}

INSTANTIATE_TEST_SUITE_P(
    Wish, ServoTakeoverOfAnother,
    testing::Values(OtherWish{"Rate", [](auto& choice, auto&) { choice.settings.rate_hz = 2000.0; }},
                    OtherWish{"DeadMan", [](auto& choice, auto&) { choice.settings.dead_man = true; }},
                    OtherWish{"LargestForce", [](auto& choice, auto&) { choice.settings.max_force_n = 1.0; }},
                    OtherWish{"TimeAwake", [](auto& choice, auto&) { choice.settings.spin_ns = 1000; }},
                    OtherWish{"NoLingering", [](auto& choice, auto&) { choice.settings.linger_s = 0.0; }},
                    OtherWish{"Hamaker",
                              [](auto&, auto& model) {
                                model.materials[test::kMica].contact.hamaker = physics::Energy(2e-19);
                              }},
                    OtherWish{"Surface", [](auto&, auto& model) { model.height_fields.back().spacing_m = 1e-6; }}),
    [](const auto& test) { return test.param.name; });

// Two walls on one machine: each renderer finds its own servo, independent of the order in the folder.
TEST_F(ServoTakeover, LeavesTheServoOfAnotherWallToItsOwnRenderer) {
  Predecessor one(kLong_s, kScene), other(kLong_s, kScene + 1);
  one.kill();
  other.kill();
  ASSERT_TRUE(eventually([&] { return find_waiting_servos(kServoProgram, kScene, {}).size() == 2; }));
  const auto second = start(kLong_s, kScene + 1);
  const auto first = start(kLong_s, kScene);
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(
      eventually([&] { return (*first)->poll(core::MonotonicClock().now_ns()) && (*first)->tip().tick > 100; }));
  EXPECT_EQ((*first)->tip().material, test::kGold) << "a servo of its own would have none";
  EXPECT_TRUE(
      eventually([&] { return (*second)->poll(core::MonotonicClock().now_ns()) && (*second)->tip().tick > 100; }));
  EXPECT_EQ((*second)->tip().material, test::kGold);
}

TEST_F(ServoTakeover, PassesOverWhatKilledServosLeft) {
  Predecessor predecessor(kLong_s);
  predecessor.kill();
  ASSERT_TRUE(eventually([&] { return find_waiting_servos(kServoProgram, kScene, {}).size() == 1; }));
  predecessor.kill_servo();
  EXPECT_TRUE(start(kLong_s));
  EXPECT_TRUE(find_waiting_servos(kServoProgram, kScene, {}).empty());
}

// Only the user has access: a full queue or another user's socket is out of reach.
TEST_F(ServoTakeover, MeetsInAFolderOfItsUserAlone) {
  Predecessor predecessor(kLong_s);
  predecessor.kill();
  ASSERT_TRUE(eventually([&] { return find_waiting_servos(kServoProgram, kScene, {}).size() == 1; }));
  const auto folder = find_waiting_servos(kServoProgram, kScene, {}).front().parent_path();
  EXPECT_EQ(folder.parent_path(), std::filesystem::path(runtime.path()));
  using std::filesystem::perms;
  EXPECT_EQ(std::filesystem::status(folder).permissions() & perms::mask, perms::owner_all);
  std::filesystem::permissions(folder, perms::owner_all | perms::others_read | perms::others_exec);
  EXPECT_TRUE(find_waiting_servos(kServoProgram, kScene, {}).empty());
}

// A socket that accepts and never answers, or whose queue is full, delays nobody.
TEST_F(ServoTakeover, IsNotHeldUpByOneWhoDoesNotAnswer) {
  Predecessor predecessor(kLong_s);
  predecessor.kill();
  ASSERT_TRUE(eventually([&] { return find_waiting_servos(kServoProgram, kScene, {}).size() == 1; }));
  const auto socket = find_waiting_servos(kServoProgram, kScene, {}).front();
  predecessor.stop_servo();
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 8; ++i) EXPECT_FALSE(visit_servo(socket));
  // one second for each connection that the queue accepts
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(12));
}

TEST_F(ServoTakeover, IsNotWaitedForByAServoThatWasNotAskedTo) {
  Predecessor predecessor(0.0);
  predecessor.kill();
  EXPECT_TRUE(eventually([&] { return predecessor.servo_exit_code() == 1; }));
}

TEST_F(ServoTakeover, IsWaitedForAsLongAsRequested) {
  Predecessor predecessor(0.3);
  const auto killed = std::chrono::steady_clock::now();
  predecessor.kill();
  EXPECT_TRUE(eventually([&] { return predecessor.servo_exit_code() == 1; }));
  EXPECT_GE(std::chrono::steady_clock::now() - killed, std::chrono::milliseconds(250));
}

}  // namespace servo_takeover_test
}  // namespace afm::servo
