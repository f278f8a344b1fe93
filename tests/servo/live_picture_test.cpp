// SPDX-License-Identifier: Apache-2.0
// The picture of pushed particles at level 1 and 2: computed, measured again, recorded and drawn again.
// Invariant: a picture knows of the particles only what was measured and what the hand has done since
#include "servo/live_picture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/whole_file.h"
#include "physics/manipulation/sample_drift.h"
#include "servo/recorded_servo.h"
#include "servo/replay.h"
#include "servo/session_file.h"
#include "support/particles/gold_particles.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace live_picture_test {

using physics::EventKind;
using scene::ScaleMode;

constexpr std::uint32_t kSeed = 5;

scene::SharedModel model_at(std::uint32_t level) {
  scene::SharedModel model = test::model_with_particles();
  model.particles.level = {.level = level, .seed = kSeed};
  return model;
}

glm::dvec2 place(std::span<const scene::ParticlePage> pages, std::size_t particle) {
  const scene::ParticlePose& pose = pages[0].poses.at(particle);
  return {pose.x_m, pose.y_m};
}

std::size_t count(const RecordedSession& session, EventKind kind) {
  return static_cast<std::size_t>(std::count_if(session.events.begin(), session.events.end(),
                                                [&](const scene::TipEvent& event) { return event.kind == kind; }));
}

// A servo whose particles are pushed at a level.
class Pushed {
 public:
  explicit Pushed(std::uint32_t level) : recording(model_at(level)) {
    recording.choose(test::kMica, ScaleMode::Particles);
  }

  // Lifts, goes before the row, pushes the first particle a little, and lifts over it.
  void push() {
    recording.arm();
    go({-0.028, 0.0}, 0.03, 0.3);
    go({-0.028, 0.0}, 0.001, 0.3);
    go({-0.016, 0.0}, 0.001, 1.5);
    go({-0.016, 0.0}, 0.05, 0.3);
  }
  void go(const glm::dvec2& place_m, double height_m, double seconds) {
    recording.go(place_m, height_m, seconds);
    recording.run(static_cast<int>(1000.0 * seconds) + 200);
  }
  void look(int ticks = 4000) {
    ++recording.looks;
    recording.run(ticks);
  }
  const PictureNow& now() const { return recording.picture->now(); }
  const RecordedSession& session() const { return recording.sessions.back(); }

  // Way of the sample in the newest tick.
  glm::dvec2 drift_m() const {
    const scene::TipSample& sample = session().samples.back();
    const double elapsed_s = 1e-9 * static_cast<double>(sample.time_ns - sample.level.since_ns);
    const auto way = physics::SampleDrift(physics::kUsualDrift, kSeed).after(physics::Time(elapsed_s));
    return {way.x.si, way.y.si};
  }

  Recording recording;
};

