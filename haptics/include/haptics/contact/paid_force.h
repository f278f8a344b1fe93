// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "haptics/energy_tank.h"

namespace afm::haptics {

// A force on a hand that another source drives, such as the mean force of a lever that taps: whatever it gives over a
// path is what the hand has put in before, or is paid by an EnergyTank. On balance it gives at most EnergyTank::kFullJ
// and EnergyTank::kRefillW, whatever the path. Below kReserveJ of both together the force fades in proportion, so that
// no step of a tick can take more than there is.
//
// May be used in a tick of the servo.
class PaidForce {
 public:
  static constexpr double kReserveJ = 0.01;  // energy reserve, more than 3 N times 3 m/s times 1 ms

  // Call off the sample and without force: forgets the energy that the hand put in.
  void forget() noexcept {
    lent_j_ = paid_j_ = force_n_ = 0.0;
    tank_.fill();
  }

  // The part of `wanted_n` that acts from now on, after the hand has moved by `moved_m` under the previous one.
  double step(double wanted_n, double moved_m, double elapsed_s) noexcept {
    tank_.refill(elapsed_s);
    const double given_j = force_n_ * moved_m, returned_j = std::min(lent_j_, std::max(0.0, given_j));
    lent_j_ += std::max(0.0, -given_j) - returned_j;
    paid_j_ = std::max(0.0, given_j) - returned_j;
    tank_.take(paid_j_);
    force_n_ = wanted_n * std::min(1.0, (tank_.held_j() + lent_j_) / kReserveJ);
    return force_n_;
  }

  double lent_j() const noexcept { return lent_j_; }  // work of the hand that has not been returned to it
  double paid_j() const noexcept { return paid_j_; }  // energy paid by the tank in the newest step

 private:
  EnergyTank tank_;
  double lent_j_ = 0, paid_j_ = 0, force_n_ = 0;
};

}  // namespace afm::haptics
