// SPDX-License-Identifier: Apache-2.0
// Invariant: the live window follows a hand through a cycle and survives resizing and a dead servo
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <thread>

#include "app/view/mouse_hand.h"
#include "curves/live_parameters.h"
#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/panels/panel_hit.h"
#include "exhibit/panels/parameter_panel.h"
#include "render/control_layout.h"
#include "render/image_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/sweet_spot.h"
#include "support/virtual_display.h"

// The real window on an X server without a screen, driven by xdotool as a hand drives a mouse and keys. Vulkan's calls
// are validated: a message would end the program with exit code 1.
namespace afm::app {
namespace view_test {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kWidth = 640, kHeight = 480;
constexpr double kHandPerPixel =
    0.085 / 0.30 / kHeight;  // hand travel of a drag, docs/manual/demonstrate.md: 85 mm on 0.30 of the wall

class ViewTest : public ::testing::Test {
 protected:
  std::vector<std::string> command(std::vector<std::string> more = {}) const {
    std::vector<std::string> all{
        support::touchafm(),   "view",      "--size", "640x480", "--frame-rate", "12", "--eye-width", "320", "--servo",
        support::servo_mode(), "--validate"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  void xdotool(const std::string& what) const {
    const auto done = support::run_program("DISPLAY=" + display_.name() + " xdotool " + what);
    ASSERT_EQ(done.exit_code, 0) << "xdotool " << what << ": " << done.err << " (package xdotool)";
  }
  void move_to(const glm::dvec2& pixel) const {
    xdotool("mousemove " + std::to_string(std::lround(pixel.x)) + " " + std::to_string(std::lround(pixel.y)));
  }
  void click(const glm::dvec2& pixel) const {
    move_to(pixel);
    xdotool("click 1");
  }
  void drag_hand(double height_m) const {
    const int rise = static_cast<int>(std::lround(height_m / kHandPerPixel));
    xdotool("mousemove 320 240 mousedown 3 mousemove 320 " + std::to_string(240 - rise) + " mouseup 3");
  }

  // Pixel at which one eye sees a point of the room.
  glm::dvec2 pixel_of(const glm::dvec3& point_m) const {
    scene::Wall one_eyed = stage_.wall;
    one_eyed.viewers.front().ipd_m = 0.0;
    const scene::EyeView eye = support::eyes_at_sweet_spot(one_eyed)[0];
    const glm::dvec4 clip = eye.projection * eye.view * glm::dvec4(point_m, 1.0);
    return 0.5 * glm::dvec2(kWidth, kHeight) * (glm::dvec2(clip) / clip.w + 1.0);
  }

  // The middle of a target of gold's parameter panel.
  glm::dvec2 pixel_of(const render::ControlTarget& target) const {
    const render::PanelPlacement panel = stage_.wall_scene.places().parameters();
    const glm::dvec2 size = exhibit::size_mm(panel, stage_.wall_scene.panel_millimetre_m());
    const curves::LiveParameters gold(
        curves::make_sample_model(curves::ContactSetup{stage_.materials.materials[1], {}, {}}).value());
    const auto box = render::control_box(
        exhibit::parameter_panel(gold, "", exhibit::ChangeState::AsLoaded, stage_.phrases(), "its device"), size,
        target);
    const glm::dvec2 share = 0.5 * (box.from_mm + box.to_mm) / size;
    return pixel_of(panel.lower_left_m + share.x * panel.right_m + (1.0 - share.y) * panel.up_m);
  }

  struct Cycle {
    render::Image down, whole;
  };
  // Presses Turn-On until the force comes: a press before the hand is up, or still, is none.
  bool turn_on(support::LiveProgram& view) const {
    for (int presses = 0; presses < 40; ++presses) {
      xdotool("key t");
      if (view.says("force on", std::chrono::seconds(2))) return true;
    }
    return false;
  }

  // One full cycle on gold by the right button. On a machine that is busy with other things the servo lets go when one
  // of its ticks or frames is late; then the hand lifts and tries again, as the wall says.
  std::optional<Cycle> feel_a_cycle(support::LiveProgram& view) const {
    Cycle cycle;
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(4);
    while (std::chrono::steady_clock::now() < end) {
      if (!turn_on(view)) return std::nullopt;
      drag_hand(-0.100);
      if (view.says_one_of({"jump to contact at Z = 4.07", "force off"}) != "force off") {
        cycle.down = picture("down");
        drag_hand(0.120);
        if (view.says_one_of({"jump off contact at Z = 99.99", "force off"}) != "force off") {
          cycle.whole = picture("whole");
          return cycle;
        }
      }
      drag_hand(0.150);
    }
    return std::nullopt;
  }

  // The screen, kept in the build tree for people to look at.
  render::Image picture(const std::string& name) const {
    render::Image image = display_.screenshot();
    EXPECT_TRUE(render::write_png(image, support::built("view-") + name + ".png"));
    return image;
  }

  static double share_that_differs(const render::Image& a, const render::Image& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
      for (std::size_t c = 0; c < 3; ++c) {
        if (std::abs(int{a.rgba[i + c]} - int{b.rgba[i + c]}) > 24) {
          ++differing;
          break;
        }
      }
    }
    return 4.0 * static_cast<double>(differing) / static_cast<double>(a.rgba.size());
  }

  static exhibit::Stage stage_of_the_assets() {
    exhibit::ExhibitFiles files;
    files.assets_dir = support::source("assets");
    return exhibit::load_exhibit(files).value();
  }

  const exhibit::Stage stage_ = stage_of_the_assets();
  support::VirtualDisplay display_{kWidth, kHeight};
};

TEST_F(ViewTest, AHandGoesThroughTheWholeProcedureWithAMouse) {
  support::LiveProgram view(command(), display_.name());
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  click(pixel_of(stage_.wall_scene.swatch_targets()[1].center_m));
  ASSERT_TRUE(view.says("chosen: Gold")) << view.said();
  const render::Image chosen = picture("chosen");

  drag_hand(-0.030);
  ASSERT_TRUE(view.says("Lift the tip")) << view.said();
  drag_hand(0.060);
  ASSERT_TRUE(view.says("Press Turn-On")) << view.said();
  const auto cycle = feel_a_cycle(view);
  ASSERT_TRUE(cycle.has_value()) << view.said();
  EXPECT_GT(share_that_differs(chosen, cycle->down), 0.005);
  EXPECT_GT(share_that_differs(cycle->down, cycle->whole), 0.005);

  xdotool("key Return");
  ASSERT_TRUE(view.says("force off: Stop was pressed")) << view.said();

  drag_hand(0.150);
  ASSERT_TRUE(turn_on(view)) << view.said();
  xdotool("key KP_Enter");
  ASSERT_TRUE(view.says("force off: Stop was pressed")) << view.said();

  xdotool("key F3");
  ASSERT_TRUE(view.says("panels: the sources of the numbers are shown")) << view.said();
  EXPECT_GT(share_that_differs(cycle->whole, picture("sources")), 0.005);

  // a stiffer lever, by pointing at its + : felt once the force is gone
  xdotool("key F2");
  click(pixel_of(render::ControlTarget{render::ControlTarget::Kind::More, 1}));
  ASSERT_TRUE(view.says("119 mN/m")) << view.said();
  ASSERT_TRUE(view.says("the changed parameters are now in effect")) << view.said();
  EXPECT_GT(share_that_differs(cycle->whole, picture("stiffer")), 0.02);

  xdotool("key Escape");
  EXPECT_EQ(view.ends(), 0) << view.said();
}

TEST_F(ViewTest, GoesThroughEveryStereoModeOfThisDisplayWhileItRuns) {
  support::LiveProgram view(command({"--stereo", "mono"}), display_.name());
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  xdotool("search --sync --name TouchAFM");
  for (const scene::StereoModeTraits& entry : scene::kStereoModes) {
    if (entry.mode == scene::StereoMode::Mono || scene::has_two_pictures(entry.mode)) continue;
    xdotool("key v");
    ASSERT_TRUE(view.says("stereo: " + std::string(entry.name))) << view.said();
  }
  xdotool("key v");
  ASSERT_TRUE(view.says("stereo: mono")) << view.said();
  xdotool("key c");
  ASSERT_TRUE(view.says("stereo: frame-packed-1080p")) << view.said();
  xdotool("key s");
  ASSERT_TRUE(view.says("eyes swapped")) << view.said();
  xdotool("key F8");
  ASSERT_TRUE(view.says("between the eyes: 64 mm")) << view.said();
  xdotool("key F7");
  ASSERT_TRUE(view.says("between the eyes: 63 mm")) << view.said();
  ASSERT_TRUE(view.says("from the eyes: ")) << "the depth meter: " << view.said();
  xdotool("key b");
  ASSERT_TRUE(view.says("into the plane of the wall")) << view.said();
  const render::Image scene = picture("stereo");
  xdotool("key g");
  double differs = 0.0;
  for (int pause = 0; pause < 60 && differs <= 0.2; ++pause) {  // frames of this mode are large and may take a while
    xdotool("sleep 0.5");
    differs = share_that_differs(picture("pattern"), scene);
  }
  EXPECT_GT(differs, 0.2);
  view.signal(SIGINT);
  EXPECT_EQ(view.ends(), 0) << view.said();
}

TEST_F(ViewTest, ShowsTwoWindowsForTwoProjectorsAndSaysWhatQuadBufferNeeds) {
  support::LiveProgram two(command({"--stereo", "dual"}), display_.name());
  ASSERT_TRUE(two.says("F1 shows the keys")) << two.said();
  xdotool("search --sync --name 'TouchAFM, right eye'");
  ASSERT_TRUE(two.says("Choose a sample")) << two.said();
  two.signal(SIGINT);
  EXPECT_EQ(two.ends(), 0) << two.said();

  support::LiveProgram quad(command({"--stereo", "quad-buffer"}), display_.name());
  EXPECT_EQ(quad.ends(), 4);
  EXPECT_THAT(quad.said(), HasSubstr("one picture for both eyes"));
}

TEST_F(ViewTest, OutlivesAStormOfSizesAndTheDeathOfItsServo) {
  support::LiveProgram view(command({"--stereo", "side-by-side"}), display_.name());
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  xdotool("search --sync --name TouchAFM");
  std::string storm = "search --name TouchAFM";
  for (int i = 0; i < 24; ++i) {
    storm += " windowsize " + std::to_string(40 + 97 * i % 600) + " " + std::to_string(30 + 61 * i % 450);
  }
  xdotool(storm);
  xdotool("search --name TouchAFM windowunmap");
  xdotool("search --name TouchAFM windowmap --sync windowsize 640 480 windowfocus");
  xdotool("key F1");
  xdotool("key F11");
  xdotool("key 2");
  EXPECT_TRUE(view.says("chosen: Gold")) << view.said();
  xdotool("key F11");
  xdotool("key a key j");
  EXPECT_TRUE(view.says("showing Millet's analogy")) << view.said();
  EXPECT_TRUE(view.says("the journey of scale was reversed")) << view.said();
  xdotool("key j key a");
  EXPECT_TRUE(view.says("showing the instrument")) << view.said();
  if (support::servo_mode() == "process") {
    EXPECT_EQ(support::run_program("pkill -KILL -P " + std::to_string(view.pid())).exit_code, 0);
    EXPECT_TRUE(view.says("the servo ended unexpectedly")) << view.said();
    EXPECT_THAT(view.said(), Not(HasSubstr("; start again"))) << "it is started again by itself";
    EXPECT_TRUE(view.says("the servo was restarted automatically")) << view.said();
    EXPECT_TRUE(view.says("chosen: Gold")) << view.said();
  }
  picture("side-by-side");
  view.signal(SIGINT);
  EXPECT_EQ(view.ends(), 0) << view.said();
}

// Whether it comes true within 20 s.
bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

// Only a window manager makes an icon of a window.
TEST_F(ViewTest, RestsWhileItIsMinimisedAndComesBack) {
  const support::LiveProgram manager({"/usr/bin/openbox", "--sm-disable"}, display_.name());
  // GLFW 3.3 waits indefinitely for a window that is mapped in the moment in which a manager takes over
  const auto manages = [&] {
    return support::run_program("DISPLAY=" + display_.name() + " xdotool get_num_desktops").exit_code == 0;
  };
  ASSERT_TRUE(eventually(manages));
  support::LiveProgram view(command(), display_.name());
  ASSERT_TRUE(view.says("Choose a sample")) << view.said();
  const std::string window = "search --sync --name '^TouchAFM$' ";
  xdotool(window + "windowactivate --sync key 2");
  ASSERT_TRUE(view.says("chosen: Gold")) << view.said();
  xdotool(window + "windowminimize");
  const auto is_seen = [&] {
    const std::string search = "DISPLAY=" + display_.name() + " xdotool search --onlyvisible --name '^TouchAFM$'";
    return support::run_program(search).exit_code == 0;
  };
  EXPECT_TRUE(eventually([&] { return !is_seen(); })) << "minimised, and still on the screen";
  xdotool(window + "windowactivate --sync key 3");
  EXPECT_TRUE(view.says("chosen: Silicon nitride")) << view.said();
  EXPECT_THAT(view.said(), Not(HasSubstr("the servo ended")));
  view.signal(SIGINT);
  EXPECT_EQ(view.ends(), 0) << view.said();
}

TEST_F(ViewTest, StartsAServoThatDiesThreeTimesAMinuteAndThenAsksForKeyR) {
  ASSERT_EQ(support::servo_mode(), "process") << "a thread dies with its program";
  support::LiveProgram view(command(), display_.name());
  // said from within the loop, when the servo has been started
  ASSERT_TRUE(view.says("Choose a sample")) << view.said();
  const std::string by_itself = "the servo was restarted automatically", by_hand = "R starts it again";
  const auto kill_servos = [&] {
    std::string said = by_itself;
    int killed = 0;
    for (; said == by_itself && killed < 40; ++killed) {
      EXPECT_EQ(support::run_program("pkill -KILL -P " + std::to_string(view.pid())).exit_code, 0);
      EXPECT_TRUE(view.says("the servo ended unexpectedly")) << view.said();
      said = view.says_one_of({by_itself, by_hand});
    }
    EXPECT_EQ(said, by_hand) << view.said();
    return killed;
  };
  EXPECT_GE(kill_servos(), 4);
  xdotool("search --sync --name TouchAFM windowfocus key r");
  EXPECT_TRUE(view.says("the servo was restarted")) << view.said();
  kill_servos();
  xdotool("key Escape");
  EXPECT_EQ(view.ends(), 1) << view.said();
}

TEST_F(ViewTest, RecordsASessionThatReplaysBitForBit) {
  const support::ScratchFolder folder;
  support::LiveProgram view(command({"--haptics", "sim", "--record", folder.file("kept")}), display_.name());
  ASSERT_TRUE(view.says("Choose a sample")) << view.said();
  xdotool("search --sync --name TouchAFM");
  xdotool("key 1");
  ASSERT_TRUE(view.says("chosen: Mica")) << view.said();
  ASSERT_TRUE(view.says("jump off contact")) << view.said();
  view.signal(SIGINT);
  EXPECT_EQ(view.ends(), 0) << view.said();
  EXPECT_THAT(view.said(), HasSubstr("recorded: "));
  const auto replayed = support::run_program(support::touchafm() + " replay " + folder.file("kept/session-mica.afms"));
  EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
  EXPECT_THAT(replayed.out, HasSubstr("is identical, bit for bit"));
}

TEST(View, SaysWhatIsWrongInOneLine) {
  const auto none = support::run_program("env -u WAYLAND_DISPLAY DISPLAY= " + support::touchafm() + " view");
  EXPECT_EQ(none.exit_code, 4);
  EXPECT_THAT(none.err, HasSubstr("cannot open a window"));
  const auto size = support::run_program(support::touchafm() + " view --size 1280");
  EXPECT_EQ(size.exit_code, 2);
  EXPECT_THAT(size.err, HasSubstr("\"1280\" is not WIDTHxHEIGHT"));
  const auto device = support::run_program(support::touchafm() + " view --haptics falcon");
  EXPECT_EQ(device.exit_code, 2);
  EXPECT_THAT(device.err, HasSubstr("choose auto, mouse, hdapi, forcedimension, haply, gamepad, "));
  const auto session = support::run_program(support::touchafm() + " view --haptics replay:/nowhere/x.afms");
  EXPECT_EQ(session.exit_code, 3);
  const auto mode = support::run_program(support::touchafm() + " view --stereo holographic");
  EXPECT_EQ(mode.exit_code, 2);
  EXPECT_THAT(mode.err, HasSubstr("side-by-side"));
}

}  // namespace view_test
}  // namespace afm::app
