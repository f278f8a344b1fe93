// SPDX-License-Identifier: Apache-2.0
// What goes wrong with the machines of a wall, on one machine: processes and threads that stop, other builds, noise.
#include <gmock/gmock.h>
#include <sys/ptrace.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "app/cluster/cluster_noise.h"
#include "app/cluster/cluster_wall.h"
#include "cluster/master_link.h"
#include "core/clock.h"
#include "core/percentiles.h"
#include "core/whole_file.h"
#include "exhibit/cluster/wall_model.h"
#include "servo/session_file.h"
#include "support/places.h"

namespace afm::app {
namespace cluster_failures_test {

using std::chrono::seconds;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::string_view kMode = "anaglyph-red-cyan";  // mode of wall_of_three()
constexpr seconds kFelt{2};                              // time before and after the failure

class ClusterFailures : public ClusterWall {
 protected:
  std::unique_ptr<support::LiveProgram> node(const std::string& name) const {
    return start(node_command(name, "127.0.0.1"));
  }
  // Wall with a force on the hand.
  std::unique_ptr<support::LiveProgram> felt_wall(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command = master_command();
    command.insert(command.end(), {"--haptics", "sim"});
    command.insert(command.end(), more.begin(), more.end());
    auto hand = start(command);
    expect_both_shown(*hand);
    press_at_master("1");
    EXPECT_TRUE(hand->says("force on")) << hand->said();
    return hand;
  }
  // A renderer that is silent for 250 ms would have ended the force.
  static void expect_force_never_ended(support::LiveProgram& hand) {
    EXPECT_THAT(hand.said(), Not(HasSubstr("the renderer gave no frame")));
  }
  void expect_orderly_end(support::LiveProgram& hand) const {
    press_at_master("Escape");
    EXPECT_EQ(hand.ends(), 0) << hand.said();
    EXPECT_THAT(hand.said(), Not(HasSubstr("built frame")));
  }
};

TEST_F(ClusterFailures, ANodeThatStopsForFiveSecondsAndOneThatIsKilledAreLeftOutAndReturn) {
  const auto left = node("left");
  auto right = node("right");
  const auto hand = felt_wall();
  left->signal(SIGSTOP);
  ASSERT_TRUE(hand->says("node left is missing")) << hand->said();
  right->signal(SIGKILL);
  EXPECT_EQ(right->ends(), 128 + SIGKILL);
  ASSERT_TRUE(hand->says("node right is missing")) << hand->said();
  std::this_thread::sleep_for(seconds(5));
  left->signal(SIGCONT);
  ASSERT_TRUE(hand->says("node left shows the wall")) << hand->said();
  right = node("right");
  ASSERT_TRUE(hand->says("node right shows the wall")) << hand->said();
  expect_force_never_ended(*hand);
  expect_orderly_end(*hand);
}

// The session contains all that the hand felt: a tick for each millisecond, none of which released the hand.
TEST_F(ClusterFailures, AKilledNodeIsNotFelt) {
  const auto left = node("left"), right = node("right");
  const auto hand = felt_wall({"--record", folder_.file("kept"), "--material", "mica"});
  std::this_thread::sleep_for(kFelt);
  const std::int64_t killed_ns = core::MonotonicClock().now_ns();
  right->signal(SIGKILL);
  ASSERT_TRUE(hand->says("node right is missing")) << hand->said();
  std::this_thread::sleep_for(kFelt);
  expect_orderly_end(*hand);

  const auto session = servo::load_session(folder_.file("kept/session-mica.afms"));
  ASSERT_TRUE(session) << session.error().message;
  const std::int64_t around_ns = std::chrono::nanoseconds(kFelt).count();
  std::vector<double> before_us, after_us;
  std::uint64_t last_tick = 0;
  for (const scene::TipSample& sample : session->samples) {
    if (std::abs(sample.time_ns - killed_ns) > around_ns) continue;
    EXPECT_EQ(sample.renderer, scene::RendererLink::Alive) << sample.tick;
    EXPECT_EQ(sample.servo_state, scene::ServoState::Running) << sample.tick;
    EXPECT_TRUE(last_tick == 0 || sample.tick == last_tick + 1) << sample.tick;
    last_tick = sample.tick;
    (sample.time_ns < killed_ns ? before_us : after_us).push_back(sample.wake_us);
  }
  const double ticks = session->rate_hz * std::chrono::duration<double>(kFelt).count();
  EXPECT_GT(static_cast<double>(before_us.size()), 0.9 * ticks);
  EXPECT_GT(static_cast<double>(after_us.size()), 0.9 * ticks);
  for (const auto& [what, late_us] : {std::pair{"before a node is killed", &before_us}, {"from then on", &after_us}}) {
    const core::Percentiles late = core::percentiles(*late_us);
    std::printf("ticks %s: late by %.0f us (p50), %.0f us (p99), %.0f us at most\n", what, late.p50, late.p99,
                late.max);
  }
}

// A thread of another process that does nothing as long as this lives, as if it waited in a system call.
class StoppedThread {
 public:
  StoppedThread(pid_t process, const std::string& name) {
    for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
      if (core::read_file((task.path() / "comm").string()).value_or("") == name + "\n") {
        thread_ = std::stoi(task.path().filename().string());
      }
    }
    stopped_ = thread_ > 0 && ::ptrace(PTRACE_SEIZE, thread_, nullptr, nullptr) == 0 &&
               ::ptrace(PTRACE_INTERRUPT, thread_, nullptr, nullptr) == 0 && ::waitpid(thread_, nullptr, __WALL) > 0;
  }
  StoppedThread(const StoppedThread&) = delete;
  StoppedThread& operator=(const StoppedThread&) = delete;
  ~StoppedThread() {
    if (stopped_) ::ptrace(PTRACE_DETACH, thread_, nullptr, nullptr);
  }
  bool stopped() const { return stopped_; }

