// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/moment.h"

#include <algorithm>

#include "core/enumerators.h"

namespace afm::exhibit {

namespace {

constexpr std::int64_t kStrobePeriodNs = 1'000'000'000;  // period of the stroboscope's swing
constexpr double kTurnM = 0.2e-9;                        // rise of Z above its minimum that counts as retracting

// Fields common to the newest state and a recorded sample.
template <class TipRecord>
Moment moment_from(const TipRecord& record) {
  Moment moment;
  moment.wall.tip = record.tip;
  moment.wall.surface = record.surface;
  moment.wall.swing = record.swing;
  moment.wall.strobe_turns =
      static_cast<double>(record.time_ns % kStrobePeriodNs) / static_cast<double>(kStrobePeriodNs);
  moment.servo_state = record.servo_state;
  moment.phase = record.phase;
  return moment;
}

}  // namespace

bool is_stopped(const scene::TipState& tip) { return tip.fault == scene::FaultCode::StopPressed; }

Phrase state_phrase(scene::ServoState state, bool stopped) {
  static_assert(after(Phrase::StateOff, core::kEnumerators<scene::ServoState>.size()) == Phrase::StateStopped);
  if (stopped && state == scene::ServoState::Fault) return Phrase::StateStopped;
  return after(Phrase::StateOff, core::index_of(state));
}

bool is_retracting(double z_m, double deepest_z_m) { return z_m > deepest_z_m + kTurnM; }

Moment moment_of(const scene::TipState& tip, bool retracting) {
  Moment now = moment_from(tip);
  if (tip.material >= 0) now.wall.material = static_cast<std::size_t>(tip.material);
  now.wall.release_z_m = tip.active.release_z_m;
  now.retracting = retracting;
  now.stopped = is_stopped(tip);
  now.realtime = tip.realtime != 0;
  now.slow_motion = tip.active.slow_motion;
  return now;
}

Moment moment_of(const servo::RecordedSession& session, std::size_t material, std::int64_t time_ns,
                 std::span<const CycleCurve> curves) {
  const auto after = std::upper_bound(session.samples.begin(), session.samples.end(), time_ns,
                                      [](std::int64_t t, const scene::TipSample& s) { return t < s.time_ns; });
  const scene::TipSample& sample = after == session.samples.begin() ? session.samples.front() : *(after - 1);
  const auto lowest = std::min_element(session.samples.begin(), after,
                                       [](const auto& a, const auto& b) { return a.tip.z_m < b.tip.z_m; });

  Moment then = moment_from(sample);
  then.wall.material = material;
  then.wall.cue = jump_cue(session.events, time_ns);
  then.retracting = lowest != after && is_retracting(sample.tip.z_m, lowest->tip.z_m);
  then.stopped = sample.renderer == scene::RendererLink::Stopped;
  then.realtime = session.realtime;
  then.slow_motion = session.slow_motion;
  then.curves = curves;
  return then;
}

}  // namespace afm::exhibit
