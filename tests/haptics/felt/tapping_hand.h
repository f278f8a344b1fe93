// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include "haptics/contact_model.h"
#include "haptics/passivity_observer.h"
#include "servo_bench.h"

namespace afm::test {

// Contact with the sample of docs/tapping.md under a lever of 40 N/m at 300 kHz, Q = 400, A0 = 20 nm.
inline scene::SharedContact tapped_polymer() {
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

// Contact with the program's mica in water under a lever of 2 N/m at 30 kHz, A0 = 20 nm.
inline scene::SharedContact tapped_mica(double quality_factor) {
  scene::SharedContact material = tapped_polymer();
  material.name = scene::to_name("mica");
  material.contact.tip_radius = physics::Length(50e-9);
  material.contact.spring_constant = physics::Stiffness(2.0);
  material.contact.hamaker = physics::Energy(24.5e-21);
  material.contact.mean_surface_energy = physics::SurfaceEnergy(2.228e-3);
  material.contact.reduced_modulus = physics::Pressure(51.5e9);
  material.lever.resonance = physics::Frequency(30e3);
  material.lever.quality_factor = quality_factor;
  material.drive_hz = 30e3;
  return material;
}

// A hand on a lever in tapping mode, with the observer's damping added as by the governor.
class TappingHand {
 public:
  static constexpr double kPeriodS = 1e-3;

  // Energy that a path has given to the hand.
  struct Given {
    double push_j = 0,
           mean_j = 0;  // energy of the felt push with its damping; energy of the mean force, if that were felt
    double most_excess_j = 0;
  };

  explicit TappingHand(const scene::SharedContact& material) : model_(model_of(material)) {
    model_->use(scene::ScaleMode::Fit);
  }

  const haptics::ContactModel& model() const { return *model_; }
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

  double z_nm() const { return model_->scaling().z_m(at_m_) * 1e9; }
  double excess_j() const { return observer_.excess_j(); }
  double push_n() const { return push_n_; }

 private:
  void tick(double moved_m, Given& given) {
    const double damping = observer_.damping_n_s_per_m({0.0, 0.0, moved_m / kPeriodS}, kPeriodS);
    const double damped_n = push_n_ - damping * moved_m / kPeriodS;
    at_m_ += moved_m;
    const haptics::Touch touch = model_->step({0.0, 0.0, at_m_});
    const haptics::PassivityObserver::Law law = model_->energy(touch);
    given.push_j += damped_n * moved_m;
    given.mean_j += mean_n_ * moved_m;
    // as in the governor: ticks with a change of branch do not count
    if (touch.response.phase == phase_) {
      observer_.integrate({.moved_m = {0.0, 0.0, moved_m},
                           .wanted_n = {0.0, 0.0, push_n_},
                           .commanded_n = {0.0, 0.0, damped_n},
                           .stored_rise_j = law.stored_j - law.given_j - stored_j_,
                           .stiffness_n_per_m = law.stiffness_n_per_m});
    }
    given.most_excess_j = std::max(given.most_excess_j, observer_.excess_j());
    phase_ = touch.response.phase;
    stored_j_ = law.stored_j;
    push_n_ = touch.hand_force_n.z;
    mean_n_ = model_->scaling().hand_force_n(touch.response.force.si);
  }

  std::unique_ptr<haptics::ContactModel> model_;
  haptics::PassivityObserver observer_;
  physics::Phase phase_ = physics::Phase::WaitForLift;
  double at_m_ = 0, push_n_ = 0, mean_n_ = 0, stored_j_ = 0;
};

// Largest energy given by random closed paths.
inline TappingHand::Given worst_of(const scene::SharedContact& material, int paths) {
  TappingHand hand(material);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> height_nm(1.0, 23.0), speed_m_per_s(0.005, 0.1);
  constexpr double kHighestNm = 24.0;
  TappingHand::Given most;
  for (int path = 0; path < paths; ++path) {
    TappingHand::Given given;
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

}  // namespace afm::test
