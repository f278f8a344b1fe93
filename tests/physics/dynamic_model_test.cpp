// SPDX-License-Identifier: Apache-2.0
// Invariant: a dynamic model renders the lever's force and reports a jump once although the tip bounces
#include "physics/dynamic_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "mica.h"
#include "physics/dynamic_curve.h"
#include "physics/thermal_noise.h"
#include "support/no_alloc.h"

namespace afm::physics {
namespace dynamic_model_test {

using namespace literals;
using testing::HasSubstr;

const LeverDynamics kCold{12_kHz, 2.5, 0_K};
const LeverDynamics kWarm{12_kHz, 2.5, 298_K};
constexpr Time kTick(1e-3);

DynamicModel mica(const LeverDynamics& lever = kCold, Law law = Law::Dmt) {
  return DynamicModel(law, elastic_mica(), lever, kTick);
}

// Down from above Z_joc to 2 nm into the sample and up again.
std::vector<TipResponse> cycle(DynamicModel model, Length step) {
  std::vector<TipResponse> responses;
  const Length top = 1.3 * model.figures().z_joc;
  for (Length z = top; z > -2_nm; z = z - step) responses.push_back(model.step(z));
  for (Length z = -2_nm; z < top; z = z + step) responses.push_back(model.step(z));
  return responses;
}

std::vector<ModelEvent> events_of(const std::vector<TipResponse>& responses) {
  std::vector<ModelEvent> events;
  for (const TipResponse& response : responses) {
    for (std::uint32_t i = 0; i < response.event_count; ++i) events.push_back(response.events[i]);
  }
  return events;
}

TEST(DynamicModel, GivesNoForceBeforeTheTipWasLifted) {
  DynamicModel model = mica(kWarm);
  for (const Length z : {-3_nm, 1_nm, 10_nm, model.figures().z_joc}) {
    const TipResponse response = model.step(z);
    EXPECT_EQ(response.force, 0_nN);
    EXPECT_EQ(response.phase, Phase::WaitForLift);
    EXPECT_EQ(response.tip_height, z);
  }
  EXPECT_EQ(model.step(model.figures().z_joc + 1_nm).phase, Phase::Free);
  model.wait_for_lift();
  EXPECT_EQ(model.step(1_nm).force, 0_nN);
}

TEST(DynamicModel, TakesAnythingThatIsNotFiniteForADropout) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    DynamicModel model = mica();
    model.step(20_nm);
    model.step(1_nm);
    const TipResponse response = model.step(Length(bad));
    EXPECT_EQ(response.force, 0_nN);
    EXPECT_EQ(response.tip_height, 0_nm);
    EXPECT_EQ(model.phase(), Phase::WaitForLift);
  }
}

TEST(DynamicModel, PosesTheLeverAsItsForceSays) {
  DynamicModel model = mica(kWarm);
  for (Length z = 20_nm; z > -2_nm; z = z - 0.1_nm) {
    const TipResponse response = model.step(z);
    EXPECT_NEAR((response.tip_height + response.cantilever_deflection).si, z.si, 1e-20);
    EXPECT_NEAR(response.force.si, -0.1 * response.cantilever_deflection.si, 1e-20);
  }
}

// A slow ramp of a damped lever is the law at rest.
TEST(DynamicModel, AtRestIsTheLawAtRest) {
  for (const Law law : laws_with(&LawTraits::dynamic)) {
    const DynamicModel model = mica({12_kHz, 0.5, 0_K}, law);
    ApproachRetractModel resting(build_law_tables(law, elastic_mica()));
    const Length top = std::max(2_nm, 1.2 * model.figures().z_joc);
    const ForceCurve curve = record_curve(model, {top, -2_nm, 0.05_nm}, 0.1_um_per_s);
    resting.step(2.0 * top);
    for (const CurveSample& sample : curve.samples) {
      const TipResponse expected = resting.step(sample.z);
      const bool near_a_jump =
          abs(sample.z - model.figures().z_jtc) < 0.2_nm || abs(sample.z - model.figures().z_joc) < 0.2_nm;
      if (near_a_jump) continue;
      // the ramp drags the fluid with k v/(w0 Q), the mean looks half a step back, and a swing is not quite damped
      EXPECT_NEAR(sample.force.si, expected.force.si, 0.1 * 0.03e-9) << name_of(law) << " at " << sample.z.si;
      EXPECT_EQ(sample.phase, expected.phase) << name_of(law) << " at " << sample.z.si;
    }
  }
}

