// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "app/display/view_headset.h"
#include "core/whole_file.h"
#include "exhibit/frame/exhibit_setup.h"
#include "servo/replay.h"
#include "servo/session_file.h"
#include "support/faulty_device.h"
#include "support/frame_log.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/stall_watch.h"
#include "support/virtual_display.h"

// The program with a headset of the stand-in runtime, scripted by a file of the test, and its mirror on an X server
// without a screen. Vulkan's calls are validated: a message would end the program with exit code 1.
namespace afm::app {
namespace view_headset_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ViewInAHeadset : public ::testing::Test {
 protected:
  ViewInAHeadset() {
    folder_.write("script", "");
    ::setenv("XR_RUNTIME_JSON", support::openxr_stand_in().c_str(), 1);
    ::setenv("AFM_STAND_IN", folder_.file("script").c_str(), 1);
  }
  ~ViewInAHeadset() override { ::unsetenv("AFM_STAND_IN"); }

  static std::vector<std::string> command(const std::vector<std::string>& more = {}) {
    std::vector<std::string> all{support::touchafm(),
                                 "view",
                                 "--headset",
                                 "--size",
                                 "320x240",
                                 "--wand",
                                 "mouse",
                                 "--frame-rate",
                                 "12",
                                 "--haptics",
                                 "sim",
                                 "--servo",
                                 support::servo_mode(),
                                 "--validate"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void tell(const std::string& line) const {
    std::ofstream(folder_.file("script"), std::ios::app) << line << std::endl;
  }
  // The controller points at a swatch and presses.
  void choose(std::size_t material) const {
    const scene::HeadPose floor = room_from_headset_floor(stage_.wall, stage_.screen);
    const glm::dquat floor_from_room = glm::conjugate(floor.room_from_head);
    const glm::dvec3 hand = stage_.wall_scene.places().wand_grip_m();
    const glm::dvec3 swatch = stage_.wall_scene.swatch_targets()[material].center_m;
    const glm::dvec3 from = floor_from_room * (hand - floor.position_m);
    const glm::dquat turn =
        glm::rotation(glm::dvec3(0.0, 0.0, -1.0), glm::normalize(floor_from_room * (swatch - hand)));
    tell(fmt::format("aim {} {} {} {} {} {} {}", from.x, from.y, from.z, turn.x, turn.y, turn.z, turn.w));
    tell("press 1 select");
  }
  // Takes the picture away under force. Where a late tick ends the force first, gives the picture back and tries again.
  static bool loses_the_picture(support::LiveProgram& view, const std::function<void()>& take,
                                const std::function<void()>& give_back) {
    for (int attempt = 0; attempt < 5; ++attempt) {
      take();
      if (view.says("force off: nobody sees the picture", std::chrono::seconds(5))) return true;
      give_back();
      if (!view.says("force on")) return false;
    }
    return false;
  }
  bool loses_the_picture(support::LiveProgram& view, const std::string& take, const std::string& give_back) const {
    return loses_the_picture(view, [&] { tell(take); }, [&] { tell(give_back); });
  }
  // Pushes that the controller has given the hand.
  std::ptrdiff_t pulses() const {
    const std::string lines = core::read_file(folder_.file("script.pulses")).value_or("");
    return std::count(lines.begin(), lines.end(), '\n');
  }
  static exhibit::Stage stage_of_the_assets() {
    exhibit::ExhibitFiles files;
    files.assets_dir = support::source("assets");
    return std::move(*exhibit::load_exhibit(files));
  }
  void expect_good_end(support::LiveProgram& view) const {
    view.signal(SIGTERM);
    EXPECT_EQ(view.ends(), 0) << view.said();
  }

  // From what the runtime did, by its log, to the tick after which the servo holds no hand any more, by its session,
  // which replays bit for bit. False, after a line on stdout, if a bound was exceeded while the machine stood still.
  bool expect_free_in_time(const std::string& sessions, const std::set<std::string>& ways,
                           double longest_picture_ms = kUsualPictureMs) const {
    bool judged = true;
    judge(sessions, ways, longest_picture_ms, judged);
    return judged;
  }
  void judge(const std::string& sessions, const std::set<std::string>& ways, double longest_picture_ms,
             bool& judged) const {
    std::vector<scene::TipSample> samples;
    for (const auto& file : std::filesystem::directory_iterator(sessions)) {
      const auto session = servo::load_session(file.path());
      ASSERT_TRUE(session) << session.error().message;
      EXPECT_TRUE(servo::replay(*session)->identical()) << file.path();
      samples.insert(samples.end(), session->samples.begin(), session->samples.end());
    }
    std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
    std::ifstream log(folder_.file("script.log"));
    std::set<std::string> seen;
    std::int64_t lost_ns = 0;
    for (std::string what; log >> what >> lost_ns;) {
      const auto first =
          std::find_if(samples.begin(), samples.end(), [&](const auto& s) { return s.time_ns >= lost_ns; });
      ASSERT_NE(first, samples.end()) << what;
      if (!holds(*first)) continue;  // a late tick had ended the force: the test took the picture away once more
      seen.insert(what);
      const auto free = std::find_if_not(first, samples.end(), holds);
      ASSERT_NE(free, samples.end()) << what;
      EXPECT_EQ(free->hand_force_n, 0.0) << what;
      const double took_ms = 1e-6 * static_cast<double>(free->time_ns - lost_ns);
      const support::Milliseconds stalled = watch_.longest_between(lost_ns, free->time_ns);
      if (took_ms > most_ms(longest_picture_ms) && stalled > support::kAwake) {
        std::printf("%s: %.0f ms, not judged: the machine stood still for %.0f ms\n", what.c_str(), took_ms,
                    stalled.count());
        judged = false;
        continue;
      }
      EXPECT_LE(took_ms, most_ms(longest_picture_ms)) << what << "; longest stall " << stalled.count() << " ms";
      RecordProperty(what + "_ms", std::to_string(took_ms));
    }
    EXPECT_EQ(seen, ways) << "with a force to lose";
  }
  void wear_and_lose(const std::string& sessions, bool& judged);
  void hang_the_device(const std::string& sessions, bool& judged);

  // Tries a scenario in at most three windows, until one is judged; it is given a folder for its sessions.
  void in_a_window(const std::function<bool(const std::string& sessions)>& scenario) {
    for (int window = 1; window <= 3; ++window) {
      for (const char* file : {"script", "script.log", "script.pulses"}) std::filesystem::remove(folder_.file(file));
      folder_.write("script", "");
      if (scenario(folder_.file("sessions" + std::to_string(window))) || HasFailure()) return;
    }
    ADD_FAILURE() << "not judged: the machine stood still in three windows";
  }
  static bool holds(const scene::TipSample& sample) {
    return sample.servo_state != scene::ServoState::Disarmed && sample.servo_state != scene::ServoState::Fault;
  }
  // Twice the bound that the manual gives where no picture took longer than that.
  static constexpr double most_ms(double longest_picture_ms) { return 2.0 * (2.0 * longest_picture_ms + 100.0); }
  static constexpr double kUsualPictureMs = 125.0;

  exhibit::Stage stage_ = stage_of_the_assets();
  support::ScratchFolder folder_;
  support::VirtualDisplay display_{640, 480};
  const support::StallWatch watch_;
};

// A whole cycle is felt. Then the headset is taken off, put on, lost, and found again: each time the hand is free in
// time, and needs Turn-On again.
TEST_F(ViewInAHeadset, FeelsASampleAndLetsTheHandGoInTimeWheneverTheHeadsetIsGone) {
  in_a_window([&](const std::string& sessions) {
    bool judged = false;
    wear_and_lose(sessions, judged);
    return judged;
  });
}
void ViewInAHeadset::wear_and_lose(const std::string& sessions, bool& judged) {
  support::LiveProgram view(command({"--record", sessions}), display_.name());
  EXPECT_TRUE(view.says("headset without lenses through stand-in 1.2.3")) << view.said();
  ASSERT_TRUE(view.says("headset: has the controllers")) << view.said();
  EXPECT_THAT(view.said(), Not(HasSubstr("force off"))) << "before there was any";
  choose(1);
  EXPECT_TRUE(view.says("chosen: Gold")) << view.said();
  EXPECT_TRUE(view.says("jump to contact at Z")) << view.said();
  EXPECT_TRUE(view.says("jump off contact")) << view.said();
  EXPECT_TRUE(view.within(std::chrono::seconds(5), [&] { return pulses() >= 2; }))
      << "one for each jump: " << pulses() << "\n"
      << view.said();
  ASSERT_TRUE(loses_the_picture(view, "state 4\nstate 3\nstate 6", "state 2")) << view.said();
  tell("state 2");
  ASSERT_TRUE(view.says("force on")) << view.said();
  ASSERT_TRUE(loses_the_picture(view, "fail xrEndFrame -13", "")) << view.said();
  EXPECT_THAT(view.said(), HasSubstr("looking for it every 2 s"));
  EXPECT_TRUE(view.says("headset without lenses")) << view.said();
  ASSERT_TRUE(view.says("jump to contact")) << view.said();
  ASSERT_TRUE(loses_the_picture(view, "block", "unblock")) << view.said();
  tell("unblock");
  ASSERT_TRUE(view.says("force on")) << view.said();
  ASSERT_TRUE(loses_the_picture(view, "keep", "lend")) << view.said();
  tell("lend");
  ASSERT_TRUE(view.says("force on")) << view.said();
  ASSERT_TRUE(loses_the_picture(view, "hide", "unhide")) << view.said();
  EXPECT_THAT(view.said(), HasSubstr("headset: hidden"));
  expect_good_end(view);
  EXPECT_THAT(view.said(), Not(HasSubstr("Stop was pressed")));
  judged = expect_free_in_time(sessions, {"blocked", "failed", "kept"});
}

// Both jumps of the swing are felt with a headset on, and replay bit for bit.
TEST_F(ViewInAHeadset, FeelsALeverThatTapsAndRecordsIt) {
  const std::string sessions = folder_.file("sessions");
  support::LiveProgram view(command({"--record", sessions, "--mode", "tapping", "--free-amplitude", "20nm",
                                     "--spring-constant", "40N/m", "--resonance", "300kHz", "--quality-factor", "400"}),
                            display_.name());
  ASSERT_TRUE(view.says("headset: has the controllers")) << view.said();
  choose(0);
  ASSERT_TRUE(view.says("chosen: Mica")) << view.said();
  ASSERT_TRUE(view.says("jump to the repulsive state")) << view.said();
  ASSERT_TRUE(view.says("jump to the attractive state")) << view.said();
  EXPECT_TRUE(view.within(std::chrono::seconds(5), [&] { return pulses() >= 2; }))
      << "one for each jump: " << pulses() << "\n"
      << view.said();
  expect_good_end(view);
  int replayed = 0;
  for (const auto& file : std::filesystem::directory_iterator(sessions)) {
    const auto session = servo::load_session(file.path());
    ASSERT_TRUE(session) << session.error().message;
    EXPECT_NE(session->find(physics::EventKind::JumpToRepulsion), nullptr);
    EXPECT_TRUE(servo::replay(*session)->identical()) << file.path();
    ++replayed;
  }
  EXPECT_GE(replayed, 1);
}

// Of the eight pictures before a hang, which the program waits for: by its frame log, whose last interval of
// kHangMs or more is the hang.
constexpr int kHangMs = 1000;
double longest_picture_ms(const std::string& frame_log, double least_ms) {
  constexpr std::ptrdiff_t kPictures = 8;
  double longest_ms = least_ms;
  const std::vector<double> all = support::intervals_ms(frame_log);
  const auto hung = std::find_if(all.rbegin(), all.rend(), [](double ms) { return ms >= kHangMs; });
  for (auto ms = hung; ms != all.rend() && ms - hung <= kPictures; ++ms) {
    if (ms != hung) longest_ms = std::max(longest_ms, *ms);
  }
  return longest_ms;
}

// The program waits for the device while the wearer sees a frozen picture.
TEST_F(ViewInAHeadset, LetsTheHandGoInTimeWhenTheGraphicsDeviceHangs) {
  in_a_window([&](const std::string& sessions) {
    bool judged = false;
    hang_the_device(sessions, judged);
    return judged;
  });
}
void ViewInAHeadset::hang_the_device(const std::string& sessions, bool& judged) {
  const std::string stuck = folder_.file("stuck"), frames = folder_.file("frames.csv");
  std::vector<std::string> program = command({"--record", sessions, "--frame-log", frames});
  std::erase(program, "--validate");  // validation would not know the pretended hang
  support::LiveProgram view(test::on_faulty_device("stuck:" + stuck, program), display_.name());
  ASSERT_TRUE(view.says("headset: has the controllers")) << view.said();
  choose(1);
  ASSERT_TRUE(view.says("jump to contact at Z")) << view.said();
  const auto hang = [&] {
    std::ofstream(folder_.file("script.log"), std::ios::app)
        << "hung " << std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1) << std::endl;
    folder_.write("stuck", "");
    std::this_thread::sleep_for(std::chrono::milliseconds(kHangMs));
    std::filesystem::remove(stuck);  // the program says nothing before
  };
  EXPECT_TRUE(loses_the_picture(view, hang, [] {})) << view.said();
  expect_good_end(view);
  judged = expect_free_in_time(sessions, {"hung"}, longest_picture_ms(frames, kUsualPictureMs));
}

// AFM_HEADSET_VIEW_SECONDS: for how long.
TEST_F(ViewInAHeadset, LosesNoSampleAndReplaysWhateverTheRuntimeDoes) {
  struct Whim {
    const char* take;
    const char* give_back;
  };
  static constexpr std::array kWhims{Whim{"state 4\nstate 3\nstate 6", "state 2"},
                                     Whim{"fail xrEndFrame -13", ""},
                                     Whim{"fail xrWaitFrame -17", ""},
                                     Whim{"block", "unblock"},
                                     Whim{"keep", "lend"},
                                     Whim{"hide", "unhide"},
                                     Whim{"gone\nfail xrEndFrame -13", "back"}};
  const char* asked = std::getenv("AFM_HEADSET_VIEW_SECONDS");
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(asked == nullptr ? 15 : std::atoi(asked));
  const std::string sessions = folder_.file("sessions");
  support::LiveProgram view(command({"--record", sessions}), display_.name());
  ASSERT_TRUE(view.says("headset: has the controllers")) << view.said();
  choose(1);
  ASSERT_TRUE(view.says("force on")) << view.said();
  std::mt19937 random(22);
  while (std::chrono::steady_clock::now() < end) {
    const Whim& whim = kWhims[random() % kWhims.size()];
    tell(whim.take);
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 800));
    tell(whim.give_back);
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 2500));
  }
  view.skip_what_it_said();
  EXPECT_TRUE(view.says("jump to contact")) << view.said();
  expect_good_end(view);
  EXPECT_THAT(view.said(), HasSubstr("; 0 samples lost on the way to the wall"));
  for (const auto& file : std::filesystem::directory_iterator(sessions)) {
    const auto session = servo::load_session(file.path());
    ASSERT_TRUE(session) << session.error().message;
    EXPECT_TRUE(servo::replay(*session)->identical()) << file.path();
  }
}

