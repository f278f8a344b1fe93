// SPDX-License-Identifier: Apache-2.0
#include "input/idle_watch.h"

#include <gtest/gtest.h>

namespace afm::input {
namespace idle_watch_test {

using Change = IdleWatch::Change;
constexpr std::int64_t kSecond = 1'000'000'000;

TEST(IdleWatch, ChangesOnceEachWay) {
  IdleWatch watch(60 * kSecond);
  EXPECT_EQ(watch.update(false, 1000 * kSecond), Change::None) << "the start counts as use";
  EXPECT_EQ(watch.update(false, 1059 * kSecond), Change::None);
  EXPECT_EQ(watch.update(false, 1060 * kSecond), Change::WentAway);
  EXPECT_TRUE(watch.away());
  EXPECT_EQ(watch.update(false, 2000 * kSecond), Change::None);
  EXPECT_EQ(watch.update(true, 2001 * kSecond), Change::CameBack);
  EXPECT_FALSE(watch.away());
  EXPECT_EQ(watch.update(true, 2002 * kSecond), Change::None);
  EXPECT_EQ(watch.update(false, 2061 * kSecond), Change::None);
  EXPECT_EQ(watch.update(false, 2062 * kSecond), Change::WentAway);
}

}  // namespace idle_watch_test
}  // namespace afm::input
