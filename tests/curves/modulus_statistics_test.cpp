// SPDX-License-Identifier: Apache-2.0
#include "curves/modulus_statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace afm::curves {
namespace modulus_statistics_test {

using testing::HasSubstr;

// Lab case M08.
TEST(ModulusFigures, AreThoseOfRobustStatistics) {
  const ModulusFigures figures = modulus_figures({100e3, 1e3, 4e3, 2e3, 3e3});
  EXPECT_DOUBLE_EQ(figures.median_pa, 3e3);
  EXPECT_NEAR(figures.deviation_pa, 1482.6, 1e-6);
  EXPECT_NEAR(figures.geometric_mean_pa, 4742.88122, 5e-6);
  EXPECT_DOUBLE_EQ(modulus_figures({1.0, 2.0}).median_pa, 1.5);
}

TEST(ModulusHistograms, NameTheMedianInItsUnit) {
  const std::string svg = modulus_histograms({100e3, 1e3, 4e3, 2e3, 3e3});
  EXPECT_THAT(svg, HasSubstr("5 curves: median 3 kPa, deviation 1.483 kPa"));
  EXPECT_THAT(svg, HasSubstr("modulus E, kPa"));
  EXPECT_THAT(modulus_histograms({5e9, 5e9}), HasSubstr("modulus E, GPa"));
}

}  // namespace modulus_statistics_test
}  // namespace afm::curves
