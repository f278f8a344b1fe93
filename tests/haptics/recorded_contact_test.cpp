// SPDX-License-Identifier: Apache-2.0
// What a hand feels of a curve that an instrument recorded.
// Invariant: a recorded curve is felt with the snap-in, pull-off and loop energy of its analysis within 1 %
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <memory>
#include <vector>

#include "haptics/contact_model.h"
#include "haptics/passivity_observer.h"
#include "haptics/safety.h"
#include "haptics/simulated_device.h"
#include "physics/measured_branches.h"
#include "support/samples/recorded_cycles.h"

namespace afm::haptics {
namespace recorded_contact_test {

struct Felt {
  std::shared_ptr<const physics::LawTables> tables;
  std::unique_ptr<ContactModel> model;
};

Felt felt(const std::vector<physics::CurvePoint>& points) {
  const auto branches = physics::measured_branches(points);
  scene::SharedContact material;
  material.name = scene::to_name("measured");
  material.contact = {.tip_radius = physics::Length(50e-9),
                      .spring_constant = physics::Stiffness(1.0),
                      .sample_stiffness = physics::Stiffness(HUGE_VAL),
                      .hamaker = physics::Energy(24.5e-21),
                      .mean_surface_energy = physics::SurfaceEnergy(2e-3)};
  material.law = physics::Law::Measured;
  material.measured_curve = 0;
  std::vector<scene::SharedMeasuredCurve> curves(1);
  curves[0].approach_count = static_cast<std::uint32_t>(branches.approach.size());
  curves[0].retract_count = static_cast<std::uint32_t>(branches.retract.size());
  curves[0].jumps = branches.jumps;
  std::copy(branches.approach.begin(), branches.approach.end(), curves[0].approach.begin());
  std::copy(branches.retract.begin(), branches.retract.end(), curves[0].retract.begin());
  auto tables = build_tables(material, curves).value();
  const DeviceSpec device = SimulatedDevice().spec();
  const CommonScale common = Scaling::common_scale(std::vector{tables}, device).value();
  auto model = ContactModel::create(material, 0, tables, nullptr, common, device, 1'000'000).value();
  return {std::move(tables), std::move(model)};
}

class RecordedContact : public testing::TestWithParam<int> {
 protected:
  static std::vector<physics::CurvePoint> curve() {
    switch (GetParam()) {
      case 0:
        return test::hard_sample();
      case 1:
        return test::soft_sample();
      case 2:
        return test::no_adhesion();
      case 3:
        return test::pushes_beyond_pull_off();
      default:
        return test::lets_go_pressed();
    }
  }
};

// Otherwise the force could never be turned on.
TEST_P(RecordedContact, IsFaintWhereTheForceIsTurnedOn) {
  const Felt sample = felt(curve());
  const double release_m = sample.model->scaling().release_height_m();
  for (double above_m = SafetyGovernor::kArmingMarginM; above_m < 0.02; above_m += 0.5e-3) {
    const Touch here = sample.model->step({0.0, 0.0, release_m + above_m});
    EXPECT_LT(glm::length(here.hand_force_n), SafetyGovernor::kArmingForceN) << 1e3 * above_m << " mm above";
  }
}

// Motion at 50 mm/s with turns at several depths and heights, one of them between snap-in and pull-off.
TEST_P(RecordedContact, GivesAHandNoMoreThanItStores) {
  const Felt sample = felt(curve());
  ContactModel& model = *sample.model;
  const double bottom_m = std::max(-0.02, model.scaling().hand_height_m(sample.tables->pressed_to.si));
  const double off_m = model.scaling().hand_height_m(sample.tables->figures.z_joc.si);
  double height_m = off_m + 0.02;
  PassivityObserver observer;
  Touch before = model.step({0.0, 0.0, height_m});
  PassivityObserver::Law stored = model.energy(before);
  double worst_j = 0.0;
  for (const double turn_m : {0.5 * bottom_m, 0.5 * off_m, 0.6 * bottom_m, 0.3 * bottom_m, bottom_m, off_m + 0.02,
                              0.1 * bottom_m, off_m + 0.02}) {
    const double step_m = std::copysign(50e-6, turn_m - height_m);
    while (std::abs(turn_m - height_m) > std::abs(step_m)) {
      height_m += step_m;
      const Touch here = model.step({0.0, 0.0, height_m});
      const PassivityObserver::Law now = model.energy(here);
      observer.integrate({.moved_m = {0.0, 0.0, step_m},
                          .wanted_n = before.hand_force_n,
                          .commanded_n = before.hand_force_n,
                          .stored_rise_j = now.stored_j - stored.stored_j,
                          .stiffness_n_per_m = now.stiffness_n_per_m});
      worst_j = std::max(worst_j, observer.excess_j());
      before = here;
      stored = now;
    }
  }
  EXPECT_LT(worst_j, 0.1 * PassivityObserver::kLimitJ);
}

TEST_P(RecordedContact, StaysBelowTheStiffnessThatAHandTolerates) {
  const Felt sample = felt(curve());
  ContactModel& model = *sample.model;
  const double bottom_m = model.scaling().hand_height_m(sample.tables->pressed_to.si);
  double height_m = model.scaling().hand_height_m(sample.tables->figures.z_joc.si) + 0.02;
  const double in_m = model.scaling().hand_height_m(sample.tables->figures.z_jtc.si);
  Touch before = model.step({0.0, 0.0, height_m});
  constexpr double kStepM = 50e-6;
  for (; height_m > std::max(bottom_m, -0.02); height_m -= kStepM) {
    const Touch here = model.step({0.0, 0.0, height_m - kStepM});
    if (std::abs(height_m - in_m) > 2 * kStepM) {
      EXPECT_LT((here.hand_force_n.z - before.hand_force_n.z) / kStepM, 1.01 * Scaling::kMaxStiffnessNPerM);
    }
    before = here;
  }
}

INSTANTIATE_TEST_SUITE_P(Recordings, RecordedContact, testing::Range(0, 5));

}  // namespace recorded_contact_test
}  // namespace afm::haptics
