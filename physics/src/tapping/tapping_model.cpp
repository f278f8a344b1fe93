// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tapping_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/driven_lever.h"
#include "physics/tapping/felt_swing.h"
#include "physics/tapping/tap_envelope.h"
#include "physics/tapping/tap_surface.h"

namespace afm::physics {
namespace {

// Sine of the phase's excess beyond which the lever is in the other state: no chatter of a free swing.
constexpr double kClearState = 0.02;

constexpr double kLeastSwing = 0.05;  // smallest swing that can change its state, as a share of the free amplitude
constexpr int kLooks = 24;            // number of checks of the state per step

TapEnvelope envelope_of(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever,
                        const LawTables& tables) {
  if (tables.taps) return TapEnvelope(tables.taps);
  AveragedFlow flow(surface, lever, AveragedFlow::Search::AsFelt);
  return {flow, surface->contact_height()};
}

}  // namespace

TappingModel::TappingModel(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever,
                           std::shared_ptr<const LawTables> tables, Time tick_period)
    : tables_(std::move(tables)),
      envelope_(std::make_unique<TapEnvelope>(envelope_of(surface, lever, *tables_))),
      floor_(tables_->pressed_to) {
  const double whole = lever.angular_resonance() * tick_period.si;
  angle_ = envelope_->at_rest_only() ? whole : std::min(whole, kMostSteps * TapEnvelope::longest_step(lever));
  slow_motion_ = whole / angle_;
}

TappingModel::~TappingModel() = default;
TappingModel::TappingModel(TappingModel&& other) noexcept = default;
TappingModel& TappingModel::operator=(TappingModel&& other) noexcept = default;

Length TappingModel::amplitude() const noexcept { return Length(envelope_->amplitude_m()); }
double TappingModel::phase_lag() const noexcept { return envelope_->phase_rad(); }

// The branch of a table ends where the walk has left it, whatever the phase does on the way there.
bool TappingModel::passes_end(double fraction) noexcept {
  const bool repelled = phase_ == Phase::Attached;
  if (envelope_->repelled() == repelled) return false;
  crossed_z_ = repelled ? tables_->figures.z_joc : tables_->figures.z_jtc;
  crossed_fraction_ = fraction;
  return true;
}

// The averaged swing changes its state where its phase passes that of the free lever.
bool TappingModel::passes_free_phase(Length before, Length after, double fraction) noexcept {
  if (envelope_->amplitude_m() < kLeastSwing * envelope_->lever().free_amplitude.si) return false;
  const double attraction = envelope_->attraction();
  if ((attraction > 0.0) != (previous_attraction_ > 0.0)) {
    const double share = previous_attraction_ / (previous_attraction_ - attraction);
    crossed_z_ = before + share * (after - before);
    crossed_fraction_ = fraction;
  }
  previous_attraction_ = attraction;
  if (phase_ != Phase::Attached) return attraction < -kClearState;
  // below the fold on the way down, where only the repulsive state is, a nearly stopped swing may be attracted on
  // average
  if (tables_->figures.hysteretic && after < tables_->figures.z_jtc) return false;
  if (attraction > kClearState) return true;
  if (after < tables_->figures.z_joc || attraction <= -kClearState) return false;
  // onto the free swing, whose phase it need not cross
  if (attraction <= 0.0 && envelope_->lever().jump_off == JumpOff::WhereSeen) {
    crossed_z_ = after;
    crossed_fraction_ = fraction;
  }
  return true;
}

void TappingModel::watch(Length before, Length after, double fraction, TipResponse& response) noexcept {
  const bool changes = envelope_->at_rest_only() ? passes_end(fraction) : passes_free_phase(before, after, fraction);
  if (!changes) return;
  const bool repelled = phase_ == Phase::Attached;
  phase_ = repelled ? Phase::Free : Phase::Attached;
  if (!tables_->figures.hysteretic || response.event_count == response.events.size()) return;
  response.add({.kind = repelled ? EventKind::JumpToAttraction : EventKind::JumpToRepulsion,
                .z = crossed_z_,
                .force_before = older_mean_,
                .force_after = Force(envelope_->mean_force_n()),
                .fraction = crossed_fraction_});
}

Force TappingModel::felt_at_rest(Length z) const noexcept {
  return (phase_ == Phase::Attached ? tables_->attached : tables_->free).force(z);
}

TipResponse TappingModel::step(Length z) noexcept {
  TipResponse response;
  push_ = Force();
  if (!isfinite(z)) {
    wait_for_lift();
    return response;
  }
  const DrivenLever& lever = envelope_->lever();
  if (phase_ == Phase::WaitForLift) {
    response.tip_height = z;
    if (z <= tables_->figures.z_joc) return response;
    envelope_->place({lever.free_amplitude, lever.free_phase}, z.si);
    phase_ = Phase::Free;
    previous_z_ = crossed_z_ = z;
    older_mean_ = previous_mean_ = Force(envelope_->mean_force_n());
    previous_attraction_ = 0.0;
  }
  crossed_fraction_ = 0.0;
  const Length from = previous_z_, way = z - previous_z_;
  for (int i = 1; i <= kLooks; ++i) {
    const Length before = previous_z_, after = i == kLooks ? z : from + (static_cast<double>(i) / kLooks) * way;
    envelope_->advance(std::max(before, floor_).si, std::max(after, floor_).si, angle_ / kLooks, kMostSteps / kLooks);
    watch(before, after, static_cast<double>(i) / kLooks, response);
    previous_z_ = after;
  }
  const Force mean(envelope_->mean_force_n());
  // written so that NaN fails
  if (!(isfinite(mean) && amplitude() <= kLostSwingShare * lever.free_amplitude)) {
    wait_for_lift();
    return response;
  }
  older_mean_ = std::exchange(previous_mean_, mean);
  push_ = tables_->taps ? felt_at_rest(z) : tap_push(lever, amplitude());
  response.phase = phase_;
  response.force = mean;
  response.cantilever_deflection = -mean / lever.spring_constant;
  response.tip_height = z - response.cantilever_deflection;
  response.sample_deformation = -(mean / tables_->contact.sample_stiffness);
  return response;
}

}  // namespace afm::physics
