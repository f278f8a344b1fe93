// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/recorded_wall.h"
#include "exhibit/scan/live_scan.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/enumerators.h"
#include "core/members.h"
#include "exhibit/state/cycle_history.h"
#include "exhibit/state/lines_to_write.h"
#include "scene/shared/field_copy.h"

namespace afm::exhibit {

namespace {

// Names for files, independent of the values in the enumeration.
struct CenterpieceRow {
  Centerpiece piece;
  std::string_view name;
};
constexpr std::array<CenterpieceRow, 4> kCenterpieces{{{Centerpiece::Instrument, "instrument"},
                                                       {Centerpiece::Plot, "plot"},
                                                       {Centerpiece::Analogy, "analogy"},
                                                       {Centerpiece::Journey, "journey"}}};
static_assert(core::has_row_for_each(kCenterpieces, &CenterpieceRow::piece));

std::string name_of(Centerpiece piece) { return std::string(kCenterpieces[core::index_of(piece)].name); }

Centerpiece centerpiece_of(std::string_view name) {
  const auto found = std::find_if(kCenterpieces.begin(), kCenterpieces.end(),
                                  [&](const CenterpieceRow& row) { return row.name == name; });
  return found == kCenterpieces.end() ? Centerpiece::Instrument : found->piece;
}

std::optional<std::size_t> index_of(std::span<const std::string> names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
}

template <class Copy, class Wand, class Recorded>
void copy_wand(const Copy& copy, Wand& wand, Recorded& recorded) {
  copy(wand.position_m, recorded.pose.position_m);
  copy(wand.room_from_wand, recorded.pose.orientation);
  copy(wand.orientation_valid, recorded.orientation_valid);
  copy(wand.position_valid, recorded.position_valid);
  copy(wand.connected, recorded.connected);
  copy(wand.buttons, recorded.buttons);
}

// Copies the fields recorded by value, in either direction; materials and modes are recorded by name.
template <class Copy, class Moment, class Frame>
void copy_moment(const Copy& copy, Moment& moment, Frame& frame) {
  auto& wall = moment.wall;
  copy(wall.navigation, frame.navigation);
  copy(wall.journey_orders, frame.journey_orders);
  copy(wall.fade, frame.fade);
  if (copy.has(wall.wand, frame.wand)) copy_wand(copy, *wall.wand, *frame.wand);
  copy(wall.release_z_m, frame.release_z_m);
  copy(moment.guidance, frame.guidance);
  copy(moment.retracting, frame.retracting);
}

servo::RecordedScanChange recorded_change(const ScanChange& change) {
  servo::RecordedScanChange to;
  core::members_of(to) = std::tuple_cat(std::tie(change.frame, change.pixel), core::members_of(change.choice));
  if (change.choice.free_amplitude_m == 0.0) to.free_amplitude_m.reset();
  if (change.choice.drive_hz == 0.0) to.drive_hz.reset();
  return to;
}

ScanChange restored_change(const servo::RecordedScanChange& from) {
  const auto& [frame, pixel, setpoint, gain, rate, radius, noise, drift, apex, free_amplitude, drive] = from;
  return {frame,
          pixel,
          {setpoint, gain, rate, radius, noise, drift, apex, free_amplitude.value_or(0.0), drive.value_or(0.0)}};
}

// Curves as in the live window: the running cycle at `end_ns`, or the last complete one.
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
    sample.material = static_cast<std::int32_t>(own);  // index among the materials drawn now
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

scene::Pose pose_of(const scene::HeadPose& head) {
  scene::Pose pose;
  scene::convert(head.position_m, pose.position_m);
  scene::convert(head.room_from_head, pose.orientation);
  return pose;
}

scene::HeadPose head_of(const scene::Pose& pose) {
  scene::HeadPose head;
  scene::convert(pose.position_m, head.position_m);
  scene::convert(pose.orientation, head.room_from_head);
  return head;
}

servo::RecordedLines recorded_lines(const LinesToWrite& lines) {
  servo::RecordedLines recorded{.lines_m = {}, .width_m = lines.width_m};
  for (const std::vector<glm::dvec2>& corners_m : lines.lines_m) {
    auto& line = recorded.lines_m.emplace_back();
    for (const glm::dvec2& corner_m : corners_m) line.push_back({corner_m.x, corner_m.y});
  }
  return recorded;
}

LinesToWrite lines_of(const servo::RecordedLines& recorded) {
  LinesToWrite lines{.lines_m = {}, .width_m = recorded.width_m};
  for (const auto& line : recorded.lines_m) {
    std::vector<glm::dvec2>& corners_m = lines.lines_m.emplace_back();
    for (const auto& [x_m, y_m] : line) corners_m.emplace_back(x_m, y_m);
  }
  return lines;
}

servo::WallFrame wall_frame_of(const Moment& moment, std::int64_t time_ns, std::span<const std::string> materials) {
  servo::WallFrame frame;
  frame.time_ns = time_ns;
  copy_moment(scene::CopyOut(), moment, frame);
  frame.centerpiece = name_of(moment.wall.centerpiece);
  if (moment.wall.false_colours) frame.false_colours = true;
  if (moment.wall.stroboscope) frame.stroboscope = true;
  if (moment.wall.hovered) frame.hovered = materials[*moment.wall.hovered];
  if (moment.scan != nullptr) {
    const ScanProgress& scan = moment.scan->progress();
    frame.scan = {.frame = scan.frame, .pixel = scan.pixel, .truth = scan.truth};
    if (scan.hand) core::members_of(frame.scan_hand.emplace()) = core::members_of(*scan.hand);
    for (const ScanChange& change : scan.changes) {
      frame.scan_changes.push_back(recorded_change(change));
    }
  }
  for (const render::DataRow& row : moment.servo) frame.servo_row.push_back({row.name, row.value, row.source});
  return frame;
}

ScanProgress scan_progress_of(const servo::WallFrame& frame) {
  ScanProgress progress{
      .frame = frame.scan->frame, .pixel = frame.scan->pixel, .truth = frame.scan->truth, .changes = {}, .hand = {}};
  if (frame.scan_hand) core::members_of(progress.hand.emplace()) = core::members_of(*frame.scan_hand);
  for (const servo::RecordedScanChange& change : frame.scan_changes) {
    progress.changes.push_back(restored_change(change));
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
  copy_moment(scene::CopyBack(), then, frame);
  then.wall.hovered = index_of(materials, frame.hovered);
  then.wall.centerpiece = centerpiece_of(frame.centerpiece);
  then.wall.false_colours = frame.false_colours.value_or(false);
  then.wall.stroboscope = frame.stroboscope.value_or(false);
  for (const auto& [name, value, source] : frame.servo_row) then.servo.push_back({name, value, source});
  return {.frame = &frame,
          .curves = curves_until(session, materials, own, frame.time_ns),
          .friction = friction_until(session, frame.time_ns),
          .moment = std::move(then)};
}

}  // namespace afm::exhibit
