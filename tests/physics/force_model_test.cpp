// SPDX-License-Identifier: Apache-2.0
// Invariant: the force of an event does not depend on the sample rate
#include "physics/force_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace afm::physics {
namespace force_model_test {

using namespace literals;
using testing::HasSubstr;

const Stiffness kRigid(std::numeric_limits<double>::infinity());
const ContactParameters kMica{50_nm, 0.1_N_per_m, kRigid, 24.5_zJ, 2.228_mJ_per_m2};
const ContactParameters kSoft{50_nm, 0.1_N_per_m, 0.2_N_per_m, 24.5_zJ, 2.228_mJ_per_m2};

ApproachRetractModel lifted(const ContactParameters& contact) {
  ApproachRetractModel model(contact);
  model.step(2.0 * model.figures().z_joc);
  return model;
}

TEST(ApproachRetractModel, GivesNoForceBeforeTheTipWasLifted) {
  ApproachRetractModel model(kMica);
  for (const Length z : {-3_nm, 1_nm, 10_nm, 13.99_nm, model.figures().z_joc, 2_nm, -1_nm}) {
    const TipResponse response = model.step(z);
    EXPECT_EQ(response.force, 0_nN);
    EXPECT_EQ(response.phase, Phase::WaitForLift);
    EXPECT_EQ(response.event_count, 0U);
    EXPECT_EQ(response.tip_height, z);
  }
  EXPECT_EQ(model.step(14.01_nm).phase, Phase::Free);
}

TEST(ApproachRetractModel, WaitsAgainWhenAskedTo) {
  ApproachRetractModel model = lifted(kMica);
  EXPECT_LT(model.step(1_nm).force, 0_nN);
  model.wait_for_lift();
  EXPECT_EQ(model.step(1_nm).force, 0_nN);
  EXPECT_EQ(model.step(12_nm).force, 0_nN);
  EXPECT_EQ(model.step(15_nm).phase, Phase::Free);
}

TEST(ApproachRetractModel, TakesAnythingThatIsNotFiniteForADropout) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    ApproachRetractModel model = lifted(kMica);
    model.step(1_nm);
    const TipResponse response = model.step(Length(bad));
    EXPECT_EQ(response.force, 0_nN);
    EXPECT_EQ(response.tip_height, 0_nm);
    EXPECT_EQ(response.event_count, 0U);
    EXPECT_EQ(model.phase(), Phase::WaitForLift);
    EXPECT_EQ(model.step(1_nm).force, 0_nN);
  }
}

TEST(ApproachRetractModel, PullsBelowTheSurfacesZeroAndPushesAboveIt) {
  ApproachRetractModel model = lifted(kMica);
  EXPECT_NEAR(model.step(1_nm).force.si, -0.1e-9, 1e-18);
  EXPECT_EQ(model.step(0_nm).force, 0_nN);
  EXPECT_NEAR(model.step(-2_nm).force.si, 0.2e-9, 1e-18);
}

TEST(JumpToContact, HappensBeforeTouch) {
  ApproachRetractModel model = lifted(kMica);
  const TipResponse response = model.step(2.3_nm);
  ASSERT_EQ(response.event_count, 1U);
  EXPECT_EQ(response.events[0].kind, EventKind::JumpToContact);
  EXPECT_GT(response.events[0].z, 0_nm);
  EXPECT_EQ(response.events[0].force_before, 0_nN);
  EXPECT_EQ(response.events[0].force_after, model.figures().force_after_jtc);
  EXPECT_EQ(response.phase, Phase::Attached);
}

TEST(JumpToContact, HappensAtItsThresholdAndNotAbove) {
  ApproachRetractModel model = lifted(kMica);
  const Length z_jtc = model.figures().z_jtc;
  EXPECT_EQ(model.step(Length(std::nextafter(z_jtc.si, 1.0))).event_count, 0U);
  EXPECT_EQ(model.step(z_jtc).event_count, 1U);
}

