// SPDX-License-Identifier: Apache-2.0
#include "panels/plot_scale.h"

#include <gmock/gmock.h>

#include <cmath>

namespace afm::render {
namespace plot_scale_test {

TEST(TickStep, IsOneTwoOrFiveTimesAPowerOfTen) {
  for (double range = 1e-6; range < 1e6; range *= 1.37) {
    const double step = tick_step(range, 6);
    EXPECT_LE(range / step, 6.0 * (1.0 + 1e-9));
    const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    EXPECT_THAT(mantissa, testing::AnyOf(testing::DoubleNear(1.0, 1e-9), testing::DoubleNear(2.0, 1e-9),
                                         testing::DoubleNear(5.0, 1e-9)))
        << range;
  }
}

TEST(TickText, HasTheDecimalsOfItsStepAndATypographicMinus) {
  EXPECT_EQ(tick_text(5.0, 5.0), "5");
  EXPECT_EQ(tick_text(-0.5, 0.5), "\u22120.5");
  EXPECT_EQ(tick_text(-0.25, 0.05), "\u22120.25");
  EXPECT_EQ(tick_text(1200.0, 200.0), "1200");
}

TEST(TickText, NeverWritesMinusZero) { EXPECT_EQ(tick_text(-1e-17, 0.5), "0.0"); }

TEST(ThinOut, KeepsTheEndsAndTheExtremesOfEveryColumn) {
  std::vector<glm::vec2> points;
  for (int i = 0; i < 10000; ++i) {
    const float x = 0.01F * static_cast<float>(i);
    points.push_back({x, i == 5550 ? 40.0F : std::sin(x)});
  }
  auto thin = points;
  thin_out(thin, 1.0F);
  EXPECT_LE(thin.size(), 400U);
  EXPECT_EQ(thin.front(), points.front());
  EXPECT_EQ(thin.back(), points.back());
  EXPECT_THAT(thin, testing::Contains(points[5550]));
}

TEST(ThinOut, KeepsTheOrderOfAPathThatTurnsBack) {
  std::vector<glm::vec2> points;
  for (int i = 0; i < 100; ++i) {
    points.push_back({static_cast<float>(i < 50 ? i : 99 - i), static_cast<float>(i)});
  }
  auto thin = points;
  thin_out(thin, 5.0F);
  ASSERT_GE(thin.size(), 20U);  // both passes of each of the 20 columns, which are 5 wide
  EXPECT_LT(thin.size(), points.size());
  EXPECT_EQ(thin.front(), points.front());
  EXPECT_EQ(thin.back(), points.back());
  for (std::size_t i = 0; i + 1 < thin.size(); ++i) {
    EXPECT_LT(thin[i].y, thin[i + 1].y);
  }
}

TEST(ThinOut, OfNothingIsNothing) {
  std::vector<glm::vec2> none;
  thin_out(none, 1.0F);
  EXPECT_TRUE(none.empty());
}

}  // namespace plot_scale_test
}  // namespace afm::render
