// SPDX-License-Identifier: Apache-2.0
#include "curves/live_parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "curves/sample_model.h"
#include "scene/samples/material_library.h"
#include "support/places.h"
#include "support/samples/tapped_sample.h"

namespace afm::curves {
namespace live_parameters_test {

using Row = LiveParameters::Row;

class LiveParametersTest : public ::testing::Test {
 protected:
  static SampleModel material(const char* name) {
    const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
    return make_sample_model(ContactSetup{*library.find(name), {}, {}}).value();
  }

  const SampleModel mica_ = material("mica");
  LiveParameters parameters_{mica_};
};

TEST_F(LiveParametersTest, FourStepsAreAFactorOfTwoAndAsManyBackAreExactlyWhatWasLoaded) {
  for (const Row row : {Row::TipRadius, Row::SpringConstant, Row::Hamaker, Row::WorkOfAdhesion, Row::ReducedModulus}) {
    const std::string before = parameters_.value(row);
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(parameters_.step(row, 1));
    EXPECT_TRUE(parameters_.changed(row));
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(parameters_.step(row, -1));
    EXPECT_FALSE(parameters_.changed(row));
    EXPECT_EQ(parameters_.value(row), before);
  }
  EXPECT_EQ(parameters_.model().parameters.contact.hamaker.si, mica_.parameters.contact.hamaker.si);
  for (int i = 0; i < 4; ++i) parameters_.step(Row::SpringConstant, 1);
  EXPECT_NEAR(parameters_.model().parameters.contact.spring_constant.si, 0.2, 1e-15);
}

TEST_F(LiveParametersTest, TheFiguresFollowTheStiffnessAsHaosFoldDoes) {
  const double before = parameters_.model().figures().z_jtc.si;
  for (int i = 0; i < 12; ++i) parameters_.step(Row::SpringConstant, 1);  // k * 8: Z_jtc falls to a half, (3.6)
  EXPECT_NEAR(parameters_.model().figures().z_jtc.si, 0.5 * before, 1e-9 * before);
}

TEST_F(LiveParametersTest, ThePredictedCurveReachesTheFoldForces) {
  const auto& figures = parameters_.model().figures();
  double strongest = 0.0;
  for (const physics::CurveSample& sample : parameters_.curve().samples) {
    strongest = std::min(strongest, sample.force.si);
  }
  EXPECT_NEAR(strongest, figures.force_before_joc.si, 1e-6 * std::abs(strongest));
  ASSERT_EQ(parameters_.curve().events.size(), 2U);
  // 400 steps each way, plus the samples of the two jumps
  EXPECT_NEAR(static_cast<double>(parameters_.curve().samples.size()), 2.0 * 401.0, 5.0);
}

TEST_F(LiveParametersTest, TheLawGoesRoundThroughAllThatTheseParametersHave) {
  std::set<std::string> seen;
  const std::string first = parameters_.value(Row::Law);
  for (int i = 0; i < 8; ++i) {
    seen.insert(parameters_.value(Row::Law));
    ASSERT_TRUE(parameters_.step(Row::Law, 1));
  }
  EXPECT_EQ(parameters_.value(Row::Law), first);
  EXPECT_TRUE(seen.contains("paper"));
  EXPECT_TRUE(seen.contains("dmt"));
  EXPECT_TRUE(seen.contains("auto: dmt"));
}

TEST_F(LiveParametersTest, ALeverWithMassGoesRoundTheLawsThatMoveOne) {
  ContactSetup setup = mica_.setup;
  setup.model.law = physics::Law::Dmt;
  setup.model.dynamic = true;
  LiveParameters parameters(make_sample_model(setup).value());
  std::set<physics::Law> seen;
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(parameters.step(Row::Law, 1));
    EXPECT_TRUE(physics::has_dynamics(parameters.model().parameters.law)) << parameters.value(Row::Law);
    seen.insert(parameters.model().parameters.law);
  }
  const auto all = physics::laws_with(&physics::LawTraits::dynamic);
  EXPECT_EQ(seen, std::set<physics::Law>(all.begin(), all.end()));
}

TEST_F(LiveParametersTest, AStepBeyondWhatIsPhysicalChangesNothingAndSaysWhy) {
  int steps = 0;
  while (parameters_.step(Row::TipRadius, 1)) ASSERT_LT(++steps, 200);
  const double radius = parameters_.model().parameters.contact.tip_radius.si;
  EXPECT_FALSE(parameters_.step(Row::TipRadius, 1));
  EXPECT_EQ(parameters_.model().parameters.contact.tip_radius.si, radius);
  EXPECT_FALSE(parameters_.refusal().empty());
  EXPECT_TRUE(parameters_.step(Row::TipRadius, -1));
  EXPECT_TRUE(parameters_.refusal().empty());
}

// A lever driven above its resonance taps a soft sample; a stiffer one enlarges its swing.
TEST_F(LiveParametersTest, AStepToASampleThatEnlargesTheSwingChangesNothingAndSaysWhy) {
  TappedHand hand = test::tapped_hand();
  hand.choice.numbers.drive = "306kHz";
  hand.values["reduced-modulus"] = "30MPa";
  LiveParameters parameters(make_sample_model(tapped_setup(mica_.setup.material, hand).value()).value());
  int steps = 0;
  while (parameters.step(Row::ReducedModulus, 1)) ASSERT_LT(++steps, 60);
  EXPECT_GT(steps, 0);
  EXPECT_THAT(parameters.refusal(), ::testing::HasSubstr("this sample enlarges the swing from 20 nm to at least "));
  const double modulus = parameters.model().parameters.contact.reduced_modulus.si;
  EXPECT_NEAR(modulus, 3e7 * std::exp2(0.25 * steps), 1e-9 * modulus);
  EXPECT_EQ(parameters.state().steps[static_cast<std::size_t>(Row::ReducedModulus)], steps);
  EXPECT_TRUE(parameters.step(Row::ReducedModulus, -1));
  EXPECT_TRUE(parameters.refusal().empty());
}

TEST_F(LiveParametersTest, ResetIsWhatWasLoaded) {
  EXPECT_FALSE(parameters_.reset());
  parameters_.step(Row::Hamaker, 1);
  parameters_.step(Row::Law, 1);
  EXPECT_TRUE(parameters_.reset());
  EXPECT_FALSE(parameters_.changed());
  EXPECT_EQ(parameters_.model().parameters.contact.hamaker.si, mica_.parameters.contact.hamaker.si);
  EXPECT_EQ(parameters_.model().parameters.law, mica_.parameters.law);
}

TEST_F(LiveParametersTest, ARigidContactSoftensFromAStiffOne) {
  SampleModel rigid = mica_;
  rigid.parameters.contact.reduced_modulus = physics::Pressure(std::numeric_limits<double>::infinity());
  LiveParameters parameters(rigid);
  EXPECT_EQ(parameters.value(Row::ReducedModulus), "rigid");
  EXPECT_FALSE(parameters.step(Row::ReducedModulus, 1));
  EXPECT_TRUE(parameters.step(Row::ReducedModulus, -1));
  EXPECT_TRUE(std::isfinite(parameters.model().parameters.contact.reduced_modulus.si));
  EXPECT_TRUE(parameters.step(Row::ReducedModulus, 1));
  EXPECT_EQ(parameters.value(Row::ReducedModulus), "rigid");
}

}  // namespace live_parameters_test
}  // namespace afm::curves
