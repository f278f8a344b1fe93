// SPDX-License-Identifier: Apache-2.0
#include "exhibit/moment.h"

#include <algorithm>

namespace afm::exhibit {

namespace {

constexpr double kTurnM = 0.2e-9;  // Z must rise this far above its lowest before it counts as retracting

}  // namespace

WallScene::Pose pose_of(const Moment& moment) {
  using enum WallScene::Exhibit;
  const auto exhibit = moment.journey_orders ? Journey
                       : moment.compare_all  ? Plot
                       : moment.analogy      ? Analogy
                                             : Instrument;
  return {.material = moment.material,
          .tip = moment.tip,
          .hovered = moment.hovered,
          .wand = moment.wand,
          .exhibit = exhibit,
          .journey_orders = moment.journey_orders.value_or(0.0),
          .fade = moment.fade,
          .navigation = moment.navigation,
          .cue = moment.cue};
}

bool is_retracting(double z_m, double deepest_z_m) { return z_m > deepest_z_m + kTurnM; }

Moment moment_of(const scene::TipState& tip, bool retracting) {
  Moment now;
  if (tip.material >= 0) now.material = static_cast<std::size_t>(tip.material);
  now.tip = {.z_m = tip.z_m,
             .deflection_m = tip.deflection_m,
             .z_joc_m = tip.release_z_m,
             .xy_m = {tip.tip_xy_m[0], tip.tip_xy_m[1]},
             .surface_height_m = tip.surface_height_m};
  now.force_n = tip.force_n;
  now.servo_state = tip.servo_state;
  now.phase = tip.phase;
  now.retracting = retracting;
  now.realtime = tip.realtime != 0;
  now.slow_motion = tip.slow_motion;
  return now;
}

Moment moment_of(const servo::RecordedSession& session, std::size_t material, std::int64_t time_ns,
                 std::span<const CycleCurve> curves) {
  const auto after = std::upper_bound(session.samples.begin(), session.samples.end(), time_ns,
                                      [](std::int64_t t, const scene::TipSample& s) { return t < s.time_ns; });
  const scene::TipSample& sample = after == session.samples.begin() ? session.samples.front() : *(after - 1);
  const auto lowest =
      std::min_element(session.samples.begin(), after, [](const auto& a, const auto& b) { return a.z_m < b.z_m; });

  Moment then;
  then.material = material;
  then.tip = {.z_m = sample.z_m,
              .deflection_m = sample.deflection_m,
              .xy_m = {sample.tip_xy_m[0], sample.tip_xy_m[1]},
              .surface_height_m = sample.surface_height_m};
  then.force_n = sample.force_n;
  then.servo_state = sample.servo_state;
  then.phase = sample.phase;
  then.retracting = lowest != after && is_retracting(sample.z_m, lowest->z_m);
  then.realtime = session.realtime;
  then.slow_motion = session.slow_motion;
  then.cue = jump_cue(session.events, time_ns);
  then.curves = curves;
  return then;
}

}  // namespace afm::exhibit
