// SPDX-License-Identifier: Apache-2.0
// A look at particles whose scan presses too hard: what the servo moves, the picture shows, and a replay repeats.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "servo/live_picture.h"
#include "servo/recorded_servo.h"
#include "servo/session_file.h"
#include "support/particles/gold_particles.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace swept_look_test {

using physics::EventKind;

constexpr std::uint32_t kHardPn = 136;  // twice the gentle load

// A hand above three spheres, at a level, whose wall looks with a load.
class Looked {
 public:
  explicit Looked(std::uint32_t level) : recording(model_at(level)) {
    recording.choose(test::kMica, scene::ScaleMode::Particles);
    recording.scan = [this] { return lead(); };
    recording.run(200);
  }

  void look(std::uint32_t load, int ticks = 4000) {
    load_pn = load;
    ++recording.looks;
    recording.run(ticks);
  }
  const PictureNow& now() const { return recording.picture->now(); }
  RecordedSession& session() { return recording.sessions.back(); }
  std::size_t count(EventKind kind) {
    return static_cast<std::size_t>(std::count_if(session().events.begin(), session().events.end(),
                                                  [&](const scene::TipEvent& event) { return event.kind == kind; }));
  }

  Recording recording;
  std::uint32_t load_pn = 0;

 private:
  static scene::SharedModel model_at(std::uint32_t level) {
    scene::SharedModel model = test::model_with_particles();
    model.particles.level = {.level = level, .seed = 5};
    return model;
  }
  // Lead as sent by the wall.
  scene::ScanLead lead() const {
    const auto square = recording.picture ? recording.picture->square() : std::nullopt;
    if (!square || load_pn == 0) return {};
    return {.apex_xy_m = {square->middle_m.x, square->middle_m.y},
            .height_m = square->half_m,
            .hand = scene::ScanHand::Looks,
            .load_pn = load_pn};
  }
};

TEST(SweptLook, LosesWhatItPushesAwayUntilAGentleOneFindsIt) {
  for (const std::uint32_t level : {1U, 2U}) {
    Looked looked(level);
    const std::vector<scene::ParticlePage> start = looked.recording.pages();
    looked.look(kHardPn);
    EXPECT_EQ(looked.count(EventKind::LookedAgain), 1U) << level;
    EXPECT_GE(looked.count(EventKind::ParticleSwept), 1U) << level;
    EXPECT_NE(looked.recording.pages(), start) << level;
    EXPECT_EQ(looked.now().looks, 1U);
    EXPECT_NEAR(looked.now().newest.swept_above_n, 67.86e-12, 0.05e-12);
    EXPECT_FALSE(looked.now().newest.off_m);
    EXPECT_THAT(text_of(looked.now().newest), testing::HasSubstr("above the gentle one of 67.9 pN"));
    EXPECT_EQ(looked.now().known[looked.now().newest.particle], Known::Computed) << level;
    for (const scene::TipSample& sample : looked.session().samples) ASSERT_EQ(sample.hand_force_n, 0.0);
    const std::vector<scene::ParticlePage> swept = looked.recording.pages();
    looked.look(0);
    EXPECT_EQ(looked.recording.pages(), swept) << "gentle";
    EXPECT_EQ(looked.now().looks, 2U);
    EXPECT_EQ(looked.now().newest.swept_above_n, 0.0);
    EXPECT_TRUE(looked.now().newest.off_m) << level;
    expect_same(looked.session());
  }
}

TEST(SweptLook, WithAGentleLoadLeavesEveryBitAsALookWithoutOne) {
  Looked with(1), without(1);
  with.look(67);
  without.look(0);
  EXPECT_EQ(with.recording.pages(), without.recording.pages());
  EXPECT_EQ(with.count(EventKind::ParticleSwept), 0U);
  EXPECT_EQ(with.now().known, without.now().known);
  EXPECT_TRUE(with.now().newest.off_m);
}

TEST(SweptLook, IsTakenBackAndReplayedAndStoredBitForBit) {
  Looked looked(1);
  const std::vector<scene::ParticlePage> start = looked.recording.pages();
  looked.look(kHardPn);
  ASSERT_NE(looked.recording.pages(), start);
  ++looked.recording.taken_back;
  looked.recording.run(100);
  EXPECT_EQ(looked.recording.pages(), start);
  EXPECT_EQ(looked.count(EventKind::PushTakenBack), 1U);
  looked.look(kHardPn, 2000);  // look that lasts until the session ends
  const support::ScratchFolder folder;
  const std::string path = folder.file("swept.afms");
  ASSERT_TRUE(save_session(looked.session(), path));
  const auto loaded = load_session(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  expect_same(*loaded);
  const auto then = replay_particles(*loaded, loaded->samples.back().time_ns);
  ASSERT_TRUE(then) << then.error().message;
  EXPECT_TRUE(std::equal(then->pages.begin(), then->pages.end(), looked.recording.picture->shown().begin()));
  EXPECT_EQ(then->picture->known, looked.now().known);
}

// Another material in the middle of a look: its session begins with particles at rest.
TEST(SweptLook, EndsWithItsMaterial) {
  Looked looked(1);
  looked.look(kHardPn, 1800);
  looked.recording.choose(test::kGold, scene::ScaleMode::Particles);
  looked.recording.run(2500);
  ASSERT_EQ(looked.recording.sessions.size(), 2U);
  for (const RecordedSession& session : looked.recording.sessions) expect_same(session);
}

}  // namespace swept_look_test
}  // namespace afm::servo
