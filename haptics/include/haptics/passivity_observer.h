// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace afm::haptics {

// A time-domain passivity observer and controller (Hannaford & Ryu 2002), in the units of the hand.
//
// A force law that is felt may hand out what it holds and no more. What it holds is U, the potential of the branch
// under the tip at the hand's height (haptics/potential_energy.h): U far away is the free energy that pulls the tip in,
// for the paper's law 1/2 K z_jtc^2. Over each tick of a passive law, with F held while the hand moves by dx,
//
//   F . dx + dU <= 1/2 K |dx|^2
//
// where the right-hand side is what a spring K that is sampled gives too much. The observer sums left less right; a sum
// above zero is energy that came from nowhere, and one below zero is forgotten: a passive law needs no surplus, and a
// faulty one could hide behind what a jump off contact has lost. A textbook observer, which starts at zero and knows no
// U, would take the snap-in itself for a fault; one that only compares the work with U far away would see a fault when
// all that was stored has been given. This one sees it in the tick in which it happens.
//
// - Of the commanded force and of the one that law and end-stop wanted, the work of the lesser counts. So damping pays
//   back, and what clamp, slew limit and fades do on their own account is not blamed on the law.
// - U, force and K are taken with the gain of their tick: a gain that changes gives or takes storage, not work.
//
// A lever with dynamics and thermal noise (physics/dynamic_model.h) gives more or less than its table, and heat or its
// own motion pays for it. By how much is known in every tick, before anything could spoil it; that much along the way
// is granted, and a tick in which the branch changes does not count.
//
// The controller damps by what would pay the excess back within a tick, kMostDampingNSPerM at most. Beyond kLimitJ that
// did not suffice, and the force has to go.
class PassivityObserver {
 public:
  static constexpr double kToleranceJ = 5e-6;  // above the interpolation error of U
  static constexpr double kMostDampingNSPerM = 4.0;
  static constexpr double kLimitJ = 1e-3;  // a hand of 0.12 kg at 0.13 m/s

  // Quantities of a law at one position that the observer needs, on the hand's scale.
  struct Law {
    double stored_j = 0;           // U
    double stiffness_n_per_m = 0;  // K: no spring in the law is stiffer
    double oscillation_n = 0;      // by how much the lever's own force is off its table's
    bool is_dynamic = false;       // a lever that is never at rest
    double given_j = 0;            // of U: stored in this tick by a touch-down, which the jump to contact has paid
  };

  // One tick that has passed; device frame.
  struct Tick {
    glm::dvec3 moved_m{0.0};
    glm::dvec3 wanted_n{0.0};      // of law and end-stop, with their gains
    glm::dvec3 commanded_n{0.0};   // what the device was given
    double stored_rise_j = 0;      // of U and the end-stop, with their gains
    double stiffness_n_per_m = 0;  // likewise
    double oscillation_n = 0;      // likewise
  };

  void integrate(const Tick& tick) noexcept;
  void reset() noexcept { excess_j_ = 0.0; }

  double excess_j() const noexcept { return excess_j_; }
  bool exceeded() const noexcept { return excess_j_ > kLimitJ; }

  // Damping for the next tick, for a hand at this velocity.
  double damping_n_s_per_m(const glm::dvec3& velocity_m_per_s, double period_s) const noexcept;

 private:
  double excess_j_ = 0.0;
};

}  // namespace afm::haptics
