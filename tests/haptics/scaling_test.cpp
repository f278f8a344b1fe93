// SPDX-License-Identifier: Apache-2.0
#include "haptics/scaling.h"

#include <gmock/gmock.h>

#include <limits>

#include "haptics/simulated_device.h"
#include "physics/contact.h"

namespace {

using namespace afm::haptics;
using afm::physics::approach_retract_events;
using afm::physics::ApproachRetractEvents;
using afm::physics::Interaction;

constexpr double kRigid = std::numeric_limits<double>::infinity();

// R, k_c, k_s, A_H, sqrt(gamma_s gamma_t) of Liu & Peng, Table 1; a finite k_s in the last one.
ApproachRetractEvents events_of(double spring_constant, double sample_stiffness, double hamaker,
                                double surface_energy) {
  return approach_retract_events(Interaction{.tip_radius = afm::physics::Length(50e-9),
                                             .spring_constant = afm::physics::Stiffness(spring_constant),
                                             .sample_stiffness = afm::physics::Stiffness(sample_stiffness),
                                             .hamaker = afm::physics::Energy(hamaker),
                                             .mean_surface_energy = afm::physics::SurfaceEnergy(surface_energy)});
}

class FitScalingOf : public testing::TestWithParam<ApproachRetractEvents> {
 protected:
  const ApproachRetractEvents events_ = GetParam();
  const FitScaling scaling_ = *FitScaling::create(events_, SimulatedDevice().spec());
};

TEST_P(FitScalingOf, FillsTheStrokeAndTheForceAtPullOff) {
  EXPECT_NEAR(scaling_.z_m(0.050), events_.z_joc.si, 1e-9 * events_.z_joc.si);
  EXPECT_NEAR(scaling_.hand_force_n(-events_.f_ad.si), -2.0, 1e-12);
}

TEST_P(FitScalingOf, FeelsTheSameSpringWhateverTheMaterial) {
  EXPECT_DOUBLE_EQ(scaling_.stiffness_n_per_m(), 40.0);
  // k' times the force scale over the position scale
  EXPECT_NEAR(events_.effective_stiffness.si * scaling_.hand_n_per_n() / scaling_.hand_m_per_m(), 40.0, 1e-9);
}

TEST_P(FitScalingOf, KeepsZeroAndSigns) {
  EXPECT_EQ(scaling_.hand_force_n(0.0), 0.0);
  EXPECT_EQ(scaling_.z_m(0.0), 0.0);
  EXPECT_LT(scaling_.hand_force_n(-1e-12), 0.0);
  EXPECT_GT(scaling_.hand_force_n(1e-12), 0.0);
}

TEST_P(FitScalingOf, PushesMonotonelyNeverSteeperThanTheSpringAndBelowTheCap) {
  const double step_n = 1e-3 * events_.f_ad.si;
  double last_n = scaling_.hand_force_n(-events_.f_ad.si);
  for (double force_n = -events_.f_ad.si + step_n; force_n < 20.0 * events_.f_ad.si; force_n += step_n) {
    const double hand_n = scaling_.hand_force_n(force_n);
    EXPECT_GE(hand_n, last_n);
    EXPECT_LE(hand_n - last_n, step_n * scaling_.hand_n_per_n() * (1 + 1e-6));
    EXPECT_LE(hand_n, 2.0);
    last_n = hand_n;
  }
  EXPECT_LE(scaling_.hand_force_n(1e30), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Materials, FitScalingOf,
                         testing::Values(events_of(0.1, kRigid, 24.5e-21, 2.228e-3),
                                         events_of(0.1, kRigid, 120e-21, 15.915e-3),
                                         events_of(0.036, kRigid, 10e-21, 0.955e-3),
                                         events_of(0.1, 0.5, 24.5e-21, 2.228e-3)));

TEST(FitScaling, PullsLessOnADeviceWithLessForce) {
  DeviceSpec weak = SimulatedDevice().spec();
  weak.max_force_n = 1.0;
  const auto events = events_of(0.1, kRigid, 24.5e-21, 2.228e-3);
  EXPECT_DOUBLE_EQ(FitScaling::create(events, weak)->pull_force_n(), 0.9);
  EXPECT_DOUBLE_EQ(force_cap_n(weak), 0.9);
}

TEST(FitScaling, RefusesADeviceThatCannotShowIt) {
  const auto events = events_of(0.1, kRigid, 24.5e-21, 2.228e-3);
  DeviceSpec soft = SimulatedDevice().spec();
  soft.max_stiffness_n_per_m = 30.0;
  EXPECT_THAT(FitScaling::create(events, soft).error().message, testing::HasSubstr("40 N/m"));
  DeviceSpec low = SimulatedDevice().spec();
  low.workspace_max_m.y = 0.049;
  EXPECT_THAT(FitScaling::create(events, low).error().message, testing::HasSubstr("reaches 49 mm"));
}

}  // namespace
