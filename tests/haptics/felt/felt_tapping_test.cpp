// SPDX-License-Identifier: Apache-2.0
// A hand on a lever that taps, on random closed paths, with the observer's damping as the governor adds it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include "haptics/contact_model.h"
#include "haptics/energy_tank.h"
#include "servo_bench.h"
#include "support/deep.h"

namespace afm::haptics {
namespace felt_tapping_test {

constexpr double kPeriodS = 1e-3;

// The sample of docs/tapping.md under a lever of 40 N/m at 300 kHz, Q = 400, A0 = 20 nm.
scene::SharedContact tapped() {
  scene::SharedContact material;
  material.name = scene::to_name("polymer");
  material.law = physics::Law::Dmt;
  material.contact.tip_radius = physics::Length(20e-9);
  material.contact.spring_constant = physics::Stiffness(40.0);
  material.contact.sample_stiffness = physics::Stiffness(HUGE_VAL);
  material.contact.hamaker = physics::Energy(64e-21);
  material.contact.mean_surface_energy = physics::SurfaceEnergy(31.2e-3);
  material.contact.reduced_modulus = physics::Pressure(1.5e9);
  material.lever.resonance = physics::Frequency(300e3);
  material.lever.quality_factor = 400.0;
  material.free_amplitude_m = 20e-9;
  material.drive_hz = 300e3;
  return material;
}

// What a closed path has given to the hand.
struct Given {
  double push_j = 0,
         mean_j = 0;  // energy of the felt push with its damping; energy of the mean force, if that were felt
  double most_excess_j = 0;
};

class Hand {
 public:
  explicit Hand(const scene::SharedContact& material) : model_(test::model_of(material)) {
    model_->use(scene::ScaleMode::Fit);
  }

  double height_m(double z_nm) const { return model_->scaling().hand_height_m(z_nm * 1e-9); }

  void move_to(double z_nm, double speed_m_per_s, Given& given) {
    const double to_m = height_m(z_nm);
    const int ticks = std::max(1, static_cast<int>(std::ceil(std::abs(to_m - at_m_) / (speed_m_per_s * kPeriodS))));
    const double moved_m = (to_m - at_m_) / ticks;
    for (int i = 0; i < ticks; ++i) tick(moved_m, given);
  }

  void rest_at(double z_nm) {
    at_m_ = height_m(z_nm);
    Given ignored;
    for (int i = 0; i < 20; ++i) tick(0.0, ignored);
    observer_.reset();
  }

 private:
  void tick(double moved_m, Given& given) {
    const double damping = observer_.damping_n_s_per_m({0.0, 0.0, moved_m / kPeriodS}, kPeriodS);
    const double damped_n = push_n_ - damping * moved_m / kPeriodS;
    at_m_ += moved_m;
    const Touch touch = model_->step({0.0, 0.0, at_m_});
    const PassivityObserver::Law law = model_->energy(touch);
    given.push_j += damped_n * moved_m;
    given.mean_j += mean_n_ * moved_m;
    // as in the governor: a tick in which the branch changes does not count
    if (touch.response.phase == phase_) {
      observer_.integrate({.moved_m = {0.0, 0.0, moved_m},
                           .wanted_n = {0.0, 0.0, push_n_},
                           .commanded_n = {0.0, 0.0, damped_n},
                           .stored_rise_j = law.stored_j - stored_j_,
                           .stiffness_n_per_m = law.stiffness_n_per_m});
    }
    given.most_excess_j = std::max(given.most_excess_j, observer_.excess_j());
    phase_ = touch.response.phase;
    stored_j_ = law.stored_j;
    push_n_ = touch.hand_force_n.z;
    mean_n_ = model_->scaling().hand_force_n(touch.response.force.si);
  }

