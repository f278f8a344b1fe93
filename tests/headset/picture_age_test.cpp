// SPDX-License-Identifier: Apache-2.0
// Invariant: a runtime that stalls a frame cannot keep the force on
#include "app/display/picture_age.h"

#include <gtest/gtest.h>

namespace afm::app {
namespace picture_age_test {

constexpr std::int64_t kMs = 1'000'000;

// Shows pictures at regular intervals, the last one at the end.
std::int64_t show(PictureAge& age, int pictures, std::int64_t every_ms, std::int64_t from_ms = 0) {
  for (int i = 0; i < pictures; ++i) age.shown((from_ms + i * every_ms) * kMs);
  return from_ms + (pictures - 1) * every_ms;
}

TEST(PictureAge, MayBeAQuarterOfASecond) {
  PictureAge age;
  const std::int64_t last_ms = show(age, 90, 11);
  EXPECT_FALSE(age.stands_still((last_ms + 249) * kMs));
  EXPECT_TRUE(age.stands_still((last_ms + 250) * kMs));
}

TEST(PictureAge, OfASlowMachineMayBeTwiceAsLongAsItsPicturesTake) {
  PictureAge age;
  const std::int64_t last_ms = show(age, 9, 300);
  EXPECT_FALSE(age.stands_still((last_ms + 599) * kMs));
  EXPECT_TRUE(age.stands_still((last_ms + 600) * kMs));
}

TEST(PictureAge, IsJudgedByTheNewestPicturesAlone) {
  PictureAge age;
  const std::int64_t slow_ms = show(age, 9, 300);
  const std::int64_t last_ms = show(age, 9, 11, slow_ms + 11);
  EXPECT_TRUE(age.stands_still((last_ms + 250) * kMs));
}

// However long the device hung before.
TEST(PictureAge, IsNeverMoreThanTwoSeconds) {
  PictureAge age;
  const std::int64_t last_ms = show(age, 2, 60'000);
  EXPECT_FALSE(age.stands_still((last_ms + 1999) * kMs));
  EXPECT_TRUE(age.stands_still((last_ms + 2000) * kMs));
}

TEST(PictureAge, IsNoneWhileNobodySeesAPicture) {
  PictureAge age;
  EXPECT_FALSE(age.stands_still(1'000 * kMs));
  show(age, 2, 11);
  age.unseen();
  EXPECT_FALSE(age.stands_still(10'000 * kMs));
  age.shown(10'000 * kMs);
  EXPECT_TRUE(age.stands_still(10'250 * kMs)) << "the time without a picture is not that of a slow one";
}

}  // namespace picture_age_test
}  // namespace afm::app