TEST(JumpOffContact, HappensAtItsThresholdAndNotBelow) {
  ApproachRetractModel model = lifted(kMica);
  const Length z_joc = model.figures().z_joc;
  model.step(0_nm);
  EXPECT_EQ(model.step(Length(std::nextafter(z_joc.si, 0.0))).event_count, 0U);
  const TipResponse response = model.step(z_joc);
  ASSERT_EQ(response.event_count, 1U);
  EXPECT_EQ(response.events[0].kind, EventKind::JumpOffContact);
  EXPECT_EQ(response.events[0].force_before, model.figures().force_before_joc);
  EXPECT_EQ(response.events[0].force_after, 0_nN);
  EXPECT_EQ(response.force, 0_nN);
}

TEST(ApproachRetractModel, SaysWhereInTheStepAJumpHappened) {
  ApproachRetractModel model = lifted(kMica);
  model.step(4_nm);
  const TipResponse down = model.step(0_nm);
  EXPECT_NEAR(down.events[0].fraction, (4.0 - 2.39752348708) / 4.0, 1e-9);
  const TipResponse up = model.step(28_nm);
  EXPECT_NEAR(up.events[0].fraction, 13.9989368644 / 28.0, 1e-9);
}

TEST(ApproachRetractModel, SeesAJumpHoweverLongTheStep) {
  ApproachRetractModel model(kMica);
  model.step(1_m);
  EXPECT_EQ(model.step(-1_m).event_count, 1U);
  EXPECT_EQ(model.step(1_m).event_count, 1U);
}

TEST(ApproachRetractModel, SharesDeflectionBetweenLeverAndSample) {
  ApproachRetractModel model = lifted(kSoft);
  for (const Length z : {1_nm, 10_nm, -4_nm}) {
    const TipResponse response = model.step(z);
    EXPECT_EQ(response.phase, Phase::Attached);
    // on the surface D = 0: Z = delta_c + delta_s, and the apex is at the surface
    EXPECT_NEAR((response.cantilever_deflection + response.sample_deformation).si, z.si, 1e-23);
    EXPECT_NEAR(response.tip_height.si, response.sample_deformation.si, 1e-23);
    EXPECT_NEAR(response.cantilever_deflection / response.sample_deformation, 2.0, 1e-12);
  }
}

TEST(ApproachRetractModel, KeepsTheTipOnARigidSurface) {
  ApproachRetractModel model = lifted(kMica);
  for (const Length z : {1_nm, 10_nm, -4_nm}) EXPECT_NEAR(model.step(z).tip_height.si, 0.0, 1e-23);
}

TEST(LeverState, BalancesLeverAndSample) {
  const auto tables = build_law_tables(Law::Paper, kSoft);
  for (const Force force : {-1_nN, 0_nN, 2_nN}) {
    const LeverState free = lever_state(*tables, Phase::Free, 4_nm, force);
    EXPECT_DOUBLE_EQ((kSoft.spring_constant * free.cantilever_deflection).si, -force.si);
    EXPECT_DOUBLE_EQ((kSoft.sample_stiffness * free.sample_deformation).si, -force.si);
    EXPECT_DOUBLE_EQ((free.tip_height + free.cantilever_deflection).si, 4e-9);
    // in contact whatever is not lever and gap is sample
    EXPECT_EQ(lever_state(*tables, Phase::Attached, 4_nm, force).sample_deformation, free.tip_height);
  }
}

TEST(ApproachRetractModel, HangsStraightWhileFree) {
  ApproachRetractModel model = lifted(kSoft);
  const TipResponse response = model.step(5_nm);
  EXPECT_EQ(response.phase, Phase::Free);
  EXPECT_EQ(response.tip_height, 5_nm);
  EXPECT_EQ(response.cantilever_deflection, 0_nm);
  EXPECT_EQ(response.sample_deformation, 0_nm);
}

