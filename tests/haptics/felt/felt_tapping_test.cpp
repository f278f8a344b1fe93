// SPDX-License-Identifier: Apache-2.0
// A hand on a lever that taps, on random closed paths.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "felt/tapping_hand.h"
#include "haptics/contact_model.h"
#include "haptics/energy_tank.h"
#include "servo_bench.h"
#include "support/deep.h"

namespace afm::haptics {
namespace felt_tapping_test {

using test::tapped_polymer;
using test::TappingHand;
using test::worst_of;
using Given = TappingHand::Given;

constexpr double kPeriodS = TappingHand::kPeriodS;

TEST(FeltTapping, GivesAHandNoEnergyOnAnyClosedPathWhileItsMeanForceWould) {
  const Given most = worst_of(tapped_polymer(), support::deep() ? 10'000 : 100);
  EXPECT_LT(most.push_j, 1e-4);
  EXPECT_LT(most.most_excess_j, PassivityObserver::kLimitJ);
  EXPECT_GT(most.mean_j, 5e-3);
}

// Height of a hand that goes to and fro over both jumps.
double looping_height_m(const ContactModel& model, double loops_per_s, double seconds) {
  constexpr double kLowNm = 15.5, kHighNm = 20.0;
  const double turn = seconds * loops_per_s - std::floor(seconds * loops_per_s);
  return model.scaling().hand_height_m(1e-9 * (kLowNm + (kHighNm - kLowNm) * std::abs(2.0 * turn - 1.0)));
}

// Criterion: a hand that goes around both jumps five times a second gets at most 50 mW by the felt mean force, and one
// of forty, too, which would get more without the tank.
TEST(FeltTapping, GivesAHandThatLoopsByItsMeanForceNoMoreThanTheEnergyTankHolds) {
  for (const double loops_per_s : {5.0, 40.0}) {
    constexpr double kSeconds = 40.0;
    scene::SharedContact polymer = tapped_polymer();
    polymer.felt_mean_force = 1;
    const auto model = test::model_of(polymer);
    model->use(scene::ScaleMode::Fit);
    double free_j = 0.0, felt_j = 0.0, most_over_j = -HUGE_VAL, weakest = 1.0;
    double at_m = model->scaling().hand_height_m(24e-9), felt_n = 0.0, mean_n = 0.0;
    (void)model->step({0.0, 0.0, at_m}, {.elapsed_s = kPeriodS});
    for (int i = 1; i <= static_cast<int>(kSeconds / kPeriodS); ++i) {
      const double to_m = looping_height_m(*model, loops_per_s, kPeriodS * i);
      free_j += mean_n * (to_m - at_m);
      felt_j += felt_n * (to_m - at_m);
      most_over_j = std::max(most_over_j, felt_j - EnergyTank::kFullJ - EnergyTank::kRefillW * kPeriodS * i);
      at_m = to_m;
      const Touch touch = model->step({0.0, 0.0, at_m}, {.elapsed_s = kPeriodS});
      felt_n = touch.hand_force_n.z;
      mean_n = model->scaling().hand_force_n(touch.response.force.si);
      if (std::abs(mean_n) > 0.1) weakest = std::min(weakest, felt_n / mean_n);
    }
    const std::string at = "_at_" + std::to_string(static_cast<int>(loops_per_s));
    RecordProperty("mean_force_mw" + at, std::to_string(1e3 * free_j / kSeconds));
    RecordProperty("felt_mw" + at, std::to_string(1e3 * felt_j / kSeconds));
    EXPECT_LE(most_over_j, 1e-9) << loops_per_s;
    EXPECT_GT(felt_j, 0.01 * kSeconds) << "it is felt";
    if (loops_per_s < 10.0) continue;  // power below the tank's own
    EXPECT_GT(free_j, EnergyTank::kFullJ + EnergyTank::kRefillW * kSeconds) << "without the tank it would";
    EXPECT_LT(weakest, 0.9) << "the force fades";
  }
}

// A slow hand feels the whole mean force: a pull above the jump in, a push below it.
TEST(FeltTapping, LetsTheMeanForceBeFeltInPlaceOfThePush) {
  scene::SharedContact polymer = tapped_polymer();
  polymer.felt_mean_force = 1;
  const auto model = test::model_of(polymer);
  model->use(scene::ScaleMode::Fit);
  const auto felt_n = [&](double z_nm) {
    return model->step({0.0, 0.0, model->scaling().hand_height_m(1e-9 * z_nm)}, {.elapsed_s = kPeriodS}).hand_force_n.z;
  };
  (void)felt_n(24.0);
  double nm = 24.0, attracted_n = 0.0, repelled_n = 0.0;
  for (; nm > 17.0; nm -= 0.01) attracted_n = felt_n(nm);
  for (; nm > 14.0; nm -= 0.01) repelled_n = felt_n(nm);
  EXPECT_NEAR(attracted_n, model->scaling().hand_force_n(-0.5e-9), std::abs(model->scaling().hand_force_n(0.1e-9)));
  EXPECT_GT(repelled_n, model->scaling().hand_force_n(0.3e-9));
}

TEST(FeltTapping, GivesNoEnergyByItsMeanForceOnClosedPathsThatItsTankDoesNotHold) {
  scene::SharedContact polymer = tapped_polymer();
  polymer.felt_mean_force = 1;
  const Given most = worst_of(polymer, support::deep() ? 2000 : 100);
  EXPECT_LT(most.push_j, EnergyTank::kFullJ);
  EXPECT_LT(most.most_excess_j, PassivityObserver::kLimitJ);
}

// The program's gold under a lever in air: a contact that is stiff and adheres.
TEST(FeltTapping, IsFeltOnGoldDownToTheSurface) {
  scene::SharedContact gold = tapped_polymer();
  gold.contact.tip_radius = physics::Length(50e-9);
  gold.contact.hamaker = physics::Energy(120e-21);
  gold.contact.mean_surface_energy = physics::SurfaceEnergy(15.915e-3);
  gold.contact.reduced_modulus = physics::Pressure(71.4e9);
  TappingHand hand(gold);
  for (const double speed_m_per_s : {0.01, 0.1, 0.3}) {
    Given given;
    hand.rest_at(24.0);
    hand.move_to(0.0, speed_m_per_s, given);
    hand.move_to(24.0, speed_m_per_s, given);
    RecordProperty("most_excess_uj_at_" + std::to_string(static_cast<int>(1e3 * speed_m_per_s)) + "_mm_per_s",
                   std::to_string(given.most_excess_j * 1e6));
    EXPECT_LT(given.most_excess_j, PassivityObserver::kLimitJ) << speed_m_per_s;
  }
  EXPECT_LT(worst_of(gold, support::deep() ? 1000 : 50).most_excess_j, PassivityObserver::kLimitJ);
}

}  // namespace felt_tapping_test
}  // namespace afm::haptics
