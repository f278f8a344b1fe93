// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "servo/session_file.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

// Session files that are well formed, with right checksums, and hold what no session can: every command that reads one
// does its work or says one line that names the file, and ends.
namespace afm::app {
namespace absurd_sessions_test {

using servo::RecordedSession;
using testing::HasSubstr;

struct Absurdity {
  const char* name;
  void (*make)(RecordedSession& session);
};

constexpr double kHuge = 1e300;

constexpr Absurdity kAbsurdities[]{
    {"RateOfNextToNothing", [](RecordedSession& s) { s.rate_hz = 1e-300; }},
    {"RateBeyondEveryClock", [](RecordedSession& s) { s.rate_hz = kHuge; }},
    {"HandThatDoesNotMoveTheTip", [](RecordedSession& s) { s.hand_m_per_m = 0.0; }},
    {"HandScaleHuge", [](RecordedSession& s) { s.hand_m_per_m = kHuge; }},
    {"ForceScaleHuge", [](RecordedSession& s) { s.hand_n_per_n = -kHuge; }},
    {"SlowMotionBackwards", [](RecordedSession& s) { s.slow_motion = -1.0; }},
    {"SampleOfNoSize", [](RecordedSession& s) { s.room_from_sample = {}; }},
    {"SampleHuge", [](RecordedSession& s) { s.room_from_sample.fill(kHuge); }},
    {"TimeThatRunsBackwards",
     [](RecordedSession& s) {
       for (auto& sample : s.samples) sample.time_ns = -sample.time_ns;
     }},
    {"TimeThatJumpsOverAllYears",
     [](RecordedSession& s) {
       s.samples.front().time_ns = std::numeric_limits<std::int64_t>::min();
       s.samples.back().time_ns = std::numeric_limits<std::int64_t>::max();
     }},
    {"HandBeyondTheStars",
     [](RecordedSession& s) {
       for (auto& sample : s.samples) sample.hand_from_contact_m.fill(kHuge);
     }},
    {"TipBeyondTheStars",
     [](RecordedSession& s) {
       for (auto& sample : s.samples) sample.tip.z_m = kHuge;
     }},
    {"ForceBeyondTheStars",
     [](RecordedSession& s) {
       for (auto& sample : s.samples) sample.tip.force_n = -kHuge;
     }},
    {"EventsHuge",
     [](RecordedSession& s) {
       for (auto& event : s.events) event.z_m = event.force_after_n = kHuge;
     }},
    {"WorkspaceInsideOut", [](RecordedSession& s) { std::swap(s.device.workspace_min_m, s.device.workspace_max_m); }},
    {"MaterialWithoutName", [](RecordedSession& s) { s.material.clear(); }},
    {"MaterialOfControlCharacters", [](RecordedSession& s) { s.material = std::string(10'000, '\x1b'); }},
    {"MaterialThatCommandsATerminal", [](RecordedSession& s) { s.material = "gold\x1b[2J"; }},
    {"DeviceThatCommandsATerminal", [](RecordedSession& s) { s.device.name = scene::to_name("a\x1b[2J\nb"); }},
    {"CurveHuge",
     [](RecordedSession& s) {
       s.earlier_curves = {{.material = "gold", .points = {{kHuge, -kHuge}, {-kHuge, kHuge}}}};
     }},
    {"ManyShown", [](RecordedSession& s) { s.shown.assign(10'000, "gold"); }},
};

class AbsurdSession : public testing::TestWithParam<Absurdity> {
 protected:
  // Ends within the time, by itself, and names the file in one line where it fails.
  void expect_borne(const std::string& command) {
    const auto done = support::run_program("timeout 60 " + support::touchafm() + " " + command);
    EXPECT_TRUE(done.exit_code == 0 || done.exit_code == 1 || done.exit_code == 3) << done.exit_code << done.err;
    EXPECT_EQ((done.out + done.err).find('\x1b'), std::string::npos) << done.out << done.err;
    if (done.exit_code == 0) return;
    const std::string last = done.err.substr(done.err.find("error: "));
    EXPECT_THAT(last, HasSubstr(path_)) << command;
    EXPECT_EQ(std::count(last.begin(), last.end(), '\n'), 1) << last;
    EXPECT_LT(last.size(), 1000U) << last;
  }

  support::ScratchFolder folder_;
  std::string path_ = folder_.file("absurd.afms");
};

TEST_P(AbsurdSession, IsPlayedOrNamed) {
  auto session = servo::load_session(support::source("tests/formats/0.1.0/session-gold.afms"));
  ASSERT_TRUE(session) << session.error().message;
  GetParam().make(*session);
  ASSERT_TRUE(servo::save_session(*session, path_));
  expect_borne("replay " + path_);
  expect_borne("replay --json " + path_);
  expect_borne("render --session " + path_ + " --at 0.5 --size 96x64 --out " + folder_.file("picture.png"));
}

INSTANTIATE_TEST_SUITE_P(Of, AbsurdSession, testing::ValuesIn(kAbsurdities),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace absurd_sessions_test
}  // namespace afm::app