  std::unique_ptr<ContactModel> model_;
  PassivityObserver observer_;
  physics::Phase phase_ = physics::Phase::WaitForLift;
  double at_m_ = 0, push_n_ = 0, mean_n_ = 0, stored_j_ = 0;
};

// The most that random closed paths have given.
Given worst_of(const scene::SharedContact& material, int paths) {
  Hand hand(material);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> height_nm(1.0, 23.0), speed_m_per_s(0.005, 0.1);
  constexpr double kHighestNm = 24.0;
  Given most;
  for (int path = 0; path < paths; ++path) {
    Given given;
    hand.rest_at(kHighestNm);
    for (int leg = 0; leg < 4; ++leg) {
      const double to_nm = height_nm(random);
      hand.move_to(to_nm, speed_m_per_s(random), given);
    }
    hand.move_to(kHighestNm, speed_m_per_s(random), given);
    most.push_j = std::max(most.push_j, given.push_j);
    most.mean_j = std::max(most.mean_j, given.mean_j);
    most.most_excess_j = std::max(most.most_excess_j, given.most_excess_j);
  }
  testing::Test::RecordProperty("most_push_uj", std::to_string(most.push_j * 1e6));
  testing::Test::RecordProperty("most_mean_uj", std::to_string(most.mean_j * 1e6));
  testing::Test::RecordProperty("most_excess_uj", std::to_string(most.most_excess_j * 1e6));
  return most;
}

TEST(FeltTapping, GivesAHandNoEnergyOnAnyClosedPathWhileItsMeanForceWould) {
  const Given most = worst_of(tapped(), support::deep() ? 10'000 : 100);
  EXPECT_LT(most.push_j, 1e-4);
  EXPECT_LT(most.most_excess_j, PassivityObserver::kLimitJ);
  EXPECT_GT(most.mean_j, 5e-3);
}

// By direct integration: a soft lever in a liquid, and one just below the least quality factor of the averages, with
// both jumps.
TEST(FeltTapping, GivesAHandNoEnergyAtALowQualityFactor) {
  scene::SharedContact soft = tapped(), bistable = tapped();
  soft.contact.spring_constant = physics::Stiffness(2.0);
  soft.contact.tip_radius = physics::Length(10e-9);
  soft.lever.quality_factor = 20.0;
  bistable.contact.spring_constant = physics::Stiffness(4.0);
  bistable.lever.quality_factor = 99.0;
  for (const scene::SharedContact& material : {soft, bistable}) {
    const Given most = worst_of(material, support::deep() ? 1000 : 50);
    // a push that is held for a tick gives some 0.1 mJ a stroke, as any force of this stiffness does
    EXPECT_LT(most.push_j, 4e-4) << material.lever.quality_factor;
    EXPECT_LT(most.most_excess_j, PassivityObserver::kLimitJ) << material.lever.quality_factor;
  }
}

// What the mean force gives a hand that goes around both jumps forty times a second, as it is and behind an energy
// tank, which lets no force pass that it cannot pay.
TEST(FeltTapping, GivesAHandThatLoopsByItsMeanForceNoMoreThanTheEnergyTankHolds) {
  constexpr double kLoopsPerS = 40.0, kSeconds = 40.0, kLowNm = 15.5, kHighNm = 20.0;
  const auto model = test::model_of(tapped());
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

// The program's gold under a lever in air: a contact that is stiff and adheres. Nearer than 4 nm the observer may
// remove the force (docs/tapping.md).
TEST(FeltTapping, IsFeltOnGoldDownToTheSurface) {
  scene::SharedContact gold = tapped();
  gold.contact.tip_radius = physics::Length(50e-9);
  gold.contact.hamaker = physics::Energy(120e-21);
  gold.contact.mean_surface_energy = physics::SurfaceEnergy(15.915e-3);
  gold.contact.reduced_modulus = physics::Pressure(71.4e9);
  for (const double speed_m_per_s : {0.01, 0.1, 0.3}) {
    Hand hand(gold);
    Given given;
    hand.rest_at(24.0);
    hand.move_to(4.0, speed_m_per_s, given);
    hand.move_to(24.0, speed_m_per_s, given);
    RecordProperty("most_excess_uj_at_" + std::to_string(static_cast<int>(1e3 * speed_m_per_s)) + "_mm_per_s",
                   std::to_string(given.most_excess_j * 1e6));
    EXPECT_LT(given.most_excess_j, PassivityObserver::kLimitJ) << speed_m_per_s;
  }
}

}  // namespace felt_tapping_test
}  // namespace afm::haptics
