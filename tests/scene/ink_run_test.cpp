// SPDX-License-Identifier: Apache-2.0
// Sets with ink: what is read, what is refused, and the scripted hand that writes.
#include "scene/samples/ink_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/whole_file.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/shared_segment.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::scene {
namespace ink_run_test {

using testing::HasSubstr;

const std::string kFile = support::source("assets/particles/write-ink.toml");

std::string refusal(const std::string& from, const std::string& to) {
  std::string text = core::read_file(kFile).value();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  const support::ScratchFolder folder;
  const auto set = load_particle_set(folder.write("set.toml", text.replace(at, from.size(), to)));
  return set ? "accepted" : set.error().message;
}

TEST(InkRun, DotsAndLinesOfTheShippedSetAreThoseOfTheFormulas) {
  const auto set = load_particle_set(kFile);
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_TRUE(set->ink);
  EXPECT_EQ(set->sources.size(), 7U);
  EXPECT_EQ(set->setup.tip.radius.si, 20e-9);
  EXPECT_EQ(set->setup.springs.normal.si, 0.1);
  EXPECT_EQ(set->ink->surface_tension.si, 0.0728);
  const InkRun run = play_ink(*set, physics::Frequency(1000.0));
  ASSERT_EQ(run.moves.size(), set->moves.size());
  const double square_m2 = run.spacing.si * run.spacing.si;
  EXPECT_NEAR(run.moves[0].covered.si, 2.16e-14, 0.01 * 2.16e-14 + square_m2) << "a dot of a second";
  EXPECT_NEAR(run.moves[0].radius.si, 82.9e-9, 0.1e-9);
  EXPECT_FALSE(run.moves[1].touches && run.moves[2].touches);
  EXPECT_NEAR(run.moves[4].width.si, 216e-9, 0.05 * 216e-9);
  EXPECT_NEAR(run.moves[4].by_speed.si, 216e-9, 1e-12);
  EXPECT_NEAR(run.moves[8].width.si, 54e-9, 0.06 * 54e-9) << "four times as fast";
  EXPECT_NEAR(run.moves[11].radius.si, 185.4e-9, 0.1e-9) << "five seconds";
  EXPECT_EQ(run.lost.si, 0.0);
  double sum_m2 = 0.0;
  for (const InkedMove& move : run.moves) sum_m2 += move.covered.si;
  EXPECT_NEAR(sum_m2, run.covered.si, 1e-20);
  double image_m2 = 0.0;
  for (const double height_m : run.image.channels.front().values) image_m2 += height_m > 0.0 ? square_m2 : 0.0;
  EXPECT_NEAR(image_m2, run.covered.si, 1e-3 * run.covered.si);
}

TEST(InkRun, RefusesWithKeyAndReason) {
  EXPECT_THAT(refusal("value = 1e5", "value = -1.0"), HasSubstr("molecules_per_s"));
  EXPECT_THAT(refusal("value = 0.216", "value = 1e9"), HasSubstr("footprint_nm2"));
  EXPECT_THAT(refusal("\"2 nm\"", "\"0 nm\""), HasSubstr("thickness"));
  EXPECT_THAT(refusal("[start]", "[sample]\nname = 1\n[start]"), HasSubstr("leave this or [ink] out"));
  EXPECT_THAT(refusal("\"72.8 mN/m\"", "\"-1 mN/m\""), HasSubstr("surface_tension"));
  EXPECT_THAT(refusal("\"0.1 N/m\"", "\"-1 N/m\""),
              HasSubstr("lever.normal_spring: normal spring -1 N/m is not within"));
  EXPECT_THAT(refusal("[lever]\n", "[lever]\nlateral_spring = 1\n"), HasSubstr("lateral_spring"));
  EXPECT_THAT(refusal("surface_tension", "# surface_tension"), HasSubstr("surface_tension"));
}

TEST(InkRun, NeedsNoTipForTheScriptedHandAlone) {
  std::string text = core::read_file(kFile).value();
  const auto without = [&](const std::string& from, const std::string& to) {
    const std::size_t begin = text.find(from);
    text.erase(begin, text.find(to, begin) - begin);
  };
  without("[tip]", "[ink]");
  without("surface_tension", "\n\n[start]");
  const support::ScratchFolder folder;
  const auto set = load_particle_set(folder.write("set.toml", text));
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_EQ(set->ink->surface_tension.si, 0.0);
  EXPECT_NEAR(play_ink(*set, physics::Frequency(1000.0)).moves[4].width.si, 216e-9, 0.05 * 216e-9);
  EXPECT_FALSE(validate(shared_particles(*set))) << "no hand can write with it";
}

TEST(InkRun, ARecordedSetIsTheShippedOneOrHasItsNumbers) {
  const auto set = load_particle_set(kFile);
  ASSERT_TRUE(set);
  auto shared = std::make_unique<SharedParticles>(shared_particles(*set));
  EXPECT_TRUE(validate(*shared));
  EXPECT_EQ(recorded_set(*shared, support::source("assets")).title, set->title);
  shared->ink.thickness_m = 3e-9;
  const ParticleSet other = recorded_set(*shared, support::source("assets"));
  EXPECT_EQ(other.title, "Recorded ink");
  EXPECT_EQ(shared_particles(other), *shared);
}

}  // namespace ink_run_test
}  // namespace afm::scene
