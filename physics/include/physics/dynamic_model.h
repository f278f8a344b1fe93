// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "physics/contact_parameters.h"
#include "physics/cycle_figures.h"
#include "physics/force_model.h"
#include "physics/law.h"
#include "physics/lever_dynamics.h"
#include "physics/tip_oscillator.h"
#include "physics/units.h"

namespace afm::physics {

// A force law felt through a lever with mass, damping and thermal noise: ApproachRetractModel with time. The tip is a
// point mass (physics/tip_oscillator.h) under the law of fixed grips, so jumps take time, overshoot and ring.
//
// Output: the force is the lever's, k (z - Z) averaged over the step, which at rest is the force on the tip by the
// sample with the sign of physics/contact.h. It is never F_ts itself, which at the impact of a jump to contact is forty
// times as large for microseconds. The mean over a step is a low pass with zeros at multiples of the step rate, which
// suppresses aliasing into the hand. The pose is that of the mean deflection at the step's last Z.
//
// Time: a tip in contact oscillates at some hundred kilohertz. A step simulates at most kSubSteps sub-steps of the
// longest length that is accurate enough. If the physics is faster than that, the simulated time is shorter than a
// tick: slow motion by the factor slow_motion(). The path of Z between two steps is a straight line over the simulated
// time, so the curve in Z is complete, and the hand's speed counts slow_motion() times.
//
// Jumps are detected in the tip's own path. One to contact begins when the tip passes the height from which the resting
// lever would jump (CycleFigures::tip_height_before_jtc) for the last time before contact and ends there; one off
// contact begins at tip_height_before_joc in the same way and ends when the tip is above both heights. The event's Z
// and force_before are those of its beginning, force_after the force at its end, all of the lever and interpolated
// within the sub-step. The step in which it ends reports it, with the time in `fraction`. A lever without hysteresis
// reports none.
//
// - T = 0: deterministic. T > 0: the same seed and steps give the same forces, bit by bit; another step rate divides
//   time differently and gives another path with the same statistics.
// - A Z that is not finite, or a deflection beyond 0.1 mm, gives zero force and the wait state.
//
// step(), wait_for_lift() and settle() do not allocate, lock or throw: they are for one servo thread. Copies share the
// tables.
class DynamicModel {
 public:
  static constexpr std::int64_t kSubSteps = 256;
  static constexpr std::int64_t kLongestStep = 1'000'000'000;  // limit of sub-steps per step of simulating()
  static constexpr std::uint64_t kDefaultSeed = 1;

  // Starts in WaitForLift. Throws std::invalid_argument (UnphysicalValue if one field is the cause) as
  // build_law_tables() and validate() do, for a law without dynamics, and for an invalid tick period. Allocates and
  // takes some milliseconds.
  DynamicModel(Law law, const ContactParameters& contact, const LeverDynamics& lever, Time tick_period,
               const LawOptions& options = {}, std::uint64_t seed = kDefaultSeed);

  // The model, waiting, with a step() that simulates exactly this time in as many sub-steps as necessary, for curves.
  // (Beyond kLongestStep sub-steps it is in slow motion again.) Throws std::invalid_argument for an invalid time.
  DynamicModel simulating(Time per_step) const;

  // The response at Z after a straight path from the previous step's Z.
  TipResponse step(Length z) noexcept;

  // Resets the model at a start, a change of material or a dropout: no force until Z > Z_joc. Restarts the noise, so
  // that the results depend only on later steps.
  void wait_for_lift() noexcept;

  // Free and at rest at Z, or in steady motion with a base of this velocity. Z must be above Z_jtc.
  void settle(Length z, Velocity base_velocity = Velocity()) noexcept;

  Phase phase() const noexcept { return phase_; }
  Law law() const noexcept { return setup_->law; }
  const ContactParameters& contact() const noexcept { return setup_->contact; }
  const LeverDynamics& lever() const noexcept { return setup_->lever; }

  // Figures of the same law and lever without dynamics.
  const CycleFigures& figures() const noexcept { return setup_->figures; }

  Time simulated_per_step() const noexcept { return pace_.simulated; }
  Time sub_step() const noexcept { return pace_.simulated / static_cast<double>(pace_.sub_steps); }

  // Duration of a step divided by the time that it simulates; at least 1.
  double slow_motion() const noexcept { return pace_.step_lasts / pace_.simulated; }

 private:
  struct Setup {
    Law law;
    ContactParameters contact;
    LeverDynamics lever;
    CycleFigures figures;
    Length contact_gap;
    std::shared_ptr<const TipForce> surface;
    std::uint64_t seed;
    Length free_above;  // height of the tip at which a jump off contact ends
  };

  static std::shared_ptr<const Setup> build(Law law, const ContactParameters& contact, const LeverDynamics& lever,
                                            const LawOptions& options, std::uint64_t seed);

  // Division of a step into sub-steps.
  struct Pace {
    Time step_lasts;
    Time simulated;
    std::int64_t sub_steps;
  };
  static Pace pace_of(const Setup& setup, Time step_lasts, std::int64_t most_sub_steps);
  DynamicModel(const std::shared_ptr<const Setup>& setup, Time tick_period);
  DynamicModel(std::shared_ptr<const Setup> setup, const Pace& pace);

  // State of the lever at one instant.
  struct Instant {
    Length z;
    Length tip_height;
    Force force;
  };
  Instant now() const noexcept;

  // Heights of the tip where the next possible jump begins and ends.
  struct Jump {
    Length begin;
    Length end;
  };
  Jump awaited_jump() const noexcept;
  static Instant where(Length height, const Instant& before, const Instant& after) noexcept;
  void watch(const Instant& before, const Instant& after, double fraction, TipResponse& response) noexcept;

  std::shared_ptr<const Setup> setup_;
  Pace pace_;
  TipOscillator oscillator_;
  Phase phase_ = Phase::WaitForLift;
  Instant jump_began_;
};

}  // namespace afm::physics
