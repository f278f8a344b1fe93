// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace afm::haptics {

// Energy that a thing which moves by itself may give a hand (Franken et al., IEEE Trans. Robot. 27, 741 (2011), of
// passivity by tanks): kFullJ at once and kRefillW on average, whatever it wants. For a tick of the servo.
class EnergyTank {
 public:
  static constexpr double kFullJ = 0.03;    // a hand of 0.12 kg at 0.7 m/s
  static constexpr double kRefillW = 0.05;  // 0.6 N at 80 mm/s

  void fill() noexcept { held_j_ = kFullJ; }
  void refill(double elapsed_s) noexcept { held_j_ = std::min(kFullJ, held_j_ + kRefillW * elapsed_s); }

  // What is put in is not kept: `wanted_j` below zero changes nothing. At most what the tank holds, by rounding less.
  void take(double wanted_j) noexcept { held_j_ = std::max(0.0, held_j_ - std::max(0.0, wanted_j)); }
  double held_j() const noexcept { return held_j_; }

 private:
  double held_j_ = kFullJ;
};

}  // namespace afm::haptics
