// SPDX-License-Identifier: Apache-2.0
#include "haptics/scaling.h"

#include <gmock/gmock.h>

#include <limits>

#include "haptics/simulated_device.h"
#include "physics/contact.h"
#include "physics/law_tables.h"

namespace {

using namespace afm::haptics;
using afm::physics::CycleFigures;
using afm::physics::Interaction;

constexpr double kRigid = std::numeric_limits<double>::infinity();

// R, k_c, k_s, A_H, sqrt(gamma_s gamma_t) of Liu & Peng, Table 1; a finite k_s in the last one.
Interaction interaction_of(double spring_constant, double sample_stiffness, double hamaker, double surface_energy) {
  return {.tip_radius = afm::physics::Length(50e-9),
          .spring_constant = afm::physics::Stiffness(spring_constant),
          .sample_stiffness = afm::physics::Stiffness(sample_stiffness),
          .hamaker = afm::physics::Energy(hamaker),
          .mean_surface_energy = afm::physics::SurfaceEnergy(surface_energy)};
}

CycleFigures figures_of(const Interaction& interaction) {
  return afm::physics::build_law_tables(afm::physics::Law::Paper, interaction)->figures;
}

class FitScalingOf : public testing::TestWithParam<Interaction> {
 protected:
  const CycleFigures figures_ = figures_of(GetParam());
  const double f_ad_n_ = -figures_.force_before_joc.si;
  const FitScaling scaling_ = *FitScaling::create(figures_, SimulatedDevice().spec());
};

TEST_P(FitScalingOf, FillsTheStrokeAndTheForceAtPullOff) {
  EXPECT_NEAR(scaling_.z_m(0.050), figures_.z_joc.si, 1e-9 * figures_.z_joc.si);
  EXPECT_NEAR(scaling_.hand_force_n(-f_ad_n_), -2.0, 1e-12);
}

TEST_P(FitScalingOf, FeelsTheSameSpringWhateverTheMaterial) {
  EXPECT_DOUBLE_EQ(scaling_.stiffness_n_per_m(), 40.0);
  // k' times the force scale over the position scale
  EXPECT_NEAR(afm::physics::effective_stiffness(GetParam()).si * scaling_.hand_n_per_n() / scaling_.hand_m_per_m(),
              40.0, 1e-9);
}

TEST_P(FitScalingOf, KeepsZeroAndSigns) {
  EXPECT_EQ(scaling_.hand_force_n(0.0), 0.0);
  EXPECT_EQ(scaling_.z_m(0.0), 0.0);
  EXPECT_LT(scaling_.hand_force_n(-1e-12), 0.0);
  EXPECT_GT(scaling_.hand_force_n(1e-12), 0.0);
}

TEST_P(FitScalingOf, PushesMonotonelyNeverSteeperThanTheSpringAndBelowTheCap) {
  const double step_n = 1e-3 * f_ad_n_;
  double last_n = scaling_.hand_force_n(-f_ad_n_);
  for (double force_n = -f_ad_n_ + step_n; force_n < 20.0 * f_ad_n_; force_n += step_n) {
    const double hand_n = scaling_.hand_force_n(force_n);
    EXPECT_GE(hand_n, last_n);
    EXPECT_LE(hand_n - last_n, step_n * scaling_.hand_n_per_n() * (1 + 1e-6));
    EXPECT_LE(hand_n, 2.0);
    last_n = hand_n;
  }
  EXPECT_LE(scaling_.hand_force_n(1e30), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Materials, FitScalingOf,
                         testing::Values(interaction_of(0.1, kRigid, 24.5e-21, 2.228e-3),
                                         interaction_of(0.1, kRigid, 120e-21, 15.915e-3),
                                         interaction_of(0.036, kRigid, 10e-21, 0.955e-3),
                                         interaction_of(0.1, 0.5, 24.5e-21, 2.228e-3)));

TEST(FitScaling, PullsLessOnADeviceWithLessForce) {
  DeviceSpec weak = SimulatedDevice().spec();
  weak.max_force_n = 1.0;
  const CycleFigures mica = figures_of(interaction_of(0.1, kRigid, 24.5e-21, 2.228e-3));
  EXPECT_DOUBLE_EQ(FitScaling::create(mica, weak)->pull_force_n(), 0.9);
  EXPECT_DOUBLE_EQ(force_cap_n(weak), 0.9);
}

TEST(FitScaling, RefusesADeviceThatCannotShowIt) {
  const CycleFigures mica = figures_of(interaction_of(0.1, kRigid, 24.5e-21, 2.228e-3));
  DeviceSpec soft = SimulatedDevice().spec();
  soft.max_stiffness_n_per_m = 30.0;
  EXPECT_THAT(FitScaling::create(mica, soft).error().message, testing::HasSubstr("40 N/m"));
  DeviceSpec low = SimulatedDevice().spec();
  low.workspace_max_m.y = 0.049;
  EXPECT_THAT(FitScaling::create(mica, low).error().message, testing::HasSubstr("reaches 49 mm"));
}

}  // namespace
