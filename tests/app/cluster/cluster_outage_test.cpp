// SPDX-License-Identifier: Apache-2.0
// What takes long: outages beyond the time that DDS remembers a machine, a node that is started again and again, ten
// minutes of a wall, a million broken datagrams.
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

#include "app/cluster/cluster_cable.h"
#include "app/cluster/cluster_noise.h"
#include "core/percentiles.h"
#include "core/whole_file.h"
#include "support/places.h"

namespace afm::app {
namespace cluster_outage_test {

using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kMinutes = 10;
// In the usual minute. What leaks grows in every minute, by this much if each frame leaves 700 bytes. What the C
// library keeps of a driver's threads comes in steps, of up to 10 MB: one in 83 minutes, one in ten beside builds.
constexpr double kMostGrowthKb = 512;
// Names of threads as listed by the system: ours, and Cyclone's for receiving, timed events, delivery and cleaning up.
constexpr std::array kNetworkThreads{"wall network", "recv", "tev", "dq.", "gc"};

class ClusterOutage : public ClusterCable {
 protected:
  // The machine with the hand, which feels mica; null if it does not.
  std::unique_ptr<support::LiveProgram> begin() {
    std::vector<std::string> command = master_command();
    command.insert(command.end(), {"--haptics", "sim"});
    auto hand = start(network_.on(0, command));
    expect_both_shown(*hand);
    press_at_master("1");
    if (hand->says("force on")) return hand;
    ADD_FAILURE() << hand->said();
    return nullptr;
  }
};

TEST_F(ClusterOutage, LongerThanTheLeaseOfDdsEndsWithinTwiceTwoSeconds) {
  const auto left = node("left", 1);
  const auto right = node("right", 2);
  const auto hand = begin();
  ASSERT_TRUE(hand);
  for (const int out_s : {14, 40}) {
    network_.pull_cable(1);
    ASSERT_TRUE(hand->says("node left is missing")) << hand->said();
    std::this_thread::sleep_for(seconds(out_s));
    network_.plug_cable(1);
    ASSERT_TRUE(hand->says("node left shows the wall", seconds(4))) << out_s << " s: " << hand->said();
  }
  EXPECT_THAT(hand->said(), Not(HasSubstr("the renderer gave no frame")));
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0);
  EXPECT_THAT(hand->said(), Not(HasSubstr("built frame")));
}

TEST_F(ClusterOutage, ANodeThatComesThirtySecondsLateBuildsTheSameFrames) {
  const auto left = node("left", 1);
  std::vector<std::string> command = master_command();
  command.insert(command.end(), {"--haptics", "sim"});
  const auto hand = start(network_.on(0, command));
  ASSERT_TRUE(hand->says("node left shows the wall")) << hand->said();
  press_at_master("1");
  ASSERT_TRUE(hand->says("force on")) << hand->said();
  std::this_thread::sleep_for(seconds(30));
  const auto right = node("right", 2);
  ASSERT_TRUE(hand->says("node right shows the wall")) << hand->said();
  ASSERT_TRUE(hand->says("jump to contact")) << hand->said();
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0);
  EXPECT_THAT(hand->said(), Not(HasSubstr("built frame")));
}

TEST_F(ClusterOutage, TwentyRestartsOfANodeEachShowTheWallAgain) {
  auto left = node("left", 1);
  const auto right = node("right", 2);
  const auto hand = begin();
  ASSERT_TRUE(hand);
  // the node recomputes each time the lines scanned so far
  press_at_master("i");
  ASSERT_TRUE(hand->says("scan: ")) << hand->said();
  for (int i = 0; i < 20; ++i) {
    left->signal(SIGKILL);
    left->ends();
    ASSERT_TRUE(hand->says("node left is missing")) << i << hand->said();
    left = node("left", 1);
    ASSERT_TRUE(hand->says("node left shows the wall")) << i << hand->said();
  }
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0);
  EXPECT_THAT(hand->said(), Not(HasSubstr("built frame")));
}