TEST(ApproachRetractModel, RefusesAnAdhesionThatCannotHold) {
  ContactParameters weak = kMica;
  weak.mean_surface_energy = 0.2_mJ_per_m2;
  try {
    ApproachRetractModel model(weak);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("mean surface energy 0.2 mJ/m2 is too weak"));
  }
  weak.tip_radius = -1_nm;
  EXPECT_THROW(ApproachRetractModel{weak}, UnphysicalValue);
}

// A smooth hand: 30 nm of stroke in a second, with a tremble, sampled at `rate_hz`.
std::vector<Length> hand_path(double rate_hz) {
  std::vector<Length> path;
  const auto samples = static_cast<int>(rate_hz);
  for (int i = 0; i <= samples; ++i) {
    const double t = i / rate_hz;
    path.push_back(Length(8e-9 + 12e-9 * std::cos(2.0 * std::numbers::pi * t) +
                          0.5e-9 * std::sin(2.0 * std::numbers::pi * 9.0 * t)));
  }
  return path;
}

class SampleRate : public testing::TestWithParam<int> {};

TEST_P(SampleRate, DoesNotChangeTheJumps) {
  ApproachRetractModel model = lifted(kMica);
  std::vector<ModelEvent> events;
  for (const Length z : hand_path(GetParam())) {
    const TipResponse response = model.step(z);
    events.insert(events.end(), response.events.begin(), response.events.begin() + response.event_count);
  }
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EventKind::JumpToContact);
  EXPECT_EQ(events[0].z, model.figures().z_jtc);
  EXPECT_EQ(events[0].force_after, model.figures().force_after_jtc);
  EXPECT_EQ(events[1].kind, EventKind::JumpOffContact);
  EXPECT_EQ(events[1].z, model.figures().z_joc);
  EXPECT_EQ(events[1].force_before, model.figures().force_before_joc);
}

INSTANTIATE_TEST_SUITE_P(ApproachRetractModel, SampleRate, testing::Values(500, 1000, 2000, 4000, 8000),
                         [](const auto& test) { return "At" + std::to_string(test.param) + "Hz"; });

// Work that the hand does along a straight step, jumps taken where they happen.
Energy work_of_step(const ApproachRetractModel& before, ApproachRetractModel& model, Length from, Length to) {
  ApproachRetractModel old = before;
  const Force force_from = old.step(from).force;
  const TipResponse response = model.step(to);
  if (response.event_count == 0) return -0.5 * (force_from + response.force) * (to - from);
  const ModelEvent& event = response.events[0];
  return -0.5 * (force_from + event.force_before) * (event.z - from) -
         0.5 * (event.force_after + response.force) * (to - event.z);
}

TEST(ApproachRetractModel, NeverGivesWorkOnAClosedPath) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-5e-9, 20e-9);
  for (int path = 0; path < 500; ++path) {
    const Length top = 20_nm;
    ApproachRetractModel model = lifted(kSoft);
    model.step(top);
    Energy work;
    Length from = top;
    for (int i = 0; i < 20; ++i) {
      const Length to = i == 19 ? top * 2.0 : Length(place(random));
      const ApproachRetractModel before = model;
      work = work + work_of_step(before, model, from, to);
      from = to;
    }
    // free again at the top, so that the rest of the path costs nothing
    ASSERT_EQ(model.phase(), Phase::Free);
    ASSERT_GE(work.si, -1e-30) << path;
  }
}

TEST(ApproachRetractModel, CostsNothingInsideTheBand) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> place(2.4e-9, 13.99e-9);
  for (const bool attached : {false, true}) {
    ApproachRetractModel model = lifted(kMica);
    if (attached) model.step(0_nm);
    model.step(8_nm);
    const Phase phase = model.phase();
    Energy work;
    Length from = 8_nm;
    for (int i = 0; i < 1000; ++i) {
      const Length to = i == 999 ? 8_nm : Length(place(random));
      const ApproachRetractModel before = model;
      work = work + work_of_step(before, model, from, to);
      from = to;
      ASSERT_EQ(model.phase(), phase);
    }
    EXPECT_NEAR(work.si, 0.0, 1e-28);
  }
}