TEST(LivePicture, AtLevelOneShowsWhereTheParticlesAreAndWhatIsMeasured) {
  Pushed pushed(1);
  pushed.recording.run(100);
  EXPECT_THAT(pushed.now().known, testing::Each(Known::Measured));
  pushed.push();
  EXPECT_GT(glm::distance(place(pushed.recording.pages(), 0), {-80e-9, 0.0}), 10e-9) << "it was moved";
  EXPECT_EQ(pushed.now().known[0], Known::Computed);
  EXPECT_EQ(pushed.now().known[2], Known::Measured);
  EXPECT_FALSE(pushed.now().all_measured);
  EXPECT_EQ(place(pushed.recording.picture->shown(), 0), place(pushed.recording.pages(), 0));
  pushed.look();
  EXPECT_EQ(count(pushed.session(), EventKind::LookedAgain), 1U);
  EXPECT_EQ(pushed.now().looks, 1U);
  EXPECT_EQ(pushed.now().newest.particle, 0U);
  EXPECT_EQ(pushed.now().newest.lines, 33U);
  EXPECT_EQ(pushed.now().newest.off_m, 0.0);
  EXPECT_TRUE(pushed.now().all_measured);
  pushed.recording.run(400'000);
  EXPECT_THAT(pushed.now().known, testing::Each(Known::Measured)) << "nothing grows stale without drift";
}

TEST(LivePicture, AtLevelTwoPartsFromTheParticlesUntilALookFindsThem) {
  Pushed pushed(2);
  pushed.recording.run(100'000);
  const glm::dvec2 untouched_m = place(pushed.recording.picture->shown(), 2);
  pushed.push();
  const glm::dvec2 shown_m = place(pushed.recording.picture->shown(), 0);
  const auto there_m = [&](std::size_t particle) {
    return place(pushed.recording.pages(), particle) + pushed.drift_m();
  };
  EXPECT_GT(glm::length(pushed.drift_m()), 4.9e-9);
  EXPECT_EQ(pushed.now().known[0], Known::Computed);
  EXPECT_EQ(place(pushed.recording.picture->shown(), 2), untouched_m) << "not touched, and not seen to drift";
  const double off_m = glm::distance(shown_m, there_m(0));
  EXPECT_GT(off_m, 0.5e-9);
  pushed.look();
  ASSERT_TRUE(pushed.now().newest.off_m);
  EXPECT_NEAR(*pushed.now().newest.off_m, off_m, 0.25e-9) << "the drift in the look";
  EXPECT_LT(glm::distance(place(pushed.recording.picture->shown(), 0), there_m(0)), 0.25e-9);
  EXPECT_EQ(pushed.now().known[0], Known::Measured);
  EXPECT_LT(pushed.now().age_s, 1.0);
  EXPECT_EQ(place(pushed.recording.picture->shown(), 2), untouched_m) << "outside of the look";
  pushed.recording.run(250'000);
  EXPECT_THAT(pushed.now().known, testing::Each(Known::Stale)) << "M62, after 246 s";
}

TEST(LivePicture, ComputesWhatTheServoDoesBitForBitWithoutDrift) {
  Pushed pushed(1);
  pushed.push();
  pushed.push();
  const RecordedSession& session = pushed.session();
  scene::SharedParticles known = session.particles->set;
  known.level.level = 2;
  const PictureState start{.shown = session.particles->pages,
                           .measured = session.particles->pages,
                           .seen_ns = std::vector<std::int64_t>(known.count, 0)};
  const auto computed = LivePicture::create(known, session.device, start);
  ASSERT_TRUE(computed) << computed.error().message;
  ASSERT_TRUE(replay(session, {}, [&](const ReplayedTick& tick) { (*computed)->add(tick.sample, {}); }));
  EXPECT_TRUE(std::equal((*computed)->shown().begin(), (*computed)->shown().end(), pushed.recording.pages().begin(),
                         pushed.recording.pages().end()));
  EXPECT_NE(pushed.recording.pages(), session.particles->pages) << "something was pushed";
}

TEST(LivePicture, IsLookedAtOnlyWhileTheTipIsLifted) {
  Pushed pushed(2);
  pushed.push();
  pushed.look(1050);
  ASSERT_TRUE(pushed.now().look_share);
  EXPECT_NEAR(*pushed.now().look_share, 10.0 / 33.0, 1.1 / 33.0);
  pushed.go({-0.028, 0.0}, 0.05, 0.3);
  pushed.go({-0.028, 0.0}, 0.001, 0.3);
  EXPECT_FALSE(pushed.now().look_share) << "the tip came down";
  EXPECT_EQ(pushed.now().looks, 1U);
  EXPECT_LT(pushed.now().newest.lines, 20U);
  pushed.look(500);
  EXPECT_EQ(count(pushed.session(), EventKind::LookedAgain), 1U) << "dropped by the servo";
  EXPECT_FALSE(pushed.now().look_share);
}

TEST(LivePicture, IsMeasuredAnewWhenAllParticlesArePutBack) {
  Pushed pushed(2);
  pushed.recording.run(100'000);
  pushed.push();
  pushed.recording.release(test::kMica, ScaleMode::Particles);
  pushed.recording.run(500);
  ++pushed.recording.put_back;
  pushed.recording.run(100);
  EXPECT_EQ(count(pushed.session(), EventKind::ParticlesPutBack), 1U);
  EXPECT_THAT(pushed.now().known, testing::Each(Known::Measured));
  EXPECT_EQ(place(pushed.recording.picture->shown(), 0), glm::dvec2(-80e-9, 0.0));
  EXPECT_LT(glm::length(pushed.drift_m()), 0.01e-9) << "the drift starts again";
  expect_same(pushed.session());
}

// Each session's picture is as it was live, even one that begins with an old picture.
TEST(LivePicture, IsRecordedAndDrawnAgainBitForBit) {
  Pushed pushed(2);
  pushed.recording.run(30'000);
  pushed.push();
  pushed.look();
  pushed.push();
  const std::vector<scene::ParticlePage> first_shown(pushed.recording.picture->shown().begin(),
                                                     pushed.recording.picture->shown().end());
  pushed.recording.choose(test::kGold, ScaleMode::Particles);
  pushed.push();
  pushed.look(2000);
  ASSERT_EQ(pushed.recording.sessions.size(), 2U);
  const support::ScratchFolder folder;
  for (const RecordedSession& session : pushed.recording.sessions) {
    expect_same(session);
    const std::string path = folder.file("level.afms");
    const RecordedSession loaded = saved_and_replayed(session, path);
    EXPECT_EQ(core::read_file(path)->substr(4, 1), "\x0e");
    const auto then = replay_particles(loaded, session.samples.back().time_ns);
    ASSERT_TRUE(then) << then.error().message;
    ASSERT_TRUE(then->picture);
    EXPECT_EQ(then->picture->level, 2U);
    if (&session == &pushed.recording.sessions.front()) {
      EXPECT_EQ(then->pages, first_shown);
    } else {
      const auto shown = pushed.recording.picture->shown();
      EXPECT_TRUE(std::equal(then->pages.begin(), then->pages.end(), shown.begin(), shown.end()));
      EXPECT_EQ(then->picture->known, pushed.now().known);
      EXPECT_EQ(then->picture->look_share, pushed.now().look_share);
      EXPECT_EQ(then->picture->age_s, pushed.now().age_s);
    }
  }
}

TEST(LivePicture, GoesOnWithOtherSettingsAndIsMeasuredAtAnotherLevel) {
  Pushed pushed(0);
  const auto choose = [&pushed](const scene::PushSettings& settings) {
    pushed.recording.choose(test::kMica, ScaleMode::Particles, settings);
    pushed.recording.run(500);
  };
  pushed.recording.run(100);
  EXPECT_EQ(pushed.recording.picture, nullptr);
  choose({.level = 3});
  pushed.recording.run(60'000);
  pushed.push();
  EXPECT_EQ(pushed.now().level, 2U);
  EXPECT_EQ(pushed.now().known[0], Known::Computed);
  const glm::dvec2 shown_m = place(pushed.recording.picture->shown(), 0);
  EXPECT_NE(shown_m, place(pushed.recording.pages(), 0));
  choose({.law = 2, .level = 3});
  EXPECT_EQ(pushed.recording.sessions.size(), 3U);
  EXPECT_EQ(pushed.now().known[0], Known::Computed);
  EXPECT_EQ(place(pushed.recording.picture->shown(), 0), shown_m);
  choose({.law = 2, .level = 2});
  EXPECT_EQ(pushed.now().level, 1U);
  EXPECT_THAT(pushed.now().known, testing::Each(Known::Measured));
  EXPECT_EQ(place(pushed.recording.picture->shown(), 0), place(pushed.recording.pages(), 0));
  choose({.law = 2});
  EXPECT_EQ(pushed.recording.picture, nullptr);
}

TEST(LivePicture, OfADamagedFileIsRefused) {
  Pushed pushed(2);
  pushed.recording.run(100);
  const RecordedSession& session = pushed.session();
  const support::ScratchFolder folder;
  const std::string path = folder.file("bad.afms");
  const auto refused = [&](const RecordedSession& bad) {
    EXPECT_TRUE(save_session(bad, path));
    const auto loaded = load_session(path);
    return loaded ? std::string() : loaded.error().message;
  };
  EXPECT_EQ(refused(session), "");
  RecordedSession bad = session;
  bad.particles->picture.seen_ns.pop_back();
  EXPECT_THAT(refused(bad), testing::HasSubstr("its picture is damaged"));
  bad = session;
  bad.particles->picture.seen_ns.front() = bad.samples.front().time_ns + 1;
  EXPECT_THAT(refused(bad), testing::HasSubstr("the age of its picture is impossible"));
  bad = session;
  bad.particles->set.level.level = 3;
  EXPECT_THAT(refused(bad), testing::HasSubstr("the level of the particles in the shared scene is impossible"));
}

}  // namespace live_picture_test
}  // namespace afm::servo
