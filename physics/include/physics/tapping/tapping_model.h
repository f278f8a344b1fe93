// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "physics/contact_phase.h"
#include "physics/force_model.h"
#include "physics/law.h"
#include "physics/law_tables.h"
#include "physics/units.h"

namespace afm::physics {

class TapEnvelope;
class TapSurface;
struct DrivenLever;

// Longest relaxation 2Q/w0 of a lever that taps under a hand: a push that follows the hand later acts as negative
// damping, by its stiffness times this time.
inline constexpr Time kLongestFeltRelaxation{2e-3};

// The push that a hand feels from a lever that taps, as the share of the drive's force k a that the sample takes:
//
//   P = k a (A0 - A)/A0.
//
// The branches at rest are attractive ("free") and repulsive ("attached"). The loop of P takes energy from the hand;
// that of the mean force would give energy to it, which the drive pays.
Force tap_push(const DrivenLever& lever, Length amplitude) noexcept;

// P of both branches over Z, as a slow hand meets them; its jumps are the folds. Without jumps the branches meet where
// the mean swing is neither attracted nor repelled, or never. Below LawTables::pressed_to, where a tenth of the free
// amplitude is left, P stays constant: a tip that swings less may stick, and would push more on the way up. By the
// averaged flow, or below its least Q (AveragedFlow::kLeastQuality) by direct integration
// (physics/tapping/tap_table.h). Throws UnphysicalValue unless the relaxation is at most kLongestFeltRelaxation. Takes
// tenths of a second, by direct integration some seconds, and allocates.
std::shared_ptr<const LawTables> tapped_law_tables(Law law, const std::shared_ptr<const TapSurface>& surface,
                                                   const DrivenLever& lever);

// A lever that taps under a hand: TapEnvelope, whose base follows Z.
//
// - The mean force over a swing, and the mean pose, are the response; the push is push().
// - Free: attracted on balance, or free; Attached: repelled. Where the branches have jumps, passing from one to the
//   other is an event, JumpToRepulsion or JumpToAttraction, with Z interpolated and the mean forces of this tick
//   and of the second one before it, since a jump lasts about a tick.
// - A step simulates at most kMostSteps of TapEnvelope::longest_step(); a faster lever is in slow motion. A lever that
//   follows a table by direct integration never is.
// - A Z that is not finite gives zero force and the wait state.
//
// step() and wait_for_lift() do not allocate, lock or throw: they are for one servo thread.
class TappingModel {
 public:
  static constexpr int kMostSteps = 48;

  // `tables` are tapped_law_tables() of this surface and lever. Starts in WaitForLift. Takes tenths of a second, unless
  // the tables are by direct integration.
  TappingModel(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever,
               std::shared_ptr<const LawTables> tables, Time tick_period);
  ~TappingModel();
  TappingModel(TappingModel&& other) noexcept;
  TappingModel& operator=(TappingModel&& other) noexcept;

  // The response at Z after a straight path from the previous step's Z.
  TipResponse step(Length z) noexcept;

  // Resets the model at a start, a change of material or a dropout: no force until Z is above both jumps.
  void wait_for_lift() noexcept { phase_ = Phase::WaitForLift; }

  Phase phase() const noexcept { return phase_; }
  Length amplitude() const noexcept;
  double phase_lag() const noexcept;                            // lag behind the drive, rad
  Force push() const noexcept { return push_; }                 // push felt by the hand; zero while waiting
  double slow_motion() const noexcept { return slow_motion_; }  // slow-motion factor, as in DynamicModel

 private:
  void watch(Length before, Length after, double fraction, TipResponse& response) noexcept;
  bool passes_end(double fraction) noexcept;
  bool passes_free_phase(Length before, Length after, double fraction) noexcept;
  Force felt_at_rest(Length z) const noexcept;

  std::shared_ptr<const LawTables> tables_;
  std::unique_ptr<TapEnvelope> envelope_;
  double angle_ = 0;  // angle of a step, in w0 t
  double slow_motion_ = 1;
  Phase phase_ = Phase::WaitForLift;
  Length floor_;  // lowest base that still changes the swing, LawTables::pressed_to
  Length previous_z_, crossed_z_;
  Force push_, previous_mean_, older_mean_;
  double previous_attraction_ = 0, crossed_fraction_ = 1;
};

}  // namespace afm::physics