TEST_F(ViewInAHeadset, SaysInOneLineWhatIsMissing) {
  tell("gone");
  support::ProgramResult gone;
  support::expect_within(std::chrono::seconds(2), [&] {  // twice the second that it may take
    return support::timed([&] { gone = support::run_program(support::touchafm() + " view --headset"); });
  });
  EXPECT_EQ(gone.exit_code, 4);
  EXPECT_THAT(gone.err, AllOf(HasSubstr("XR_ERROR_RUNTIME_UNAVAILABLE"), HasSubstr(support::openxr_stand_in()),
                              HasSubstr("install libopenxr-loader1")));
  EXPECT_EQ(std::count(gone.err.begin(), gone.err.end(), '\n'), 1) << gone.err;
}

// Below the sweet spot, with -z towards the screen, for any orientation of the wall in its room.
TEST(RoomFromHeadsetFloor, PutsTheWearerBeforeTheWall) {
  const scene::Screen side{
      .name = "side", .lower_left = {2, 0.5, -1}, .lower_right = {2, 0.5, 1}, .upper_left = {2, 2.5, -1}};
  scene::Wall wall{.screens = {side}, .outputs = {}, .viewers = {{}}};
  wall.viewers.front().sweet_spot.position_m = {-1, 1.7, 0.2};
  const scene::HeadPose floor = room_from_headset_floor(wall, side);
  EXPECT_EQ(floor.position_m, glm::dvec3(-1, 0, 0.2));
  EXPECT_LT(glm::distance(floor.room_from_head * glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0)), 1e-12);
  EXPECT_LT(glm::distance(floor.room_from_head * glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0)), 1e-12);
  const scene::Screen table{
      .name = "table", .lower_left = {-1, 0.8, -1}, .lower_right = {-1, 0.8, -3}, .upper_left = {-2, 0.8, -1}};
  const glm::dvec3 ahead = room_from_headset_floor(wall, table).room_from_head * glm::dvec3(0, 0, -1);
  EXPECT_LT(glm::distance(ahead, glm::dvec3(-1, 0, 0)), 1e-12);
}

}  // namespace view_headset_test
}  // namespace afm::app
