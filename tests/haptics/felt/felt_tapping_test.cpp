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

// What the mean force gives a hand that goes around both jumps forty times a second, as it is and behind an energy
// tank, which lets no force pass that it cannot pay.
TEST(FeltTapping, GivesAHandThatLoopsByItsMeanForceNoMoreThanTheEnergyTankHolds) {
  constexpr double kLoopsPerS = 40.0, kSeconds = 40.0, kLowNm = 15.5, kHighNm = 20.0;
  const auto model = test::model_of(tapped_polymer());
  model->use(scene::ScaleMode::Fit);
  const auto height_m = [&](double seconds) {
    const double turn = seconds * kLoopsPerS - std::floor(seconds * kLoopsPerS);
    return model->scaling().hand_height_m(1e-9 * (kLowNm + (kHighNm - kLowNm) * std::abs(2.0 * turn - 1.0)));
  };
  EnergyTank tank;
  double free_j = 0.0, behind_tank_j = 0.0, most_over_j = -HUGE_VAL;
  double at_m = model->scaling().hand_height_m(24e-9), mean_n = 0.0;
  (void)model->step({0.0, 0.0, at_m});
  for (int i = 1; i <= static_cast<int>(kSeconds / kPeriodS); ++i) {
    const double to_m = height_m(kPeriodS * i), given_j = mean_n * (to_m - at_m);
    free_j += given_j;
    tank.refill(kPeriodS);
    if (given_j <= tank.held_j()) {
      tank.take(given_j);
      behind_tank_j += given_j;
    }
    most_over_j = std::max(most_over_j, behind_tank_j - EnergyTank::kFullJ - EnergyTank::kRefillW * kPeriodS * i);
    at_m = to_m;
    mean_n = model->scaling().hand_force_n(model->step({0.0, 0.0, at_m}).response.force.si);
  }
  RecordProperty("mean_force_mw", std::to_string(1e3 * free_j / kSeconds));
  EXPECT_LE(most_over_j, 1e-12);
  EXPECT_GT(free_j, EnergyTank::kFullJ + EnergyTank::kRefillW * kSeconds) << "without the tank it would";
}

// The program's gold under a lever in air: a contact that is stiff and adheres.
TEST(FeltTapping, IsFeltOnGoldDownToTheSurface) {
  scene::SharedContact gold = tapped_polymer();
  gold.contact.tip_radius = physics::Length(50e-9);
  gold.contact.hamaker = physics::Energy(120e-21);
  gold.contact.mean_surface_energy = physics::SurfaceEnergy(15.915e-3);
  gold.contact.reduced_modulus = physics::Pressure(71.4e9);
  for (const double speed_m_per_s : {0.01, 0.1, 0.3}) {
    TappingHand hand(gold);
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