TEST(DynamicModel, JumpsWhereTheFoldsAreWhenItIsMovedSlowly) {
  for (const Law law : {Law::Dmt, Law::Jkr, Law::MaugisDugdale, Law::LennardJones}) {
    const DynamicModel model = mica({12_kHz, 0.5, 0_K}, law);
    const CycleFigures& figures = model.figures();
    const auto events = record_curve(model, {1.2 * figures.z_joc, -2_nm, 0.01_nm}, 0.02_um_per_s).events;
    ASSERT_EQ(events.size(), 2U) << name_of(law);
    EXPECT_EQ(events[0].kind, EventKind::JumpToContact);
    EXPECT_NEAR(events[0].z.si, figures.z_jtc.si, 0.02e-9) << name_of(law);
    EXPECT_NEAR(events[0].force_before.si, figures.force_before_jtc.si, 0.003e-9) << name_of(law);
    EXPECT_EQ(events[1].kind, EventKind::JumpOffContact);
    EXPECT_NEAR(events[1].z.si, figures.z_joc.si, 0.05e-9) << name_of(law);
    EXPECT_NEAR(events[1].force_before.si, figures.force_before_joc.si, 0.01e-9) << name_of(law);
  }
}

TEST(DynamicModel, JumpsTheLaterTheFasterItIsMoved) {
  const DynamicModel model = mica({12_kHz, 0.5, 0_K});
  Length before = model.figures().z_jtc;
  for (const Velocity speed : {0.1_um_per_s, 1_um_per_s, 10_um_per_s}) {
    const auto events = record_curve(model, {5_nm, -2_nm, 0.01_nm}, speed).events;
    ASSERT_GE(events.size(), 1U);
    // the end of the jump lags as well: force_after = k (contact - Z)
    EXPECT_LT(events[0].z, before);
    before = events[0].z;
  }
}

TEST(DynamicModel, RendersTheLeverAndNotTheImpact) {
  // the tip lands with more than 8 nN
  DynamicModel model = mica();
  model.settle(5_nm);
  for (Length z = 5_nm; z > 0_nm; z = z - 0.01_nm) EXPECT_LT(abs(model.step(z).force), 0.4_nN) << z.si;
  EXPECT_EQ(model.phase(), Phase::Attached);
}

TEST(DynamicModel, JumpsOnceEachWayThoughTheTipBounces) {
  for (const LeverDynamics& lever : {kCold, kWarm, LeverDynamics{12_kHz, 100.0, 0_K}}) {
    const auto events = events_of(cycle(mica(lever), 0.002_nm));
    ASSERT_EQ(events.size(), 2U) << lever.quality_factor;
    EXPECT_EQ(events[0].kind, EventKind::JumpToContact);
    EXPECT_EQ(events[1].kind, EventKind::JumpOffContact);
    EXPECT_GT(events[1].z, events[0].z);
  }
}

TEST(DynamicModel, ReportsNoJumpsOfALeverThatIsTooStiffForThem) {
  ContactParameters stiff = elastic_mica();
  stiff.spring_constant = 40_N_per_m;
  const DynamicModel model(Law::Dmt, stiff, {300_kHz, 5.0, 0_K}, kTick);
  ASSERT_FALSE(model.figures().hysteretic);
  bool touched = false;
  for (const TipResponse& response : cycle(model, 0.01_nm)) {
    EXPECT_EQ(response.event_count, 0U);
    touched = touched || response.phase == Phase::Attached;
  }
  EXPECT_TRUE(touched);
}

TEST(DynamicModel, SaysHowMuchSlowerThanNatureItIs) {
  const DynamicModel fast = mica();
  EXPECT_NEAR(fast.simulated_per_step().si, DynamicModel::kSubSteps * fast.sub_step().si, 1e-18);
  EXPECT_NEAR(fast.slow_motion(), kTick / fast.simulated_per_step(), 1e-9);
  EXPECT_GT(fast.slow_motion(), 10.0);

  // a soft sample under a slow lever needs no more than the tick has
  ContactParameters gel = elastic_mica();
  gel.reduced_modulus = Pressure(1e4);
  const DynamicModel slow(Law::Hertz, gel, {300_Hz, 2.0, 0_K}, kTick);
  EXPECT_EQ(slow.slow_motion(), 1.0);
  EXPECT_EQ(slow.simulated_per_step(), kTick);
}

TEST(DynamicModel, FeelsTheHeatOfItsLever) {
  DynamicModel model(Law::Hertz, elastic_mica(), kWarm, kTick);
  double sum = 0.0;
  constexpr int kTicks = 20000;
  for (int i = 0; i < kTicks; ++i) sum += std::pow(model.step(1_um).force.si, 2);
  // the mean over a tick of 0.02 ms takes little from a swing of 0.08 ms
  const double all = thermal_force(0.1_N_per_m, 298_K).si;
  EXPECT_LT(std::sqrt(sum / kTicks), all);
  EXPECT_GT(std::sqrt(sum / kTicks), 0.7 * all);
}

