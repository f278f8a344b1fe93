// SPDX-License-Identifier: Apache-2.0
// Particles in the real window, on an X server without a screen: pushed with the mouse, taken back, recorded, replayed.
// Invariant: a person can push a particle and undo the push with only keys and hand
// Invariant: a person plans a push, and has a groove guide the hand, with only keys and mouse
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/whole_file.h"
#include "servo/session_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

namespace afm::app {
namespace view_particles_test {

using testing::HasSubstr;

constexpr int kWidth = 640, kHeight = 480;
constexpr double kHandPerPixel =
    0.085 / 0.30 / kHeight;  // docs/manual/demonstrate.md: a drag over 0.30 of the wall is 85 mm

// The gold of the built-in set, in a row along the way of the mouse.
std::string three_in_a_row() {
  const std::string set = core::read_file(support::source("assets/particles/gold-row.toml")).value();
  std::string row = set.substr(0, set.find("[[particle]]"));
  for (const char* x : {"-100 nm", "0 nm", "100 nm"})
    row += "[[particle]]\nx = \"" + std::string(x) + "\"\ny = \"0 nm\"\n";
  return row +
         "[start]\nx = \"-200 nm\"\ny = \"0 nm\"\nz = \"80 nm\"\n"
         "[[move]]\nx = \"-200 nm\"\ny = \"0 nm\"\nz = \"0 nm\"\nspeed = \"1 um/s\"\n";
}

class ViewParticles : public ::testing::Test {
 protected:
  void xdotool(const std::string& what) const {
    const auto done = support::run_program("DISPLAY=" + display_.name() + " xdotool " + what);
    ASSERT_EQ(done.exit_code, 0) << "xdotool " << what << ": " << done.err << " (package xdotool)";
  }

  // View of the particles of row.toml, recorded in the folder `kept`.
  support::LiveProgram recorded_view() const {
    return {
        {support::touchafm(), "view", "--particles", folder_.file("row.toml"), "--size", "640x480", "--eye-width",
         "320", "--frame-rate", "12", "--servo", support::servo_mode(), "--record", folder_.file("kept"), "--validate"},
        display_.name()};
  }

  // Drags the hand by this in all, in steps of a pixel with pauses, or at once.
  void drag(double right_m, double up_m, int steps = 1) const {
    const auto pixels = [](double m) { return std::lround(m / kHandPerPixel); };
    std::string moves = "mousemove 320 240 mousedown 3";
    for (int i = 1; i <= steps; ++i) {
      moves += " sleep 0.04 mousemove " + std::to_string(320 + pixels(right_m) * i / steps) + " " +
               std::to_string(240 - pixels(up_m) * i / steps);
    }
    xdotool(moves + " mouseup 3");
  }

  // Switches the force on. False if it never is.
  bool switches_on(support::LiveProgram& view) const {
    for (int presses = 0; presses < 20; ++presses) {
      xdotool("key t");
      if (view.says("force on", std::chrono::seconds(2))) return true;
    }
    return false;
  }

