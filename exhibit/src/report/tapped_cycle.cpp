// SPDX-License-Identifier: Apache-2.0
#include "exhibit/report/tapped_cycle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "curves/plot_units.h"
#include "curves/tapping/tapping_output.h"
#include "physics/tapping/driven_lever.h"
#include "scene/shared/shared_segment.h"
#include "servo/session_file.h"

namespace afm::exhibit {

namespace {

constexpr double kLeastSettlingS = 5e-3;
constexpr double kRelaxations = 8.0;  // relaxations after which a change of the swing is below a thousandth

double degrees(double rad) { return rad * 180.0 / std::numbers::pi; }

bool is_felt(const scene::TipSample& sample) {
  return sample.servo_state == scene::ServoState::Running && sample.swing.amplitude_m > 0.0;
}

std::optional<TappedJump> jump_of(const servo::RecordedSession& session, physics::EventKind kind,
                                  std::int64_t settling_ns) {
  const scene::TipEvent* event = session.find(kind);
  if (event == nullptr) return std::nullopt;
  TappedJump jump{.z_m = event->z_m};
  const auto swing_at = [&](std::int64_t time_ns) {
    const auto later = [](std::int64_t time, const scene::TipSample& sample) { return time < sample.time_ns; };
    const auto after = std::upper_bound(session.samples.begin(), session.samples.end(), time_ns, later);
    return after == session.samples.begin() ? scene::Swing() : (after - 1)->swing;
  };
  jump.before = swing_at(event->time_ns - settling_ns);
  jump.after = swing_at(event->time_ns + settling_ns);
  return jump;
}

nlohmann::json swing_json(const scene::Swing& swing) {
  return {{"amplitude_m", swing.amplitude_m}, {"phase_deg", degrees(swing.phase_rad)}};
}

nlohmann::json jump_json(const char* branch, const TappedJump& jump) {
  return {{"branch", branch},
          {"kind", "phase passes that of the free lever"},
          {"z_m", jump.z_m},
          {"before", swing_json(jump.before)},
          {"after", swing_json(jump.after)}};
}

}  // namespace

double TappedCycle::hysteresis_width_m() const {
  return to_repulsion && to_attraction ? to_attraction->z_m - to_repulsion->z_m : 0.0;
}

TappedCycle tapped_cycle(const servo::RecordedSession& session) {
  const physics::DrivenLever lever = scene::tapping_lever(session.parameters);
  TappedCycle cycle{.free_amplitude_m = lever.free_amplitude.si, .drive_hz = session.parameters.drive_hz};
  const double settling_s =
      std::max(kLeastSettlingS, kRelaxations * lever.relaxation().si * std::max(session.slow_motion, 1.0));
  const std::int64_t settling_ns = std::llround(settling_s * 1e9);
  cycle.to_repulsion = jump_of(session, physics::EventKind::JumpToRepulsion, settling_ns);
  cycle.to_attraction = jump_of(session, physics::EventKind::JumpToAttraction, settling_ns);
  const scene::TipSample* before = nullptr;
  for (const scene::TipSample& sample : session.samples) {
    if (!is_felt(sample)) {
      before = nullptr;
      continue;
    }
    if (before != nullptr) {
      const double way_m = sample.tip.z_m - before->tip.z_m;
      const double mean_amplitude_m = 0.5 * (before->swing.amplitude_m + sample.swing.amplitude_m);
      cycle.reduction_loop_m2 += (cycle.free_amplitude_m - mean_amplitude_m) * way_m;
      cycle.mean_force_work_j += 0.5 * (before->tip.force_n + sample.tip.force_n) * way_m;
    }
    before = &sample;
  }
  return cycle;
}

nlohmann::json tapped_json(const TappedCycle& cycle) {
  nlohmann::json jumps = nlohmann::json::array();
  if (cycle.to_repulsion) jumps.push_back(jump_json("approach", *cycle.to_repulsion));
  if (cycle.to_attraction) jumps.push_back(jump_json("retract", *cycle.to_attraction));
  return {{"free_amplitude_m", cycle.free_amplitude_m},
          {"drive_Hz", cycle.drive_hz},
          {"jumps", std::move(jumps)},
          {"hysteresis_width_m", cycle.hysteresis_width_m()},
          {"work_on_hand_by_mean_force_J", cycle.mean_force_work_j},
          {"loop_of_amplitude_reduction_m2", cycle.reduction_loop_m2},
          {"conventions", curves::tapping_conventions()}};
}

std::string jump_text(const TappedJump& jump) {
  return fmt::format("A {:.2f} \u2192 {:.2f} nm, \u03c6 {:.1f}\u00b0 \u2192 {:.1f}\u00b0",
                     jump.before.amplitude_m * curves::kNmPerM, jump.after.amplitude_m * curves::kNmPerM,
                     degrees(jump.before.phase_rad), degrees(jump.after.phase_rad));
}

}  // namespace afm::exhibit