TEST_F(ClusterOutage, AMinuteOfFramesLosesNone) {
  const support::ProgramResult measured =
      support::run_program(support::touchafm() + " bench cluster --nodes 3 --frames 3600 --json --domain " + domain());
  ASSERT_EQ(measured.exit_code, 0) << measured.err;
  std::printf("%s", measured.out.c_str());
  const auto result = nlohmann::json::parse(measured.out);
  EXPECT_EQ(result.at("lost_samples"), nlohmann::json({0, 0, 0}));
  EXPECT_EQ(result.at("frames"), 3600);
}

TEST_F(ClusterOutage, AMillionBrokenDatagramsEndNoProgram) {
  folder_.write("wall.toml", wall_of_three("127.0.0.1", "127.0.0.1"));
  const auto left = start(node_command("left", "127.0.0.1")), right = start(node_command("right", "127.0.0.1"));
  const auto hand = start(master_command());
  expect_both_shown(*hand);
  send_broken_datagrams(cluster::first_port(static_cast<std::uint32_t>(std::stoi(domain()))), 1'000'000);
  for (const auto& one : {left.get(), right.get(), hand.get()}) {
    one->signal(SIGTERM);
    EXPECT_EQ(one->ends(), 0) << one->said();
  }
}

// Memory of a program, and the processor time that its threads for the network have used.
struct Consumption {
  long resident_kb = 0;
  double network_s = 0;
};
Consumption consumption_of(pid_t process) {
  const std::string folder = "/proc/" + std::to_string(process);
  Consumption now;
  long pages = 0;
  std::ifstream(folder + "/statm") >> pages >> pages;
  now.resident_kb = pages * (::sysconf(_SC_PAGESIZE) / 1024);
  for (const auto& task : std::filesystem::directory_iterator(folder + "/task")) {
    const std::string name = core::read_file((task.path() / "comm").string()).value_or("");
    const bool ours = std::any_of(kNetworkThreads.begin(), kNetworkThreads.end(),
                                  [&](const char* begin) { return name.starts_with(begin); });
    if (!ours) continue;
    const std::string stat = core::read_file((task.path() / "stat").string()).value_or(")");
    std::istringstream fields(stat.substr(stat.rfind(')') + 1));
    std::string skipped;
    for (int i = 0; i < 11; ++i) fields >> skipped;
    double user = 0, system = 0;
    fields >> user >> system;
    now.network_s += (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  }
  return now;
}

// Median growth from one minute to the next.
double usual_growth_kb(const std::vector<double>& resident_kb) {
  std::vector<double> grown(resident_kb.size());
  std::adjacent_difference(resident_kb.begin(), resident_kb.end(), grown.begin());
  grown.erase(grown.begin());  // value of the first minute itself
  return core::percentiles(std::move(grown)).p50;
}

TEST_F(ClusterOutage, TenMinutesOfAWallTakeNoMemory) {
  const auto left = node("left", 1);
  const auto right = node("right", 2);
  const auto hand = begin();
  ASSERT_TRUE(hand);
  // time for every panel to be drawn and every buffer to grow
  std::this_thread::sleep_for(seconds(60));
  const std::array programs{hand.get(), left.get(), right.get()};
  std::array<Consumption, 3> before;
  std::array<std::vector<double>, 3> resident_kb;
  for (int minute = 0; minute <= kMinutes; ++minute) {
    for (std::size_t i = 0; i < programs.size(); ++i) {
      const Consumption now = consumption_of(programs[i]->pid());
      if (minute == 0) before[i] = now;
      resident_kb[i].push_back(static_cast<double>(now.resident_kb));
      std::printf("minute %d, program %zu: %ld kB; %.2f s of a processor for the network\n", minute, i, now.resident_kb,
                  now.network_s - before[i].network_s);
    }
    std::fflush(stdout);
    if (minute < kMinutes) std::this_thread::sleep_for(seconds(60));
  }
  for (const std::vector<double>& of_one : resident_kb) EXPECT_LT(usual_growth_kb(of_one), kMostGrowthKb);
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0);
  EXPECT_THAT(hand->said(), Not(HasSubstr("built frame")));
}

}  // namespace cluster_outage_test
}  // namespace afm::app
