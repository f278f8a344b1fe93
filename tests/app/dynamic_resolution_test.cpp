// SPDX-License-Identifier: Apache-2.0
#include "app/options/dynamic_resolution.h"
#include "app/demo/demo_size.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "exhibit/words/phrases.h"
#include "render/context.h"
#include "render/renderer.h"

namespace afm::app {
namespace dynamic_resolution_test {

constexpr double kBudget_ms = 40.0;

// Duration of a frame: a part independent of the pixels, and one in proportion to them.
struct Cost {
  double fixed_ms = 2.0;
  double pixels_ms = 100.0;  // at full resolution with one sample
  double four_samples = 2.3;

  double of(const render::FrameQuality& quality) const {
    return fixed_ms + pixels_ms * quality.scale * quality.scale * (quality.samples == 4 ? four_samples : 1.0);
  }
};

int run(DynamicResolution& budget, const Cost& cost, int frames) {
  int changes = 0;
  for (int i = 0; i < frames; ++i) changes += budget.add(cost.of(budget.quality())) ? 1 : 0;
  return changes;
}

TEST(FrameBudgetTest, LeavesAFrameAloneThatFits) {
  DynamicResolution budget(kBudget_ms, 4);
  EXPECT_EQ(run(budget, {.pixels_ms = 15.0}, 10'000), 0);
  EXPECT_EQ(budget.quality(), (render::FrameQuality{.scale = 1.0, .samples = 4}));
}

TEST(FrameBudgetTest, HoldsTheBudgetWithinFortyFramesAndStaysThere) {
  for (const double pixels_ms : {18.0, 25.0, 40.0, 60.0, 150.0}) {
    const Cost cost{.pixels_ms = pixels_ms};
    DynamicResolution budget(kBudget_ms, 4);
    run(budget, cost, 40);
    EXPECT_LE(cost.of(budget.quality()), kBudget_ms) << pixels_ms;
    const render::FrameQuality reached = budget.quality();
    run(budget, cost, 5'000);
    EXPECT_EQ(budget.quality(), reached) << pixels_ms;
  }
}

TEST(FrameBudgetTest, GivesUpResolutionDownToHalfBeforeSamples) {
  DynamicResolution budget(kBudget_ms, 4);
  double last_scale = 1.0;
  std::uint32_t last_samples = 4;
  for (int i = 0; i < 200; ++i) {
    if (!budget.add(1000.0)) continue;
    const render::FrameQuality quality = budget.quality();
    EXPECT_GE(quality.scale, 0.5);
    EXPECT_LE(quality.scale, last_scale);
    if (quality.samples < last_samples) {
      EXPECT_EQ(last_scale, 0.5);
    }
    last_scale = quality.scale;
    last_samples = quality.samples;
  }
  EXPECT_EQ(budget.quality(), (render::FrameQuality{.scale = 0.5, .samples = 1}));
  EXPECT_THAT(budget.text(), testing::HasSubstr("and still 1000 ms"));
}

// Each step waits for five frames: where a frame takes 240 ms, five steps would take six seconds.
TEST(FrameBudgetTest, PassesEveryResolutionThatCannotFit) {
  DynamicResolution budget(kBudget_ms, 4);
  const Cost slow{.pixels_ms = 240.0, .four_samples = 1.0};
  EXPECT_EQ(run(budget, slow, 5), 1);
  EXPECT_EQ(budget.quality(), (render::FrameQuality{.scale = 0.5, .samples = 4}));
  // never beyond a resolution that fits
  DynamicResolution near(kBudget_ms, 4);
  EXPECT_EQ(run(near, {.fixed_ms = 0.0, .pixels_ms = 70.0, .four_samples = 1.0}, 5), 1);
  EXPECT_EQ(near.quality().scale, 0.71);
}

TEST(FrameBudgetTest, OfOneSampleHasNoneToGiveUp) {
  DynamicResolution budget(kBudget_ms, 1);
  run(budget, {.pixels_ms = 1000.0}, 500);
  EXPECT_EQ(budget.quality(), (render::FrameQuality{.scale = 0.5, .samples = 1}));
}

TEST(FrameBudgetTest, ComesAllTheWayBackWhenTheLoadIsGone) {
  DynamicResolution budget(kBudget_ms, 4);
  run(budget, {.pixels_ms = 200.0}, 100);
  ASSERT_EQ(budget.quality().samples, 1U);
  run(budget, {.pixels_ms = 5.0}, 1'000);
  EXPECT_EQ(budget.quality(), (render::FrameQuality{.scale = 1.0, .samples = 4}));
}

TEST(FrameBudgetTest, AHiccupChangesNothing) {
  DynamicResolution budget(kBudget_ms, 4);
  for (int i = 0; i < 1'000; ++i) EXPECT_FALSE(budget.add(i % 3 == 0 ? 500.0 : 20.0)) << i;
}

// A device whose frames cost more at the finer step than anything foretells: it is tried less and less often.
TEST(FrameBudgetTest, DoesNotGoBackAndForth) {
  DynamicResolution budget(kBudget_ms, 4);
  const auto cost = [](const render::FrameQuality& quality) { return quality.scale > 0.9 ? 90.0 : 20.0; };
  int changes = 0;
  for (int i = 0; i < 6'000; ++i) changes += budget.add(cost(budget.quality())) ? 1 : 0;
  EXPECT_LE(changes, 20);
  EXPECT_EQ(budget.quality().scale, 0.84);
}

TEST(FrameBudgetTest, SaysWhatItChose) {
  DynamicResolution budget(kBudget_ms, 4);
  EXPECT_EQ(budget.text(), "100 % of the pixels each way, 4 samples");
  run(budget, {.pixels_ms = 1000.0}, 100);
  EXPECT_THAT(budget.text(), testing::StartsWith("50 % of the pixels each way, 1 sample,"));
}

TEST(DemoSize, KeepsAFrameWithinTheBudget) {
  EXPECT_EQ(fitting_eye_width(60.0, 60.0), kUsualEyeWidth);
  EXPECT_EQ(fitting_eye_width(1.0, 60.0), kUsualEyeWidth);
  EXPECT_EQ(fitting_eye_width(240.0, 60.0), kUsualEyeWidth / 2);
  EXPECT_EQ(fitting_eye_width(250.0, 60.0), 464U);
  EXPECT_EQ(fitting_eye_width(60'000.0, 60.0), kLeastEyeWidth);
}

}  // namespace dynamic_resolution_test
}  // namespace afm::app
