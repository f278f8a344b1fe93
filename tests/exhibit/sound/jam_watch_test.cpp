// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/jam_watch.h"

#include <gmock/gmock.h>

#include <string>

#include "core/clock.h"
#include "exhibit/sound/narrator.h"
#include "pushing_bench.h"
#include "support/phrases.h"

namespace afm::exhibit {
namespace jam_watch_test {

using testing::HasSubstr;

constexpr double kGivesN = 0.25e-9;

// Presses particle 2 sideways by times the force at which it would give.
scene::TipPush press(double times, std::uint64_t digest = 7) {
  scene::TipPush push;
  push.digest = digest;
  push.lateral_n = {-0.6 * times * kGivesN, 0.8 * times * kGivesN};
  push.normal_n = 1.03 * times * kGivesN;
  push.threshold_n = kGivesN;
  push.particle = 1;
  push.met = 1;
  return push;
}

TEST(JamWatch, NoticesAPressThatMovesNothingOnce) {
  JamWatch watch;
  EXPECT_FALSE(watch.add(press(0.9)));
  EXPECT_FALSE(watch.add(press(2.9))) << "a chain may yield yet";
  const auto held_n = watch.add(press(3.1));
  ASSERT_TRUE(held_n);
  EXPECT_NEAR(*held_n, 3.1 * kGivesN, 1e-18);
  EXPECT_FALSE(watch.add(press(3.2)));
  EXPECT_FALSE(watch.add(press(1.0)));
  EXPECT_TRUE(watch.add(press(4.0))) << "another press";
}

TEST(JamWatch, IgnoresWhatMovesAndWhatIsNoPush) {
  JamWatch watch;
  for (std::uint64_t digest = 1; digest < 9; ++digest) EXPECT_FALSE(watch.add(press(4.0, digest)));
  EXPECT_TRUE(watch.add(press(4.0, 8))) << "it has stopped";
  JamWatch fresh;
  scene::TipPush pull = press(4.0);
  pull.normal_n = -pull.normal_n;
  scene::TipPush off = press(4.0);
  off.met = 0;
  scene::TipPush none = press(4.0);
  none.particle = scene::kNoParticle;
  for (const scene::TipPush& push : {pull, off, none}) {
    for (int frame = 0; frame < 3; ++frame) EXPECT_FALSE(fresh.add(push));
  }
}

// Under a hand: a sphere that is pushed into the notch of two pinned ones is jammed, one without them is not.
TEST(JamWatch, HearsASphereBetweenTwoThatArePinned) {
  for (const bool notch : {true, false}) {
    scene::SharedModel model = test::paper_model();
    model.particles = test::particles_at({{-80e-9, 0.0}, {-30e-9, 25.5e-9}, {-30e-9, -25.5e-9}, {80e-9, 100e-9}});
    for (const int beside : {1, 2}) {
      scene::SharedParticle& pinned = model.particles.particles.at(static_cast<std::size_t>(beside));
      pinned.pinned = 1;
      if (!notch) pinned.y_m *= 6.0;
    }
    test::PushingBench bench(1000.0, model);
    JamWatch watch;
    bench.put_down();
    int jams = 0;
    bench.send(-0.012, 0.0, 0.001, 2.0);
    for (int frame = 0; frame < 140; ++frame) {
      for (int tick = 0; tick < 16; ++tick) bench.tick();
      if (watch.add(*bench.renderer.tip_push())) ++jams;
    }
    EXPECT_EQ(jams, notch ? 1 : 0);
    EXPECT_EQ(bench.state().fault, scene::FaultCode::None);
  }
}

// The caption has the force, which the phrase needs.
TEST(JamWatch, IsSaidWithItsForce) {
  std::string said;
  const core::MonotonicClock clock;
  int signals = 0;
  Narrator narrator(
      test::english(), {"Mica"}, clock, [&](const Heard&) { ++signals; },
      [&](const SpeechText& text) { said = text.text; });
  narrator.happened(HeardEvent::ParticleJammed, 0, 1.4e-9);
  EXPECT_EQ(signals, 1);
  EXPECT_THAT(said, HasSubstr("Jammed"));
  EXPECT_THAT(narrator.caption(), HasSubstr("1.4 nN"));
}

}  // namespace jam_watch_test
}  // namespace afm::exhibit