 private:
  pid_t thread_ = 0;
  bool stopped_ = false;
};

TEST_F(ClusterFailures, ANetworkThatBlocksForFiveSecondsIsNotNoticedByTheHand) {
  const auto left = node("left"), right = node("right");
  const auto hand = felt_wall();
  {
    const StoppedThread network(hand->pid(), "wall network");
    ASSERT_TRUE(network.stopped()) << "stopping a thread of another program needs the right to trace it";
    for (int i = 0; i < 2; ++i) {
      ASSERT_NE(hand->says_one_of({"node left is missing", "node right is missing"}), "") << hand->said();
    }
    std::this_thread::sleep_for(seconds(5));
  }
  expect_both_shown(*hand);
  expect_force_never_ended(*hand);
  expect_orderly_end(*hand);
}

TEST_F(ClusterFailures, NodesOutliveTheirMasterAndFollowTheNext) {
  const auto left = node("left"), right = node("right");
  auto hand = start(master_command());
  expect_both_shown(*hand);
  hand->signal(SIGKILL);
  EXPECT_EQ(hand->ends(), 128 + SIGKILL);
  hand = start(master_command());
  expect_both_shown(*hand);
  // and one that shows another wall
  hand->signal(SIGKILL);
  EXPECT_EQ(hand->ends(), 128 + SIGKILL);
  std::string other = core::read_file(folder_.file("wall.toml")).value();
  for (std::size_t at = other.find(kMode); at != std::string::npos; at = other.find(kMode)) {
    other.replace(at, kMode.size(), "top-bottom-half");
  }
  folder_.write("wall.toml", other);
  hand = start(master_command());
  expect_both_shown(*hand);
  xdotool("mousemove 5 " + std::to_string(kHeight + kMargin - 1));
  EXPECT_TRUE(all_same()) << hand->said();
  expect_orderly_end(*hand);
  for (const auto& one : {left.get(), right.get()}) {
    one->signal(SIGTERM);
    EXPECT_EQ(one->ends(), 0) << one->said();
  }
}

TEST_F(ClusterFailures, ANodeOfAnotherBuildOrWithOtherModelsIsRefusedAndBothAreNamed) {
  const auto own = exhibit::build_digest(support::touchafm());
  ASSERT_TRUE(own);
  for (const bool other_build : {true, false}) {
    const exhibit::WallModel model{.build = other_build ? 0x1111222233334444U : *own,
                                   .scene = 0x5555666677778888U,
                                   .wall = core::read_file(folder_.file("wall.toml")).value(),
                                   .guidance = {},
                                   .materials = {},
                                   .meshes = {},
                                   .files = {},
                                   .tapping = {},
                                   .picture = {}};
    const core::MonotonicClock clock;
    const auto master = cluster::MasterLink::open({.interface_address = "127.0.0.1",
                                                   .peers = {"127.0.0.1"},
                                                   .domain = static_cast<std::uint32_t>(std::stoi(domain()))},
                                                  exhibit::document_of(model), 0, clock);
    ASSERT_TRUE(master) << master.error().message;
    const auto left = node("left");
    EXPECT_EQ(left->ends(), 3) << left->said();
    EXPECT_THAT(left->said(), HasSubstr(other_build ? "1111222233334444" : "5555666677778888"));
    std::optional<cluster::NodeState> heard;
    while (const auto answer = (*master)->answer()) heard = answer->ready.state;
    EXPECT_EQ(heard, other_build ? cluster::NodeState::OtherBuild : cluster::NodeState::OtherScene);
  }
}

TEST_F(ClusterFailures, TheDoctorNamesTheNodeThatDoesNotAnswerAndHowToStartIt) {
  const std::string doctor = support::touchafm() + " doctor --cluster " + folder_.file("wall.toml") + " --domain " +
                             domain() + " --interface 127.0.0.1 --patience ";
  const auto left = node("left");
  const support::ProgramResult one = support::run_program(doctor + "6");
  EXPECT_EQ(one.exit_code, 1);
  EXPECT_THAT(one.out, ContainsRegex("node left +good +draws in"));
  EXPECT_THAT(one.out, ContainsRegex("node right +missing +does not answer"));
  EXPECT_THAT(one.out, HasSubstr("start touchafm node right --interface ADDRESS --domain " + domain()));
  const auto right = node("right");
  const support::ProgramResult both = support::run_program(doctor + "40");
  EXPECT_EQ(both.exit_code, 0) << both.out << both.err;
  EXPECT_THAT(both.out, ContainsRegex("node right +good +draws in"));
}

TEST_F(ClusterFailures, TheBenchmarkStartsItsOwnNodes) {
  const support::ProgramResult measured =
      support::run_program(support::touchafm() + " bench cluster --nodes 2 --frames 60 --json --domain " + domain());
  ASSERT_EQ(measured.exit_code, 0) << measured.err;
  const auto result = nlohmann::json::parse(measured.out);
  EXPECT_EQ(result.at("frames"), 60);
  EXPECT_EQ(result.at("lost_samples"), nlohmann::json({0, 0}));
  EXPECT_GT(result.at("skew_s").at("max").get<double>(), 0.0);
}

TEST_F(ClusterFailures, AHundredThousandBrokenDatagramsEndNoProgram) {
  const auto left = node("left"), right = node("right");
  const auto hand = felt_wall();
  send_broken_datagrams(cluster::first_port(static_cast<std::uint32_t>(std::stoi(domain()))), 100'000);
  expect_force_never_ended(*hand);
  hand->skip_what_it_said();
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0) << hand->said();
  for (const auto& one : {left.get(), right.get()}) {
    one->signal(SIGTERM);
    EXPECT_EQ(one->ends(), 0) << one->said();
  }
}

}  // namespace cluster_failures_test
}  // namespace afm::app
