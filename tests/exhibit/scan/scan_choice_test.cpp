// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_choice.h"

#include <gtest/gtest.h>

#include <string>

namespace afm::exhibit {
namespace scan_choice_test {

constexpr double kSide_m = 1e-6;
constexpr int kBeyondEveryEnd = 40;

struct Ends {
  ScanRow row;
  const char *lowest, *highest;
};
constexpr Ends kEnds[]{{ScanRow::Setpoint, "\u221250 nN", "50 nN"},
                       {ScanRow::Gain, "20/s", "20000/s"},
                       {ScanRow::Rate, "1 Hz", "100 Hz"},
                       {ScanRow::TipRadius, "1 nm", "200 nm"},
                       {ScanRow::Noise, "0 m", "2 nm"},
                       {ScanRow::Drift, "0 nm/s", "50 nm/s"}};

TEST(ScanChoiceSteps, EndWhereEachRowDoesAndBothEndsAreValid) {
  for (const Ends& ends : kEnds) {
    ScanChoice choice;
    step(choice, ends.row, -kBeyondEveryEnd, kSide_m);
    EXPECT_EQ(value_text(choice, ends.row), ends.lowest);
    EXPECT_TRUE(is_valid(choice)) << ends.lowest;
    EXPECT_FALSE(step(choice, ends.row, -1, kSide_m)) << ends.lowest;
    step(choice, ends.row, kBeyondEveryEnd, kSide_m);
    EXPECT_EQ(value_text(choice, ends.row), ends.highest);
    EXPECT_TRUE(is_valid(choice)) << ends.highest;
    EXPECT_FALSE(step(choice, ends.row, 1, kSide_m)) << ends.highest;
  }
}

TEST(ScanChoiceSteps, AreASeriesThatIsTheSameBackwards) {
  ScanChoice choice{.gain_per_s = 20};
  for (const char* next : {"50/s", "100/s", "200/s", "500/s", "1000/s"}) {
    ASSERT_TRUE(step(choice, ScanRow::Gain, 1, kSide_m));
    EXPECT_EQ(value_text(choice, ScanRow::Gain), next);
  }
  step(choice, ScanRow::Gain, -2, kSide_m);
  EXPECT_EQ(value_text(choice, ScanRow::Gain), "200/s");
}

}  // namespace scan_choice_test
}  // namespace afm::exhibit