  // Lifts, switches the force on, puts the tip down left of the row, and pushes the first particle by most of its
  // width. Repeats what a busy machine has stopped. False if there is no force.
  bool push(support::LiveProgram& view, double way_m) const {
    for (int tries = 0; tries < 10; ++tries) {
      drag(0.0, 0.130);
      drag(-0.150, 0.0);
      drag(0.040, 0.0);  // position 30 mm left of the middle
      if (!switches_on(view)) return false;
      drag(0.0, -0.072, 10);
      if (view.says_one_of({"jump to contact", "force off"}) != "jump to contact") continue;
      drag(way_m, 0.0, 30);
      drag(0.0, 0.130);
      if (view.says_one_of({"jump off contact", "force off"}) == "jump off contact") return true;
    }
    return false;
  }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{kWidth, kHeight};
};

std::size_t count(const servo::RecordedSession& session, physics::EventKind kind) {
  return static_cast<std::size_t>(std::count_if(session.events.begin(), session.events.end(),
                                                [&](const scene::TipEvent& event) { return event.kind == kind; }));
}

TEST_F(ViewParticles, ArePushedAndTakenBackAndReplayedBitForBit) {
  folder_.write("row.toml", three_in_a_row());
  support::LiveProgram view = recorded_view();
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  xdotool("search --sync --name TouchAFM");
  xdotool("key BackSpace");
  ASSERT_TRUE(view.says("take back: no push has moved a particle")) << view.said();
  xdotool("key 1");
  ASSERT_TRUE(view.says("chosen: ")) << view.said();
  const auto press = [&](const char* key, const char* said) {
    xdotool(std::string("key ") + key);
    return view.says(said);
  };
  const char* const one_back = "the last push was taken back";
  const char* const all_back = "all pushes were taken back";
  ASSERT_TRUE(push(view, 0.018)) << view.said();
  ASSERT_TRUE(press("BackSpace", one_back)) << view.said();
  ASSERT_TRUE(push(view, 0.018)) << view.said();
  // another session: a push, all put back, and both taken back in turn, the last one from the session before
  ASSERT_TRUE(press("2", "chosen: ")) << view.said();
  ASSERT_TRUE(push(view, 0.026)) << view.said();
  ASSERT_TRUE(press("r", all_back)) << view.said();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(press("BackSpace", one_back)) << view.said();
  // another session with the other tool, on which spheres stick
  ASSERT_TRUE(press("0", "tool grip: the tip holds what it touched")) << view.said();
  ASSERT_TRUE(push(view, 0.018)) << view.said();
  // and another with the other law
  ASSERT_TRUE(press("Insert", "setting: friction law area; Delete chooses the next")) << view.said();
  ASSERT_TRUE(press("Delete", "friction law amontons: in use")) << view.said();
  ASSERT_TRUE(push(view, 0.018)) << view.said();
  xdotool("key Escape");
  ASSERT_EQ(view.ends(), 0) << view.said();

  std::size_t pushed = 0, taken_back = 0, put_back = 0, gripped = 0, by_amontons = 0;
  std::string events;
  for (const auto& file : std::filesystem::directory_iterator(folder_.file("kept"))) {
    if (file.path().extension() != ".afms") continue;
    const auto session = servo::load_session(file.path());
    ASSERT_TRUE(session) << session.error().message;
    events += "\n" + file.path().filename().string();
    for (const scene::TipEvent& event : session->events) events += std::string(" ") + physics::name_of(event.kind);
    pushed += count(*session, physics::EventKind::ParticleTouched);
    taken_back += count(*session, physics::EventKind::PushTakenBack);
    put_back += count(*session, physics::EventKind::ParticlesPutBack);
    if (scene::has_hold(session->particles->set)) gripped += count(*session, physics::EventKind::ParticleTouched);
    by_amontons += session->particles->set.species[0].law == physics::ParticleLaw::Amontons ? 1U : 0U;
    const auto replayed = support::run_program(support::touchafm() + " replay " + file.path().string());
    EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
    EXPECT_THAT(replayed.out, HasSubstr("is identical, bit for bit"));
  }
  EXPECT_GE(pushed, 4U) << events;
  EXPECT_GE(taken_back, 3U) << "the fourth began a session" << events;
  EXPECT_EQ(put_back, 1U) << events;
  EXPECT_GE(gripped, 1U) << events;
  EXPECT_GE(by_amontons, 1U) << events;
}

TEST_F(ViewParticles, ArePlannedByKeysAndMouseAndPushedAlongAGroove) {
  folder_.write("row.toml", three_in_a_row());
  support::LiveProgram view = recorded_view();
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  xdotool("search --sync --name TouchAFM");
  const auto press = [&](const char* key, const char* said) {
    xdotool(std::string("key ") + key);
    return view.says(said);
  };
  ASSERT_TRUE(press("1", "chosen: ")) << view.said();
  ASSERT_TRUE(press("F9", "groove: on, along the plan of a push")) << view.said();
  ASSERT_TRUE(press("w", "plan: particle 1, 121 nm to go; aim within 4")) << view.said();
  ASSERT_TRUE(push(view, 0.018)) << view.said();
  ASSERT_TRUE(press("F9", "groove: off")) << view.said();
  ASSERT_TRUE(press("d", "plan: particle 1, 121 nm to go; aim within 4")) << view.said();
  // a place for the sphere, on the sample in front of the row
  xdotool("mousemove 320 285 click 1");
  ASSERT_TRUE(view.says("plan: particle 1, ")) << view.said();
  ASSERT_TRUE(press("w", "plan: particle 2, ")) << view.said();
  xdotool("key Escape");
  ASSERT_EQ(view.ends(), 0) << view.said();

  std::size_t guided = 0, unguided = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder_.file("kept"))) {
    if (file.path().extension() != ".afms") continue;
    const auto session = servo::load_session(file.path());
    ASSERT_TRUE(session) << session.error().message;
    for (const scene::TipSample& sample : session->samples) {
      if (sample.guide_n != std::array<double, 2>{}) ++guided;
      if (sample.plan.particle >= 0 && sample.plan.guided == 0) ++unguided;
    }
    const auto replayed = support::run_program(support::touchafm() + " replay " + file.path().string());
    EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
    EXPECT_THAT(replayed.out, HasSubstr("is identical, bit for bit"));
  }
  EXPECT_GT(guided, 500U);
  EXPECT_GT(unguided, 0U);
}