TEST(DynamicModel, RepeatsItselfForTheSameSeed) {
  const auto forces = [](std::uint64_t seed) {
    std::vector<double> values;
    const DynamicModel model(Law::Dmt, elastic_mica(), kWarm, kTick, {}, seed);
    for (const TipResponse& response : cycle(model, 0.05_nm)) values.push_back(response.force.si);
    return values;
  };
  EXPECT_EQ(forces(1), forces(1));
  EXPECT_NE(forces(1), forces(2));
}

TEST(DynamicModel, OwesNothingToWhatWasFeltBeforeALift) {
  DynamicModel fresh = mica(kWarm), used = mica(kWarm);
  for (int i = 0; i < 100; ++i) used.step(20_nm - i * 0.2_nm);
  used.wait_for_lift();
  for (Length z = 20_nm; z > -2_nm; z = z - 0.1_nm) EXPECT_EQ(used.step(z).force.si, fresh.step(z).force.si);
}

TEST(DynamicModel, DoesNotAllocateInAStep) {
  DynamicModel model = mica(kWarm);
  const test::NoAllocation none;
  for (Length z = 20_nm; z > -2_nm; z = z - 0.05_nm) model.step(z);
  for (Length z = -2_nm; z < 20_nm; z = z + 0.05_nm) model.step(z);
  model.wait_for_lift();
  model.step(1_nm);
  model.step(Length(std::nan("")));
}

TEST(DynamicModel, StaysFiniteWhateverTheHandDoes) {
  std::mt19937_64 random(4);
  for (const Law law : laws_with(&LawTraits::dynamic)) {
    DynamicModel model = mica(kWarm, law);
    for (int i = 0; i < 2000; ++i) {
      const double scale = std::pow(10.0, -10.0 + 6.0 * static_cast<double>(random() % 1000) / 1000.0);
      const Length z(scale * (static_cast<double>(random() % 2001) / 1000.0 - 1.0));
      const TipResponse response = model.step(random() % 50 == 0 ? 100_nm : z);
      ASSERT_TRUE(isfinite(response.force)) << name_of(law);
      ASSERT_LE(abs(response.force), 0.1_N_per_m * 0.1_mm) << name_of(law);
      ASSERT_TRUE(isfinite(response.tip_height)) << name_of(law);
    }
  }
}

TEST(DynamicModel, RefusesWhatHasNoDynamics) {
  const auto message = [](Law law, const ContactParameters& contact, const LeverDynamics& lever,
                          Time tick) -> std::string {
    try {
      DynamicModel(law, contact, lever, tick);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(Law::Paper, elastic_mica(), kCold, kTick),
            "the law paper has no dynamics: take one of hertz, dmt, jkr, maugis, lj");
  ContactParameters rigid = elastic_mica();
  rigid.reduced_modulus = Pressure(std::numeric_limits<double>::infinity());
  EXPECT_EQ(message(Law::Dmt, rigid, kCold, kTick),
            "a rigid contact has no dynamics: give it a finite reduced modulus");
  EXPECT_THAT(message(Law::Dmt, elastic_mica(), {12_kHz, -1.0, 0_K}, kTick), HasSubstr("quality factor -1"));
  EXPECT_THAT(message(Law::Dmt, elastic_mica(), kCold, Time(0.0)), HasSubstr("has no length"));
}

TEST(DynamicCurve, RefusesRampsThatCannotBe) {
  const DynamicModel model = mica();
  const SweepPlan plan{20_nm, -2_nm, 0.1_nm};
  EXPECT_THROW(record_curve(model, plan, Velocity()), std::invalid_argument);
  EXPECT_THROW(record_curve(model, plan, Velocity(std::nan(""))), std::invalid_argument);
  EXPECT_THROW(record_curve(model, {1_nm, -2_nm, 0.1_nm}, 1_um_per_s), std::invalid_argument);
  EXPECT_THROW(record_curve(model, {20_nm, 21_nm, 0.1_nm}, 1_um_per_s), std::invalid_argument);
  try {
    record_curve(model, plan, Velocity(1e-15));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("takes too long to compute"));
  }
}

TEST(DynamicCurve, HoldsTheWholeCycle) {
  const SweepPlan plan{20_nm, -2_nm, 0.1_nm};
  const ForceCurve curve = record_curve(mica(), plan, 1_um_per_s);
  ASSERT_EQ(curve.samples.size(), sample_count(plan));
  int marked = 0;
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    EXPECT_EQ(curve.samples[i].z, sample_z(plan, i));
    EXPECT_EQ(curve.samples[i].branch, i <= curve.samples.size() / 2 ? Branch::Approach : Branch::Retract);
    marked += curve.samples[i].event ? 1 : 0;
  }
  EXPECT_EQ(marked, 2);
  EXPECT_EQ(curve.events.size(), 2U);
}

}  // namespace dynamic_model_test
}  // namespace afm::physics
