// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace afm::haptics {

// Limits the energy that an active mechanism may give a hand, by a tank (Franken et al., IEEE Trans. Robot. 27, 741
// (2011), on passivity by tanks): kFullJ at once and kRefillW on average, whatever is requested. May be used in a tick
// of the servo.
class EnergyTank {
 public:
  static constexpr double kFullJ = 0.03;    // capacity: energy of a hand of 0.12 kg at 0.7 m/s
  static constexpr double kRefillW = 0.05;  // refill rate: 0.6 N at 80 mm/s

  void fill() noexcept { held_j_ = kFullJ; }
  void refill(double elapsed_s) noexcept { held_j_ = std::min(kFullJ, held_j_ + kRefillW * elapsed_s); }

  // Removes energy, at most the tank's contents within rounding. A negative `wanted_j` changes nothing: returned energy
  // is not stored.
  void take(double wanted_j) noexcept { held_j_ = std::max(0.0, held_j_ - std::max(0.0, wanted_j)); }
  double held_j() const noexcept { return held_j_; }

 private:
  double held_j_ = kFullJ;
};

}  // namespace afm::haptics