TEST(ApproachRetractModel, ChangesForceNoFasterThanItsSlopeExceptAtAJump) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> place(-5e-9, 20e-9);
  ApproachRetractModel model = lifted(kMica);
  TipResponse previous = model.step(20_nm);
  Length from = 20_nm;
  for (int i = 0; i < 10'000; ++i) {
    const Length to(place(random));
    const TipResponse response = model.step(to);
    if (response.event_count == 0) {
      ASSERT_LE(abs(response.force - previous.force).si, (0.1_N_per_m * abs(to - from)).si * (1.0 + 1e-12));
    }
    previous = response;
    from = to;
  }
}

ContactParameters elastic_mica() {
  ContactParameters contact = kMica;
  contact.reduced_modulus = 51.5_GPa;
  return contact;
}

TEST(ModelOfAnyLaw, GoesInAndOutOfContactSilentlyWithoutHysteresis) {
  ContactParameters stiff = elastic_mica();
  stiff.spring_constant = 10_N_per_m;
  for (const Law law : {Law::Hertz, Law::Dmt}) {
    ApproachRetractModel model(build_law_tables(law, stiff));
    const CycleFigures& figures = model.figures();
    ASSERT_FALSE(figures.hysteretic);
    EXPECT_EQ(model.step(figures.z_joc).phase, Phase::WaitForLift);
    const TipResponse above = model.step(figures.z_joc + Length(1e-15));
    EXPECT_EQ(above.phase, Phase::Free);
    const TipResponse at = model.step(figures.z_jtc);
    EXPECT_EQ(at.phase, Phase::Attached);
    EXPECT_EQ(at.event_count, 0U);
    EXPECT_NEAR(at.force.si, above.force.si, 1e-13);
    // a hold at the very place does not chatter
    EXPECT_EQ(model.step(figures.z_jtc).phase, Phase::Attached);
    EXPECT_EQ(model.step(figures.z_joc + Length(1e-15)).phase, Phase::Free);
  }
}

TEST(ModelOfAnyLaw, BalancesLeverAndTip) {
  for (const Law law : laws_with(&LawTraits::computed)) {
    ApproachRetractModel model(build_law_tables(law, elastic_mica()));
    EXPECT_EQ(model.law(), law);
    model.step(1_um);
    for (const Length z : {20_nm, 4_nm, -1_nm, -20_nm, 3_nm, 10_nm}) {
      const TipResponse response = model.step(z);
      EXPECT_NEAR(response.force.si, -(model.contact().spring_constant * response.cantilever_deflection).si, 1e-20);
      EXPECT_NEAR((response.tip_height + response.cantilever_deflection).si, z.si, 1e-20);
      const Length gap = response.phase == Phase::Attached ? model.tables().contact_gap : response.tip_height;
      EXPECT_NEAR((response.tip_height - response.sample_deformation).si, gap.si, 1e-20) << name_of(law) << z.si;
    }
  }
}

TEST(ModelOfAnyLaw, FeelsTheAttractionBeforeTheJump) {
  ApproachRetractModel model(build_law_tables(Law::Dmt, elastic_mica()));
  model.step(1_um);
  const CycleFigures& figures = model.figures();
  EXPECT_EQ(model.step(figures.z_jtc + Length(1e-18)).phase, Phase::Free);
  EXPECT_NEAR(model.step(figures.z_jtc + Length(1e-18)).force / figures.force_before_jtc, 1.0, 1e-3);
  EXPECT_LT(figures.force_after_jtc, 2.0 * figures.force_before_jtc);
}

}  // namespace force_model_test
}  // namespace afm::physics
