// SPDX-License-Identifier: Apache-2.0
// What is drawn beside the instrument so that it can be read, and the cue of a jump.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "exhibit/frame/film_strip.h"
#include "exhibit/scenery/wall_marks.h"
#include "exhibit/state/jump_cue.h"
#include "support/phrases.h"

namespace afm::exhibit {
namespace marks_test {

TEST(ScaleBar, IsRoundAndFillsItsPlaceAtEveryScale) {
  constexpr double kLongest = 0.46;
  double before_m = 1e9;
  for (double orders = -1.0; orders <= 11.0; orders += 0.003) {
    const double m_per_unit = std::pow(10.0, -orders);
    const ScaleBar bar = scale_bar(m_per_unit, kLongest);
    EXPECT_NEAR(bar.drawn * m_per_unit, bar.length_m, 1e-9 * bar.length_m);
    EXPECT_LE(bar.drawn, kLongest * (1.0 + 1e-9)) << orders;
    EXPECT_GT(bar.drawn, 0.399 * kLongest) << orders;
    const double leading = bar.length_m / std::pow(10.0, std::floor(std::log10(bar.length_m) + 1e-9));
    EXPECT_TRUE(std::abs(leading - 1.0) < 1e-6 || std::abs(leading - 2.0) < 1e-6 || std::abs(leading - 5.0) < 1e-6)
        << bar.length_m;
    EXPECT_LE(bar.length_m, before_m);
    before_m = bar.length_m;
  }
}

TEST(ScaleBar, SaysItsLengthInTheUnitThatFits) {
  EXPECT_EQ(scale_bar(31e-9, 0.46).text, "10 nm");
  EXPECT_EQ(scale_bar(1.0, 0.46).text, "200 mm");
  EXPECT_EQ(scale_bar(12e-6, 0.46).text, "5 \u00b5m");
  EXPECT_EQ(scale_bar(1e-9, 0.46).text, "200 pm");
  EXPECT_EQ(scale_bar(2.2e-3, 0.46).text, "1 mm");
}

scene::TipEvent event(physics::EventKind kind, std::int64_t time_ns) { return {.kind = kind, .time_ns = time_ns}; }

TEST(JumpCue, LastsASecondAndAHalfFromTheNewestJump) {
  using enum physics::EventKind;
  const std::vector<scene::TipEvent> events{event(JumpToContact, 1'000'000'000), event(JumpOffContact, 3'000'000'000)};
  EXPECT_FALSE(jump_cue(events, 999'999'999));
  ASSERT_TRUE(jump_cue(events, 1'200'000'000));
  EXPECT_EQ(jump_cue(events, 1'200'000'000)->kind, JumpToContact);
  EXPECT_NEAR(jump_cue(events, 1'200'000'000)->age_s, 0.2, 1e-9);
  EXPECT_TRUE(jump_cue(events, 2'400'000'000));
  EXPECT_FALSE(jump_cue(events, 2'600'000'000));
  ASSERT_TRUE(jump_cue(events, 3'000'000'000));
  EXPECT_EQ(jump_cue(events, 3'000'000'000)->kind, JumpOffContact);
  EXPECT_FALSE(jump_cue({}, 5));
}

// A frame that takes longer than the cue must not take the jump from the hand.
TEST(JumpCue, HasBegunThoughNoFrameHasShownIt) {
  using enum physics::EventKind;
  JumpCues cues;
  EXPECT_FALSE(cues.begun_ns(0));
  cues.add(event(JumpToContact, 1'000'000'000));
  EXPECT_FALSE(cues.begun_ns(999'999'999));
  EXPECT_FALSE(cues.at(9'000'000'000));
  EXPECT_EQ(cues.begun_ns(9'000'000'000), 1'000'000'000);
  cues.add(event(JumpOffContact, 1'100'000'000));  // delayed until the other one has been shown
  EXPECT_EQ(cues.begun_ns(1'399'999'999), 1'000'000'000);
  EXPECT_EQ(cues.begun_ns(9'000'000'000), 1'400'000'000);
}

TEST(JumpCue, OfATipThatChattersChangesThreeTimesASecondAndEndsWithTheLastJump) {
  using enum physics::EventKind;
  std::vector<scene::TipEvent> events;
  for (int i = 0; i < 200; ++i) events.push_back(event(i % 2 == 0 ? JumpToContact : JumpOffContact, i * 25'000'000LL));
  std::vector<std::int64_t> began_ns;
  double before_s = kCueSeconds;
  for (std::int64_t now_ns = 0; now_ns < 5'400'000'000; now_ns += 5'000'000) {
    const auto cue = jump_cue(events, now_ns);
    if (cue && cue->age_s < before_s) began_ns.push_back(now_ns);
    before_s = cue ? cue->age_s : kCueSeconds;
  }
  ASSERT_GT(began_ns.size(), 10U);
  for (std::size_t i = 3; i < began_ns.size(); ++i) EXPECT_GE(began_ns[i] - began_ns[i - 3], 1'000'000'000);
  ASSERT_TRUE(jump_cue(events, 5'300'000'000));
  EXPECT_EQ(jump_cue(events, 5'300'000'000)->kind, JumpOffContact);
}

TEST(JumpCue, ClosesInOnAJumpToContactAndSpreadsFromAJumpOff) {
  using enum physics::EventKind;
  const auto ring = [](physics::EventKind kind, double age_s) { return cue_ring({.kind = kind, .age_s = age_s}); };
  for (double age_s = 0.0; age_s + 0.05 <= kRingSeconds; age_s += 0.05) {
    const CueRing in = ring(JumpToContact, age_s), in_later = ring(JumpToContact, age_s + 0.05);
    const CueRing off = ring(JumpOffContact, age_s), off_later = ring(JumpOffContact, age_s + 0.05);
    EXPECT_LT(in_later.radius, in.radius);
    EXPECT_GT(off_later.radius, off.radius);
    EXPECT_LT(in_later.color.b, in.color.b);
    EXPECT_LT(off_later.color.r, off.color.r);
  }
  for (const double age_s : {kRingSeconds, kCueSeconds}) {
    EXPECT_EQ(ring(JumpToContact, age_s).color, glm::vec3(0.0F));
  }
}

TEST(JumpCue, KeepsTheForceOfTheJumpWhileTheTipMovesOn) {
  using enum physics::EventKind;
  scene::TipEvent in = event(JumpToContact, 1'000'000'000), off = event(JumpOffContact, 1'100'000'000);
  in.force_before_n = -0.1e-9;
  in.force_after_n = -0.407e-9;
  off.force_before_n = -10e-9;
  off.force_after_n = 0;
  JumpCues cues;
  cues.add(in);
  cues.add(off);  // delayed until the other one has been seen
  EXPECT_EQ(cue_text(cues.at(1'200'000'000).value(), test::english()), "snap \u22120.41 nN");
  EXPECT_EQ(cue_text(cues.at(1'399'000'000).value(), test::english()), "snap \u22120.41 nN");
  EXPECT_EQ(cue_text(cues.at(1'500'000'000).value(), test::english()), "pull-off \u221210.00 nN");
  EXPECT_EQ(cue_text(cues.at(2'800'000'000).value(), test::english()), "pull-off \u221210.00 nN");
}

// Both jumps of a tapping lever have the ring, which also triggers the pulse of a headset's controller.
TEST(JumpCue, IsThatOfALeverThatTapsToo) {
  using enum physics::EventKind;
  scene::TipEvent in = event(JumpToRepulsion, 1'000'000'000), out = event(JumpToAttraction, 2'000'000'000);
  in.force_before_n = -0.55e-9;
  in.force_after_n = 0.31e-9;
  out.force_after_n = -0.39e-9;
  JumpCues cues;
  cues.add(in);
  EXPECT_EQ(cues.begun_ns(1'100'000'000), 1'000'000'000);
  EXPECT_EQ(cue_text(cues.at(1'100'000'000).value(), test::english()), "repulsive +0.31 nN");
  cues.add(event(Slip, 1'500'000'000));
  cues.add(out);
  EXPECT_EQ(cues.begun_ns(2'100'000'000), 2'000'000'000);
  EXPECT_EQ(cue_text(cues.at(2'100'000'000).value(), test::english()), "attractive \u22120.39 nN");
  EXPECT_LT(cue_ring({.kind = JumpToRepulsion, .age_s = 0.5}).radius,
            cue_ring({.kind = JumpToRepulsion, .age_s = 0.1}).radius);
  EXPECT_GT(cue_ring({.kind = JumpToAttraction, .age_s = 0.5}).radius,
            cue_ring({.kind = JumpToAttraction, .age_s = 0.1}).radius);
}

TEST(FilmStrip, PutsReducedFramesInRows) {
  std::vector<render::Image> frames;
  for (std::uint8_t i = 0; i < 3; ++i) {
    render::Image image{.width = 4, .height = 2, .rgba = std::vector<std::uint8_t>(32)};
    for (std::size_t k = 0; k < 32; ++k) image.rgba[k] = static_cast<std::uint8_t>(40 * i + (k / 4) % 2 * 10);
    frames.push_back(image);
  }
  const render::Image strip = film_strip(frames, 2, 2);
  ASSERT_EQ(strip.width, 4U);
  ASSERT_EQ(strip.height, 2U);
  const auto red = [&](std::size_t x, std::size_t y) { return strip.rgba[4 * (y * 4 + x)]; };
  EXPECT_EQ(red(0, 0), 5);
  EXPECT_EQ(red(2, 0), 45);
  EXPECT_EQ(red(1, 1), 85);
  EXPECT_EQ(red(2, 1), 0) << "no fourth frame";
}

}  // namespace marks_test
}  // namespace afm::exhibit
