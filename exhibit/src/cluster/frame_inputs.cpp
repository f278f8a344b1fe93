// SPDX-License-Identifier: Apache-2.0
#include "exhibit/cluster/frame_inputs.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "core/enumerators.h"
#include "exhibit/scan/live_scan.h"

namespace afm::exhibit {

namespace {

constexpr std::size_t kTextsBeforeRows = 2;  // guidance, caption
constexpr double kFarthestSentM = 1e6;       // of a picture's depth

cluster::ShownPose pose_of(const glm::dvec3& p, const glm::dquat& q) {
  return {.position_m = {p.x, p.y, p.z}, .orientation = {q.w, q.x, q.y, q.z}};
}

glm::dvec3 placed(const cluster::ShownPose& pose) {
  return {pose.position_m[0], pose.position_m[1], pose.position_m[2]};
}

glm::dquat turned(const cluster::ShownPose& pose) {
  const auto& [w, x, y, z] = pose.orientation;
  return {w, x, y, z};
}

cluster::ShownTip shown(const scene::TipState& tip, const Moment& moment) {
  return {.time_ns = tip.time_ns,
          .tip = tip.tip,
          .surface = tip.surface,
          .release_z_m = tip.active.release_z_m,
          .slow_motion = tip.active.slow_motion,
          .edit_revision = tip.active.edit_revision,
          .refused_edit = tip.acknowledged.refused_edit,
          .material = tip.material,
          .phase = tip.phase,
          .servo_state = moment.servo_state,
          .realtime = tip.realtime};
}

static_assert(cluster::ShownMoment::kMostCenterpieces == core::kEnumerators<Centerpiece>.size());
static_assert(cluster::ShownMoment::kNoCenterpiece == core::index_of(Centerpiece::Plot));
static_assert(cluster::ShownMoment::kLongestCueS == kCueSeconds);

}  // namespace

void set_moment(const Moment& moment, const scene::TipState& tip, const std::string& caption, bool blank,
                cluster::FrameMessage& message) {
  using M = cluster::ShownMoment;
  message.tip = shown(tip, moment);
  M& shown = message.moment;
  shown = {};
  std::copy_n(glm::value_ptr(moment.wall.navigation), shown.navigation.size(), shown.navigation.begin());
  shown.journey_orders = moment.wall.journey_orders;
  shown.fade = std::clamp(moment.wall.fade, 0.0, 1.0);
  shown.centerpiece = static_cast<std::uint32_t>(core::index_of(moment.wall.centerpiece));
  if (moment.wall.hovered) shown.hovered = static_cast<std::int32_t>(*moment.wall.hovered);
  if (moment.retracting) shown.flags |= M::kRetracting;
  if (blank) shown.flags |= M::kBlank;
  if (moment.scan != nullptr) {
    const ScanProgress& scan = moment.scan->progress();
    shown.flags |= M::kScan | (scan.truth ? M::kTruth : 0U);
    shown.scan_frame = scan.frame;
    shown.scan_pixel = scan.pixel;
  }
  if (const auto& wand = moment.wall.wand) {
    shown.wand = pose_of(wand->position_m, wand->room_from_wand);
    shown.wand_buttons = wand->buttons;
    shown.flags |= M::kWand | (wand->orientation_valid ? M::kWandOriented : 0U) |
                   (wand->position_valid ? M::kWandPlaced : 0U) | (wand->connected ? M::kWandConnected : 0U);
  }
  if (const auto& cue = moment.wall.cue) {
    shown.flags |= M::kCue;
    shown.cue = cue->kind;
    shown.cue_age_s = cue->age_s;
  }
  std::vector<std::string> texts{moment.guidance, caption};
  for (const render::DataRow& row : moment.servo) texts.insert(texts.end(), {row.name, row.value, row.source});
  message.texts.set(texts);
}

scene::TipState tip_of(const cluster::FrameMessage& message) {
  const cluster::ShownTip& shown = message.tip;
  scene::TipState tip;
  tip.time_ns = shown.time_ns;
  tip.tip = shown.tip;
  tip.surface = shown.surface;
  tip.active.release_z_m = shown.release_z_m;
  tip.active.slow_motion = shown.slow_motion;
  tip.active.edit_revision = shown.edit_revision;
  tip.acknowledged.refused_edit = shown.refused_edit;
  tip.material = shown.material;
  tip.phase = shown.phase;
  tip.servo_state = shown.servo_state;
  tip.realtime = shown.realtime;
  return tip;
}

Moment moment_of(const cluster::FrameMessage& message) {
  using M = cluster::ShownMoment;
  const M& shown = message.moment;
  Moment moment = moment_of(tip_of(message), (shown.flags & M::kRetracting) != 0);
  moment.wall.navigation = glm::make_mat4(shown.navigation.data());
  moment.wall.journey_orders = shown.journey_orders;
  moment.wall.fade = shown.fade;
  moment.wall.centerpiece = core::kEnumerators<Centerpiece>[shown.centerpiece];
  if (shown.hovered >= 0) moment.wall.hovered = static_cast<std::size_t>(shown.hovered);
  if ((shown.flags & M::kWand) != 0) {
    input::WandState& wand = moment.wall.wand.emplace();
    wand.position_m = placed(shown.wand);
    wand.room_from_wand = turned(shown.wand);
    wand.orientation_valid = (shown.flags & M::kWandOriented) != 0;
    wand.position_valid = (shown.flags & M::kWandPlaced) != 0;
    wand.connected = (shown.flags & M::kWandConnected) != 0;
    wand.buttons = shown.wand_buttons;
  }
  if ((shown.flags & M::kCue) != 0) moment.wall.cue = JumpCue{.kind = shown.cue, .age_s = shown.cue_age_s};
  std::vector<std::string> texts = message.texts.list();
  texts.resize(std::max(texts.size(), kTextsBeforeRows));
  moment.guidance = texts.front();
  // the last row may have lost its source
  for (std::size_t i = kTextsBeforeRows; i < texts.size(); i += 3) {
    const auto text = [&](std::size_t at) { return at < texts.size() ? texts[at] : std::string(); };
    moment.servo.push_back({text(i), text(i + 1), text(i + 2)});
  }
  return moment;
}

std::string caption_of(const cluster::FrameMessage& message) {
  const std::vector<std::string> texts = message.texts.list();
  return texts.size() < kTextsBeforeRows ? "" : texts[1];
}

void set_head(const scene::HeadPose& head, cluster::ShownView& view) {
  view.head = pose_of(head.position_m, head.room_from_head);
}

scene::HeadPose head_of(const cluster::ShownView& view) {
  return {.position_m = placed(view.head), .room_from_head = turned(view.head)};
}

void set_depth(const DepthReport& depth, cluster::ShownView& view) {
  const auto sent = [](double value) { return std::clamp(std::isnan(value) ? 0.0 : value, 0.0, kFarthestSentM); };
  const auto pair = [](const scene::Disparity& disparity) {
    return std::array{disparity.crossed_rad, disparity.uncrossed_m};
  };
  view.depth_range_m = {sent(depth.range.nearest_m), sent(depth.range.farthest_m)};
  view.nearest = pair(depth.nearest);
  view.farthest = pair(depth.farthest);
  view.relief = static_cast<std::uint32_t>(depth.relief);
  view.flags |= (depth.measured ? cluster::ShownView::kDepth : 0U) | (depth.hard ? cluster::ShownView::kHardDepth : 0U);
}

DepthReport depth_of(const cluster::ShownView& view) {
  return {.measured = (view.flags & cluster::ShownView::kDepth) != 0,
          .range = {.nearest_m = view.depth_range_m[0], .farthest_m = view.depth_range_m[1]},
          .nearest = {.crossed_rad = view.nearest[0], .uncrossed_m = view.nearest[1]},
          .farthest = {.crossed_rad = view.farthest[0], .uncrossed_m = view.farthest[1]},
          .hard = (view.flags & cluster::ShownView::kHardDepth) != 0,
          .relief = static_cast<Relief>(view.relief)};
}

}  // namespace afm::exhibit
