// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace afm::haptics {

// A time-domain passivity observer and controller (Hannaford & Ryu 2002), in the units of the hand.
//
// A force law may give the hand the energy it stores, and no more. The stored energy is U, the potential of the branch
// under the tip at the hand's height (haptics/potential_energy.h). Far away, U is the free energy that pulls the tip
// in, for the paper's law 1/2 K z_jtc^2. In each tick of a passive law, with F held while the hand moves by dx,
//
//   F . dx + dU <= 1/2 K |dx|^2
//
// where the right-hand side is the excess energy of a sampled spring K. The observer sums left minus right. A positive
// sum is energy without a source. A negative one is reset to zero: a passive law needs no surplus, and a faulty one
// could hide behind the energy lost in a jump off contact. A textbook observer, which starts at zero and does not know
// U, would mistake the snap-in itself for a fault; one that compares the work only with U far away would detect a fault
// only after all stored energy has been given out. This one detects it in the tick in which it happens.
//
// - Between the commanded force and the force requested by law and end-stop, the smaller work counts. Damping thus pays
//   back, and the effects of clamp, slew limit and fades are not attributed to the law.
// - U, force and K are taken with the gain of their tick: a changing gain changes the stored energy, without work.
//
// A lever with dynamics and thermal noise (physics/dynamic_model.h) gives more or less than its table; heat or its own
// motion pays for the difference. That difference is known in every tick, before anything could corrupt it. Its amount
// along the path is granted, and a tick in which the branch changes does not count.
//
// The controller adds the damping that dissipates the excess within a tick, at most kMostDampingNSPerM. An excess
// beyond kLimitJ shows that this was not enough, and the force must be removed.
class PassivityObserver {
 public:
  static constexpr double kToleranceJ = 5e-6;  // tolerance above the interpolation error of U
  static constexpr double kMostDampingNSPerM = 4.0;
  static constexpr double kLimitJ = 1e-3;  // largest excess energy, that of a hand of 0.12 kg at 0.13 m/s

  // Properties of a law at one position that the observer needs, on the hand's scale.
  struct Law {
    double stored_j = 0;           // U, stored energy
    double stiffness_n_per_m = 0;  // K, upper limit of the law's stiffness
    double oscillation_n = 0;      // difference between the lever's own force and its table
    bool is_dynamic = false;       // true: the lever is never at rest
    double given_j = 0;            // part of U stored in this tick by a touch-down and paid for by the jump to contact
  };

  // A completed tick; device frame.
  struct Tick {
    glm::dvec3 moved_m{0.0};
    glm::dvec3 wanted_n{0.0};      // force requested by law and end-stop, with their gains
    glm::dvec3 commanded_n{0.0};   // force sent to the device
    double stored_rise_j = 0;      // increase of U and of the end-stop's energy, with their gains
    double stiffness_n_per_m = 0;  // stiffness K times its gain
    double oscillation_n = 0;      // oscillation force times its gain
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
