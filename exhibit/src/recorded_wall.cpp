// SPDX-License-Identifier: Apache-2.0
#include "exhibit/recorded_wall.h"

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "exhibit/cycle_history.h"

namespace afm::exhibit {

namespace {

// Files have names, which do not change with the enumeration.
constexpr std::array<std::pair<Centerpiece, std::string_view>, 4> kCenterpieces{
    {{Centerpiece::Instrument, "instrument"},
     {Centerpiece::Plot, "plot"},
     {Centerpiece::Analogy, "analogy"},
     {Centerpiece::Journey, "journey"}}};

std::string name_of(Centerpiece piece) {
  const auto found =
      std::find_if(kCenterpieces.begin(), kCenterpieces.end(), [&](const auto& entry) { return entry.first == piece; });
  return std::string(found->second);
}

Centerpiece centerpiece_of(std::string_view name) {
  const auto found =
      std::find_if(kCenterpieces.begin(), kCenterpieces.end(), [&](const auto& entry) { return entry.second == name; });
  return found == kCenterpieces.end() ? Centerpiece::Instrument : found->first;
}

std::optional<std::size_t> index_of(std::span<const std::string> names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
}

servo::RecordedPose recorded(const glm::dvec3& p, const glm::dquat& q) {
  return {.position_m = {p.x, p.y, p.z}, .orientation = {q.w, q.x, q.y, q.z}};
}

glm::dvec3 position_of(const servo::RecordedPose& pose) {
  const auto& [x, y, z] = pose.position_m;
  return {x, y, z};
}

glm::dquat orientation_of(const servo::RecordedPose& pose) {
  const auto& [w, x, y, z] = pose.orientation;
  return {w, x, y, z};
}

input::WandState wand_of(const servo::RecordedWand& wand) {
  input::WandState state;
  state.position_m = position_of(wand.pose);
  state.room_from_wand = orientation_of(wand.pose);
  state.orientation_valid = wand.orientation_valid;
  state.position_valid = wand.position_valid;
  state.connected = wand.connected;
  state.buttons = wand.buttons;
  return state;
}

// As the live window's: the cycle that went on at `end_ns`, or the last whole one.
std::vector<CycleCurve> curves_until(const servo::RecordedSession& session, std::span<const std::string> materials,
                                     std::size_t own, std::int64_t end_ns) {
  CycleHistory history(materials.size());
  auto event = session.events.begin();
  for (scene::TipSample sample : session.samples) {
    if (sample.time_ns > end_ns) break;
    for (; event != session.events.end() && event->time_ns <= sample.time_ns; ++event) {
      scene::TipEvent here = *event;
      here.material = static_cast<std::int32_t>(own);
      history.add(here);
    }
    sample.material = static_cast<std::int32_t>(own);  // by its place among those that are drawn now
    history.add(sample);
  }
  std::vector<CycleCurve> curves(history.curves().begin(), history.curves().end());
  for (const servo::EarlierCurve& earlier : session.earlier_curves) {
    const auto material = index_of(materials, earlier.material);
    if (material && curves[*material].empty()) curves[*material] = CycleCurve::from(earlier.points);
  }
  return curves;
}

FrictionHistory friction_until(const servo::RecordedSession& session, std::int64_t end_ns) {
  FrictionHistory history;
  for (const scene::TipSample& sample : session.samples) {
    if (sample.time_ns > end_ns) break;
    history.add(sample);
  }
  return history;
}

}  // namespace

servo::RecordedPose recorded(const scene::HeadPose& head) { return recorded(head.position_m, head.room_from_head); }

scene::HeadPose head_of(const servo::RecordedPose& pose) {
  return {.position_m = position_of(pose), .room_from_head = orientation_of(pose)};
}

servo::WallFrame wall_frame_of(const Moment& moment, std::int64_t time_ns, std::span<const std::string> materials) {
  servo::WallFrame frame;
  frame.time_ns = time_ns;
  std::copy_n(glm::value_ptr(moment.wall.navigation), frame.navigation.size(), frame.navigation.begin());
  frame.centerpiece = name_of(moment.wall.centerpiece);
  frame.journey_orders = moment.wall.journey_orders;
  frame.fade = moment.wall.fade;
  if (moment.wall.hovered) frame.hovered = materials[*moment.wall.hovered];
  if (const auto& wand = moment.wall.wand) {
    frame.wand = {.pose = recorded(wand->position_m, wand->room_from_wand),
                  .orientation_valid = wand->orientation_valid,
                  .position_valid = wand->position_valid,
                  .connected = wand->connected,
                  .buttons = wand->buttons};
  }
  frame.guidance = moment.guidance;
  frame.retracting = moment.retracting;
  frame.release_z_m = moment.wall.release_z_m;
  if (moment.scan != nullptr) {
    const ScanProgress& scan = moment.scan->progress();
    frame.scan = {.frame = scan.frame, .pixel = scan.pixel, .truth = scan.truth};
    if (const auto& hand = scan.hand) {
      frame.scan_hand = {
          .paints = hand->paints, .feedback = hand->feedback, .side_m = hand->side_m, .first_tick = hand->first_tick};
    }
    for (const auto& [scan_frame, pixel, c] : scan.changes) {
      frame.scan_changes.push_back({scan_frame, pixel, c.setpoint_n, c.gain_per_s, c.line_rate_hz, c.tip_radius_m,
                                    c.noise_m, c.drift_m_per_s, c.apex_distance_m});
    }
  }
  for (const render::DataRow& row : moment.servo) frame.servo_row.push_back({row.name, row.value, row.source});
  return frame;
}

ScanProgress scan_progress_of(const servo::WallFrame& frame) {
  ScanProgress progress{
      .frame = frame.scan->frame, .pixel = frame.scan->pixel, .truth = frame.scan->truth, .changes = {}, .hand = {}};
  if (const auto& hand = frame.scan_hand) {
    progress.hand = {
        .paints = hand->paints, .feedback = hand->feedback, .side_m = hand->side_m, .first_tick = hand->first_tick};
  }
  for (const auto& [scan_frame, pixel, setpoint, gain, rate, radius, noise, drift, apex] : frame.scan_changes) {
    progress.changes.push_back({scan_frame, pixel, {setpoint, gain, rate, radius, noise, drift, apex}});
  }
  return progress;
}

RecordedMoment moment_on_wall(const servo::RecordedSession& session, std::span<const std::string> materials,
                              std::int64_t time_ns) {
  const auto after = std::upper_bound(session.wall.begin(), session.wall.end(), time_ns,
                                      [](std::int64_t t, const servo::WallFrame& f) { return t < f.time_ns; });
  const servo::WallFrame& frame = after == session.wall.begin() ? session.wall.front() : *(after - 1);
  const std::size_t own = index_of(materials, session.material).value();

  Moment then = moment_of(session, own, frame.time_ns, {});
  then.retracting = frame.retracting;
  then.guidance = frame.guidance;
  then.wall.release_z_m = frame.release_z_m;
  then.wall.hovered = index_of(materials, frame.hovered);
  if (frame.wand) then.wall.wand = wand_of(*frame.wand);
  then.wall.centerpiece = centerpiece_of(frame.centerpiece);
  then.wall.journey_orders = frame.journey_orders;
  then.wall.fade = frame.fade;
  then.wall.navigation = glm::make_mat4(frame.navigation.data());
  for (const auto& [name, value, source] : frame.servo_row) then.servo.push_back({name, value, source});
  return {.frame = &frame,
          .curves = curves_until(session, materials, own, frame.time_ns),
          .friction = friction_until(session, frame.time_ns),
          .moment = std::move(then)};
}

}  // namespace afm::exhibit
