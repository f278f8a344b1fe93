// SPDX-License-Identifier: Apache-2.0
// Sets with a soft sample: what is read, what is refused, and the scripted hand on it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "core/whole_file.h"
#include "scene/samples/hand_script.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/scratch_run.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::scene {
namespace soft_sample_test {

using testing::HasSubstr;

const std::string kFile = support::source("assets/particles/scratch-pmma.toml");

std::string changed(const std::string& from, const std::string& to) {
  std::string text = core::read_file(kFile).value();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
  const support::ScratchFolder folder;
  const auto set = load_particle_set(folder.write("set.toml", text));
  if (set) return "accepted";
  EXPECT_EQ(set.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_EQ(set.error().message.find('\n'), std::string::npos);
  return set.error().message;
}

TEST(SoftSample, TheShippedOneHasTheNumbersOfTheCases) {
  const auto set = load_particle_set(kFile);
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_TRUE(set->soft);
  EXPECT_EQ(set->soft->name, "PMMA");
  EXPECT_TRUE(set->particles.empty());
  EXPECT_NEAR(set->soft->surface.reduced_modulus.si, 3436812637.4, 10.0);
  EXPECT_NEAR(set->soft->surface.hardness.si, 0.3e9, 1.0);
  EXPECT_EQ(set->soft->surface.pile_up_share, 0.7);
  EXPECT_NEAR(largest_load(*set).si, 100e-9, 1e-15);
  EXPECT_EQ(set->sources.size(), 11U);
  for (const SourcedValue& value : set->sources) EXPECT_FALSE(value.source.empty()) << value.key;
  // no recording of particles is mistaken for it
  const auto shared = std::make_unique<const SharedParticles>(shared_particles(*set));
  EXPECT_EQ(shared->count, 0U);
}

// Every stroke of the letters marks, but no path between two of them.
TEST(SoftSample, WritesLetters) {
  const auto set = load_particle_set(support::source("assets/particles/write-afm.toml"));
  ASSERT_TRUE(set) << set.error().message;
  const ScratchRun run = play_scratch(*set, physics::Frequency(1000.0), 2);
  EXPECT_GE(run.least_margin_j, -1e-12 * run.moves.back().end.tick.given.si);
  int strokes = 0;
  for (std::size_t i = 1; i < set->moves.size(); ++i) {
    const bool down = set->moves[i - 1].to.z.si < 0.0 && set->moves[i].to.z.si < 0.0;
    const bool up = set->moves[i - 1].to.z.si > 0.0 && set->moves[i].to.z.si > 0.0;
    EXPECT_FALSE(up && run.moves[i].marks) << i;
    if (!down) continue;
    ++strokes;
    EXPECT_GT(run.moves[i].section.depth.si, 3e-9) << i;
    EXPECT_LT(run.moves[i].section.depth.si, 6e-9) << i;
  }
  EXPECT_EQ(strokes, 10);
  // the deepest place of the image is where two strokes cross
  const auto& heights = run.image.channels.at(0).values;
  EXPECT_EQ(heights.size(), run.image.columns * run.image.rows);
  EXPECT_LT(*std::min_element(heights.begin(), heights.end()), -7e-9);
  // row 0 is the top one: the bar of the F is nearer to it than its foot
  const double left_m = run.image.x_offset_m, top_m = run.image.y_offset_m + run.image.height_m;
  const auto at = [&](double x_m, double y_m) {
    const double pixel_m = run.image.width_m / static_cast<double>(run.image.columns);
    const auto column = static_cast<std::size_t>((x_m - left_m) / pixel_m);
    const auto row = static_cast<std::size_t>((top_m - y_m) / pixel_m);
    return heights.at(row * run.image.columns + column);
  };
  EXPECT_LT(at(10e-9, 120e-9), -3e-9);
  EXPECT_EQ(at(10e-9, 0.0), 0.0);
}

TEST(SoftSample, IsRefusedWithTheReason) {
  EXPECT_THAT(refusal(changed("value = \"0.3 GPa\"", "value = \"0.3 nm\"")), HasSubstr("hardness"));
  EXPECT_THAT(refusal(changed("value = \"0.3 GPa\"", "value = \"1 GPa\"")), HasSubstr("springs back as a whole"));
  EXPECT_THAT(refusal(changed("value = 0.7", "value = 1.7")), HasSubstr("pile_up_share"));
  EXPECT_THAT(refusal(changed("value = 0.38", "value = 0.7")), HasSubstr("sample_poisson_ratio"));
  EXPECT_THAT(refusal(changed("value = \"165 GPa\"", "value = \"0 GPa\"")), HasSubstr("tip_modulus"));
  EXPECT_THAT(refusal(changed("value = 20,", "value = 80,")),
              HasSubstr("half_angle_deg: half angle 80 deg is not within 4.58 deg"));
  EXPECT_THAT(refusal(changed("radius = { value = \"20 nm\"", "radius = { value = \"20 um\"")),
              HasSubstr("tip.radius"));
  EXPECT_THAT(refusal(changed("normal_spring = { value = \"1 N/m\"", "normal_spring = { value = \"0 N/m\"")),
              HasSubstr("normal_spring"));
  EXPECT_THAT(refusal(changed("[start]", "[[particle]]\nx = \"0 nm\"\ny = \"0 nm\"\n\n[start]")),
              HasSubstr("particle: a soft sample is scratched, and has no particles"));
  EXPECT_THAT(refusal(changed("z = \"-100 nm\"", "z = \"-200 nm\"")), HasSubstr("the lever presses with up to 200 nN"));
  EXPECT_THAT(refusal(changed("x = \"100 nm\"", "x = \"2 um\"")), HasSubstr("marks a square of 1.19 um at most"));
  EXPECT_THAT(refusal(changed("pile_up_share", "pileup_share")), HasSubstr("pileup_share"));
}

TEST(SoftSample, TheScriptedHandDigsLessInEachPass) {
  const auto set = load_particle_set(kFile);
  ASSERT_TRUE(set) << set.error().message;
  const physics::Frequency rate(1000.0);
  const ScratchRun run = play_scratch(*set, rate, 11);
  ASSERT_EQ(run.moves.size(), set->moves.size());
  EXPECT_EQ(run.samples.size(), 11U);
  EXPECT_EQ(static_cast<double>(run.ticks), all_ticks(*set, rate));
  EXPECT_GE(run.least_margin_j, -1e-12 * run.moves.back().end.tick.given.si);
  // moves 1, 5 and 9 are the passes, 13 the one with half the load
  const auto& first = run.moves[1];
  EXPECT_TRUE(first.marks);
  EXPECT_NEAR(first.load.si, 93.8e-9, 1e-9);
  EXPECT_NEAR(first.depth.si, 5.9e-9, 0.4e-9);
  EXPECT_NEAR(first.lateral.si, 35e-9, 4e-9);
  const double second = (run.moves[5].section.depth - first.section.depth).si;
  const double third = (run.moves[9].section.depth - run.moves[5].section.depth).si;
  EXPECT_GT(first.section.depth.si, second);
  EXPECT_GT(second, third);
  EXPECT_GT(third, 0.0);
  EXPECT_FALSE(run.moves[3].marks);
  EXPECT_EQ(run.moves[3].section.depth.si, 0.0);
  EXPECT_EQ(run.moves[2].section.depth.si, 0.0);
  EXPECT_LT(run.moves[13].section.depth.si, 0.6 * first.section.depth.si);
  EXPECT_LT(run.moves[13].section.width.si, 0.85 * first.section.width.si);
}

}  // namespace soft_sample_test
}  // namespace afm::scene