TEST_F(ViewParticles, AreDarkFromTheFirstTouchUntilABlindTaskIsDone) {
  folder_.write("row.toml", three_in_a_row() +
                                "[[target]]\nx = \"-74 nm\"\ny = \"0 nm\"\n"
                                "[task]\nkind = \"line\"\nparticle = 1\ntarget = 1\n");
  support::LiveProgram view = recorded_view();
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  xdotool("search --sync --name TouchAFM");
  xdotool("key 1");
  ASSERT_TRUE(view.says("chosen: ")) << view.said();
  ASSERT_TRUE(push(view, 0.010)) << view.said();
  EXPECT_THAT(view.said(), HasSubstr("the picture is dark until the task is done"));
  xdotool("key x");
  ASSERT_TRUE(view.says("the picture stays dark until the task is done; R begins it again")) << view.said();
  xdotool("key r");
  ASSERT_TRUE(view.says("the picture is shown again")) << view.said();
  ASSERT_TRUE(push(view, 0.022)) << view.said();
  ASSERT_TRUE(view.says("the picture is shown again")) << view.said();
  ASSERT_TRUE(view.says("the task is done: done in ")) << view.said();
  xdotool("key Escape");
  ASSERT_EQ(view.ends(), 0) << view.said();
}

TEST_F(ViewParticles, AreShownAsAPictureThatAKeyMeasuresAgain) {
  folder_.write("row.toml", three_in_a_row());
  support::LiveProgram view({support::touchafm(), "view", "--particles", folder_.file("row.toml"), "--level", "2",
                             "--seed", "9", "--size", "640x480", "--eye-width", "320", "--frame-rate", "12", "--servo",
                             support::servo_mode(), "--record", folder_.file("kept"), "--validate"},
                            display_.name());
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  xdotool("search --sync --name TouchAFM");
  const auto press = [&](const char* key, const char* said) {
    xdotool(std::string("key ") + key);
    return view.says(said);
  };
  ASSERT_TRUE(press("1", "chosen: ")) << view.said();
  ASSERT_TRUE(push(view, 0.018)) << view.said();
  ASSERT_TRUE(press("F5", "looking again, as long as the tip stays lifted")) << view.said();
  ASSERT_TRUE(view.says("looked again: particle 1 lies ")) << view.said();
  // without a plan, a press on the bare sample has the same effect, so that a wand needs no key
  xdotool("mousemove 320 285 click 1");
  ASSERT_TRUE(view.says("looking again, as long as the tip stays lifted")) << view.said();
  ASSERT_TRUE(view.says("looked again: particle 1 lies ")) << view.said();
  // a load that is not gentle, and back to a gentle one
  ASSERT_TRUE(press("End", "load of a look: 136 pN, which pushes particles away; gentle up to 67.9 pN")) << view.said();
  ASSERT_TRUE(press("F5", "looking too hard: the scan pushes a particle away")) << view.said();
  ASSERT_TRUE(view.says("looked again: the scan pushed particle 1 away")) << view.said();
  ASSERT_TRUE(press("End", "load of a look: 339 pN")) << view.said();
  ASSERT_TRUE(press("End", "load of a look: 33.9 pN, gentle; the most is 67.9 pN")) << view.said();
  ASSERT_TRUE(press("BackSpace", "take back: no push at level 2")) << view.said();
  ASSERT_TRUE(press("0", "tool grip: the tip holds what it touched")) << view.said();
  // other levels: one without a picture, one with a new picture
  for (const char* setting : {"friction law ", "lever ", "tip ", "medium ", "tool grip", "level as at the start"}) {
    ASSERT_TRUE(press("Insert", (std::string("setting: ") + setting).c_str())) << view.said();
  }
  ASSERT_TRUE(press("Delete", "level 0: in use")) << view.said();
  ASSERT_TRUE(press("F5", "look again: the particles themselves are shown; level 1 or 2 hides them")) << view.said();
  ASSERT_TRUE(press("Delete", "level 1: in use")) << view.said();
  ASSERT_TRUE(push(view, 0.018)) << view.said();
  ASSERT_TRUE(press("F5", " lies 0.00 nm from where the picture had it")) << view.said();
  xdotool("key Escape");
  ASSERT_EQ(view.ends(), 0) << view.said();

  std::array<std::size_t, 3> looks{};
  for (const auto& file : std::filesystem::directory_iterator(folder_.file("kept"))) {
    if (file.path().extension() != ".afms") continue;
    const auto session = servo::load_session(file.path());
    ASSERT_TRUE(session) << session.error().message;
    const scene::SharedLevel& level = session->particles->set.level;
    EXPECT_EQ(level.seed, level.level > 0 ? 9U : 1U);
    looks.at(level.level) += count(*session, physics::EventKind::LookedAgain);
    const auto replayed = support::run_program(support::touchafm() + " replay " + file.path().string());
    EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
    EXPECT_THAT(replayed.out, HasSubstr("is identical, bit for bit"));
    if (session->samples.back().time_ns - session->samples.front().time_ns < 1'100'000'000) continue;
    const auto drawn = support::run_program(support::touchafm() + " render --session " + file.path().string() +
                                            " --at 1 --out " + folder_.file("then.png"));
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  }
  EXPECT_EQ(looks, (std::array<std::size_t, 3>{0, 1, 3}));
}

TEST_F(ViewParticles, HaveNoOldPictureWhereTheTipHidesOrTurnsThem) {
  const auto refused = [&](const std::string& options) {
    const auto view =
        support::run_program("DISPLAY=" + display_.name() + " " + support::touchafm() + " view " + options);
    EXPECT_NE(view.exit_code, 0) << options;
    return view.err;
  };
  EXPECT_THAT(refused("--particles islands --level 1"), HasSubstr("--level 1: only spheres and rods have a picture"));
  EXPECT_THAT(refused("--particles pick-and-place --level 2"), HasSubstr("--level 2: the tip lifts these spheres"));
  EXPECT_THAT(refused("--level 1"), HasSubstr("--level 1: there are no particles"));
  EXPECT_THAT(refused("--particles gold-row --level 3"),
              HasSubstr("or a level of particles; choose none, plane, lines, 0, 1, 2"));
  EXPECT_THAT(refused("--particles gold-row --seed 3"), HasSubstr("--level"));
}

// A set whose sample keeps marks, and the window's messages about them.
struct Marked {
  const char* set;
  const char* nothing_yet;  // text while there is nothing to take back
  const char* begins;
  const char* ends;  // text at the end; empty: none
  const char* taken_back;
  physics::EventKind mark;
};

void PrintTo(const Marked& marked, std::ostream* out) { *out << marked.set; }

class ViewMarks : public ViewParticles, public testing::WithParamInterface<Marked> {};

TEST_P(ViewMarks, AreMadeByAHandAndTakenBackAndReplayedBitForBit) {
  const Marked& marked = GetParam();
  support::LiveProgram view(
      {support::touchafm(), "view", "--particles", marked.set, "--size", "640x480", "--eye-width", "320",
       "--frame-rate", "12", "--servo", support::servo_mode(), "--record", folder_.file("kept"), "--validate"},
      display_.name());
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  xdotool("search --sync --name TouchAFM");
  xdotool("key BackSpace");
  ASSERT_TRUE(view.says(marked.nothing_yet)) << view.said();
  xdotool("key 1");
  ASSERT_TRUE(view.says("chosen: ")) << view.said();
  bool begun = false;
  for (int tries = 0; tries < 10 && !begun; ++tries) {
    drag(0.0, 0.130);
    ASSERT_TRUE(switches_on(view)) << view.said();
    drag(0.0, -0.078, 20);
    begun = view.says_one_of({marked.begins, "force off"}) == marked.begins;
  }
  ASSERT_TRUE(begun) << view.said();
  drag(0.030, 0.0, 60);
  drag(0.0, 0.130);
  ASSERT_TRUE(view.says(marked.ends)) << view.said();
  xdotool("key BackSpace");
  ASSERT_TRUE(view.says(marked.taken_back)) << view.said();
  xdotool("key Escape");
  ASSERT_EQ(view.ends(), 0) << view.said();
  std::size_t marks = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder_.file("kept"))) {
    if (file.path().extension() != ".afms") continue;
    const auto session = servo::load_session(file.path());
    ASSERT_TRUE(session) << session.error().message;
    marks += count(*session, marked.mark);
    const auto replayed = support::run_program(support::touchafm() + " replay " + file.path().string());
    EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
  }
  EXPECT_GE(marks, 1U);
}

INSTANTIATE_TEST_SUITE_P(
    Of, ViewMarks,
    testing::Values(Marked{"scratch-pmma", "take back: no scratch has marked the sample", "the tip marks the sample",
                           "", "the last scratch was taken back", physics::EventKind::SurfaceMarked},
                    Marked{"write-ink", "take back: no ink is on the sample", "the tip touches: ink flows",
                           "the liquid tears", "the last stroke was taken back", physics::EventKind::InkFlows}));

}  // namespace view_particles_test
}  // namespace afm::app
