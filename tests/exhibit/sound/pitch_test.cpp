// SPDX-License-Identifier: Apache-2.0
// Invariant: the pitch follows the hand's compressed scale
#include "exhibit/sound/pitch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "exhibit/sound/stream_clock.h"
#include "exhibit/sound/synthesizer.h"
#include "haptics/contact_model.h"
#include "support/paper_model.h"
#include "support/sound_analysis.h"

// Rows D01 to D12 of the reference cases.
namespace afm::exhibit {
namespace pitch_test {

constexpr double kSnapIn = 0.239752e-9, kPullOff = 1.399894e-9;  // mica, newtons

Ear ear_of_mica() { return {0.5 * kSnapIn, kPullOff}; }

TEST(Pitch, OfNotesIsTheEqualTemperament) {  // D01
  EXPECT_NEAR(note_hz(48), 130.8127827, 1e-9 * 130.8127827 + 5e-8);
  EXPECT_DOUBLE_EQ(note_hz(69), 440.0);
  EXPECT_NEAR(note_hz(84), 1046.502261, 1e-9 * 1046.502261 + 5e-7);
}

TEST(Pitch, OfAForceIsThatOfTheHandsCompressedScale) {  // D02
  const Ear ear = ear_of_mica();
  EXPECT_NEAR(ear.hz(0.0), 130.8127827, 1e-6 * 130.8);
  EXPECT_NEAR(ear.hz(-kSnapIn), 338.9870969, 1e-6 * 339.0);
  EXPECT_NEAR(ear.hz(-kPullOff), 1046.502261, 1e-6 * 1046.5);
  EXPECT_DOUBLE_EQ(ear.hz(kSnapIn), ear.hz(-kSnapIn)) << "a push sounds as high as a pull";
}

TEST(Pitch, RisesAudiblyWithOneJustNoticeableDifferenceOfForce) {  // D03
  const Ear ear = ear_of_mica();
  EXPECT_NEAR(test::cents(ear.hz(kPullOff), ear.hz(kPullOff / 1.07)), 76.95715432, 1e-6);
}

TEST(Pitch, StaysWithinAnOctaveAboveThePullOff) {
  const Ear ear = ear_of_mica();
  double last = 0;
  for (double force_n = 0; force_n < 1e-6; force_n = 1.3 * force_n + 1e-12) {
    EXPECT_GE(ear.hz(force_n), last);
    last = ear.hz(force_n);
  }
  EXPECT_NEAR(last, note_hz(96), 1e-9);
}

TEST(Pitch, OfThePapersMaterialsFollowsTheirTables) {
  const scene::SharedModel model = test::paper_model();
  for (const std::int32_t material : {test::kMica, test::kGold, test::kSiliconNitride}) {
    const auto tables = haptics::build_tables(model.materials[static_cast<std::size_t>(material)], {}).value();
    const Ear ear(*tables);
    EXPECT_NEAR(ear.hz(tables->figures.force_before_joc.si), note_hz(84), 1e-3 * note_hz(84)) << material;
    // F0 is half the snap-in
    const double snap_in =
        std::asinh(2.0) / std::asinh(2.0 * tables->figures.force_before_joc.si / tables->figures.force_after_jtc.si);
    EXPECT_NEAR(ear.hz(tables->figures.force_after_jtc.si), note_hz(48 + 36 * snap_in), 1e-3 * note_hz(60)) << material;
  }
}

TEST(Pitch, DistinguishesPullFromPushBySideAndEdge) {
  const Ear ear = ear_of_mica();
  EXPECT_LT(ear.tone(-kPullOff).side, -0.7);
  EXPECT_GT(ear.tone(kPullOff).side, 0.7);
  EXPECT_DOUBLE_EQ(ear.tone(0.0).side, 0.0);
  EXPECT_GT(ear.tone(0.0).level, 0.0) << "a force that is on is heard even where it is zero";
  EXPECT_DOUBLE_EQ(ear.tone(-kPullOff).edge, 0.0);
  EXPECT_GT(ear.tone(kPullOff).edge, 0.9);
}

TEST(SoundAnalysis, FindsAPitchWithinACent) {  // D04
  std::vector<double> sine(16384);
  for (std::size_t i = 0; i < sine.size(); ++i) {
    sine[i] = std::sin(2.0 * std::numbers::pi * 261.6255653 * static_cast<double>(i) / 48000.0);
  }
  EXPECT_LT(std::abs(test::cents(test::pitch_hz(sine, 48000.0), 261.6255653)), 1.0);
}

TEST(SoundAnalysis, FindsALevel) {  // case D06
  std::vector<double> sine(4800);
  for (std::size_t i = 0; i < sine.size(); ++i) {
    sine[i] = 0.25 * std::sin(2.0 * std::numbers::pi * 1000.0 * static_cast<double>(i) / 48000.0);
  }
  EXPECT_NEAR(test::amplitude(sine, 1000.0, 48000.0), 0.25, 1e-6);
  EXPECT_NEAR(20.0 * std::log10(test::amplitude(sine, 1000.0, 48000.0)), -12.04119983, 1e-6);
}

TEST(SoundTime, OfAnEventIsTheNearestSample) {  // D07
  EXPECT_EQ(sample_at(1'234'567'800, 200'000'000), 49659);
  EXPECT_EQ(sample_at(200'000'000, 200'000'000), 0);
  EXPECT_EQ(sample_at(0, 1'000'000'000), -48000);
  EXPECT_EQ(sample_at(86'400'000'000'000, 0), 86'400LL * 48'000) << "a day later no bit is lost";
}

TEST(SoundTime, OfTwoBuffersIsTenMilliseconds) {  // D08
  constexpr int kFrames = 256;
  EXPECT_NEAR(2.0 * kFrames / kSoundRateHz * 1e3, 10.66666667, 1e-8);
}

TEST(SoundTime, FollowsACardWhoseClockIsNotTheSystems) {
  StreamClock clock;
  std::int64_t now_ns = 5'000'000'000;
  double worst_ms = 0;
  constexpr double kFastCard = 1.0002;
  for (std::int64_t block = 0; block < 20'000; ++block) {
    const std::int64_t late_ns = block % 3 == 0 ? 3'000'000 : 0;  // requests that are sometimes late
    clock.asked(block * 256, now_ns + late_ns);
    if (block > 500) {
      const double heard_ns = static_cast<double>(sample_at(now_ns, clock.start_ns()) - block * 256) / 48e3 * 1e3;
      worst_ms = std::max(worst_ms, std::abs(heard_ns));
    }
    now_ns += static_cast<std::int64_t>(256e9 / 48e3 / kFastCard);
  }
  EXPECT_LT(worst_ms, 2.0);
  clock.asked(20'000 * 256, now_ns + 1'000'000'000);
  EXPECT_LT(std::abs(sample_at(now_ns + 1'000'000'000, clock.start_ns()) - 20'000 * 256), 48) << "after a pause";
}

TEST(Ear, HearsTheStatesOfALeverThatTaps) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const Ear ear(1e-10, 1e-9, 20e-9);
  const Tone free = ear.tone(0.0, {.amplitude_m = 20e-9, .phase_rad = 90.0 * kDegree});
  const Tone attractive = ear.tone(-0.5e-9, {.amplitude_m = 17e-9, .phase_rad = 135.0 * kDegree});
  const Tone repulsive = ear.tone(0.4e-9, {.amplitude_m = 18e-9, .phase_rad = 45.0 * kDegree});
  EXPECT_NEAR(free.hz, 440.0, 1e-9);
  EXPECT_NEAR(free.level, 1.0, 1e-12);
  EXPECT_NEAR(attractive.hz, 440.0 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(repulsive.hz, 440.0 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(attractive.level, 0.85, 1e-12);
  EXPECT_EQ(attractive.edge, 0.0);
  EXPECT_NEAR(repulsive.edge, 0.5, 1e-12);
  EXPECT_EQ(ear.tone(0.4e-9, scene::Swing{}), ear.tone(0.4e-9)) << "without a swing, the force";
  EXPECT_EQ(Ear(1e-10, 1e-9).tone(0.4e-9, {.amplitude_m = 1e-9}), ear.tone(0.4e-9)) << "a lever that does not tap";
}

TEST(Envelope, RisesWithoutAClick) {  // D09
  double largest = 0, last = 0;
  for (int i = 0; i <= 240; ++i) {
    const double now = rise(i / 48000.0, 0.005);
    largest = std::max(largest, now - last);
    last = now;
  }
  EXPECT_NEAR(largest, 0.006544797786, 1e-9);
  EXPECT_DOUBLE_EQ(last, 1.0);
}

TEST(Envelope, OfSidesKeepsThePower) {  // D12
  EXPECT_NEAR(pan(-0.5).left, 0.9238795325, 1e-9);
  EXPECT_NEAR(pan(-0.5).right, 0.3826834324, 1e-9);
  for (double side = -1.0; side <= 1.0; side += 0.125) {
    const Pan sides = pan(side);
    EXPECT_NEAR(sides.left * sides.left + sides.right * sides.right, 1.0, 1e-12);
  }
}

}  // namespace pitch_test
}  // namespace afm::exhibit
