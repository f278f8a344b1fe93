// SPDX-License-Identifier: Apache-2.0
#include "exhibit/cluster/shared_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "exhibit/cluster/wall_history.h"
#include "exhibit/state/particles_now.h"

namespace shared_picture_test {

using namespace afm;
using namespace afm::cluster;
using namespace afm::exhibit;

std::vector<std::byte> saved(const WallHistory& history) {
  return save_history(history.journal, history.cycles, history.friction, history.edits, history.scan, history.pages,
                      history.push, history.score, history.plan, history.tiles, history.known, history.picture);
}

TEST(SharedPicture, IsThatOfTheMachineOnWhichTheParticlesArePushed) {
  const servo::PictureNow shown{.level = 2,
                                .known = {servo::Known::Measured, servo::Known::Computed, servo::Known::Stale},
                                .particle = 1,
                                .age_s = 12.5,
                                .doubt_m = 1e-9,
                                .all_measured = false,
                                .look_share = 0.25,
                                .looks = 3,
                                .newest = {.particle = 2, .lines = 30, .off_m = 4e-9, .swept_above_n = 6.8e-11}};
  const ParticlesNow now{.picture = &shown, .look_load_n = 3.4e-11};
  WallHistory here(1);
  for (std::uint32_t i = 0; i < 3; ++i) {
    here.apply(JournalRecord(
        cluster::PoseRecord{.particle = i, .known = static_cast<std::uint32_t>(known_of(now, i)), .pose = {}}));
  }
  EXPECT_FALSE(picture_of(here, 3)) << "level 0";
  here.apply(JournalRecord(record_of(now)));
  const auto there = load_history(saved(here), 1);
  ASSERT_TRUE(there);
  const auto picture = picture_of(*there, 3);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->level, shown.level);
  EXPECT_EQ(picture->known, shown.known);
  EXPECT_EQ(picture->particle, shown.particle);
  EXPECT_EQ(picture->age_s, shown.age_s);
  EXPECT_EQ(picture->doubt_m, shown.doubt_m);
  EXPECT_EQ(picture->all_measured, shown.all_measured);
  EXPECT_EQ(picture->look_share, shown.look_share);
  EXPECT_EQ(picture->looks, shown.looks);
  EXPECT_EQ(picture->newest.particle, shown.newest.particle);
  EXPECT_EQ(picture->newest.lines, shown.newest.lines);
  EXPECT_EQ(picture->newest.off_m, shown.newest.off_m);
  EXPECT_EQ(picture->newest.swept_above_n, shown.newest.swept_above_n);
  EXPECT_EQ(there->picture.look_load_n, now.look_load_n);
  EXPECT_FALSE(picture_of(*there, 1)) << "of more particles than the set has";
  here.apply(JournalRecord(record_of({})));
  EXPECT_FALSE(picture_of(here, 3));
  const auto refused = [&](auto&& spoil) {
    cluster::PictureRecord record = record_of(now);
    spoil(record);
    return !JournalRecord(record).valid();
  };
  EXPECT_FALSE(refused([](cluster::PictureRecord&) {}));
  EXPECT_TRUE(refused([](cluster::PictureRecord& r) { r.level = 3; }));
  EXPECT_TRUE(refused([](cluster::PictureRecord& r) { r.particle = scene::kMaxParticles; }));
  EXPECT_TRUE(refused([](cluster::PictureRecord& r) { r.looking = 2; }));
  EXPECT_TRUE(refused([](cluster::PictureRecord& r) { r.age_s = std::nan(""); }));
  EXPECT_FALSE(JournalRecord(cluster::PoseRecord{.known = 3}).valid());
  WallHistory spoilt = *there;
  spoilt.known.pop_back();
  EXPECT_FALSE(load_history(saved(spoilt), 1));
}

}  // namespace shared_picture_test
