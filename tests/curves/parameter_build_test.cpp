// SPDX-License-Identifier: Apache-2.0
#include "curves/parameter_build.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <utility>

#include "support/samples/tapped_sample.h"

namespace afm::curves {
namespace parameter_build_test {

using Row = LiveParameters::Row;

// Waits for the next parameters as the frame loop does, frame by frame.
LiveParameters taken(ParameterBuild& build, const LiveParameters& now) {
  for (;;) {
    if (auto next = build.take(now)) return *std::move(next);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

class ParameterBuildTest : public ::testing::Test {
 protected:
  static const SampleModel& sample() {
    static const SampleModel model = test::tapped_sample();
    return model;
  }
  const LiveParameters loaded_{sample()};
  ParameterBuild build_;
};

TEST_F(ParameterBuildTest, GivesWhatTheStepsWouldHaveGiven) {
  LiveParameters wanted = loaded_;
  ASSERT_TRUE(wanted.step(Row::TipRadius, 1));
  build_.step(loaded_, Row::TipRadius, 1);
  EXPECT_TRUE(build_.running());
  EXPECT_FALSE(loaded_.changed());
  const LiveParameters next = taken(build_, loaded_);
  EXPECT_FALSE(build_.running());
  EXPECT_EQ(next.state(), wanted.state());
  EXPECT_EQ(next.model().figures().z_jtc.si, wanted.model().figures().z_jtc.si);
  EXPECT_EQ(next.model().figures().force_after_joc.si, wanted.model().figures().force_after_joc.si);
  EXPECT_NE(next.model().figures().z_jtc.si, loaded_.model().figures().z_jtc.si);
}

TEST_F(ParameterBuildTest, TakesTheStepsThatCameMeanwhile) {
  build_.step(loaded_, Row::TipRadius, 1);
  build_.step(loaded_, Row::TipRadius, 1);
  build_.step(loaded_, Row::SpringConstant, -1);
  const LiveParameters first = taken(build_, loaded_);
  EXPECT_EQ(first.state().steps[0], 1);
  EXPECT_TRUE(build_.running());
  const LiveParameters second = taken(build_, first);
  EXPECT_EQ(second.state().steps[0], 2);
  EXPECT_EQ(second.state().steps[1], -1);
  EXPECT_FALSE(build_.running());
}

TEST_F(ParameterBuildTest, ForgetsWhatIsNotWanted) {
  build_.step(loaded_, Row::TipRadius, 1);
  build_.step(loaded_, Row::TipRadius, 1);
  build_.drop();
  EXPECT_FALSE(build_.running());
  build_.step(loaded_, Row::SpringConstant, 1);
  const LiveParameters next = taken(build_, loaded_);
  EXPECT_EQ(next.state().steps[0], 0);
  EXPECT_EQ(next.state().steps[1], 1);
}

TEST_F(ParameterBuildTest, GivesTheReasonWhyAStepChangesNothing) {
  const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
  const LiveParameters mica(make_sample_model(ContactSetup{*library.find("mica"), {}, {}}).value());
  for (int i = 0; i < 100; ++i) build_.step(mica, Row::TipRadius, -1);
  const LiveParameters first = taken(build_, mica);
  const LiveParameters last = taken(build_, first);
  EXPECT_FALSE(last.refusal().empty());
  EXPECT_EQ(last.state().refused, Row::TipRadius);
  EXPECT_GT(last.state().steps[0], -100);
}

}  // namespace parameter_build_test
}  // namespace afm::curves
