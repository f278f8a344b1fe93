// SPDX-License-Identifier: Apache-2.0
#include "exhibit/cluster/frame_inputs.h"

#include <algorithm>
#include <cmath>

#include "core/enumerators.h"
#include "exhibit/scan/live_scan.h"
#include "scene/shared/field_copy.h"

namespace afm::exhibit {

namespace {

constexpr std::size_t kTextsBeforeRows = 3;  // number of texts before the rows: guidance, caption, letters
constexpr double kFarthestSentM = 1e6;       // limit of a picture's depth

// Lists of pairs, each of which defines both directions of the conversion.

template <class Copy, class Tip, class Shown>
void copy_tip(const Copy& copy, Tip& tip, Shown& shown) {
  copy(tip.time_ns, shown.time_ns);
  copy(tip.tip, shown.tip);
  copy(tip.swing, shown.swing);
  copy(tip.surface, shown.surface);
  copy(tip.active.release_z_m, shown.release_z_m);
  copy(tip.active.slow_motion, shown.slow_motion);
  copy(tip.active.edit_revision, shown.edit_revision);
  copy(tip.acknowledged.refused_edit, shown.refused_edit);
  copy(tip.material, shown.material);
  copy(tip.phase, shown.phase);
  copy(tip.servo_state, shown.servo_state);
  copy(tip.realtime, shown.realtime);
}

template <class Copy, class Wand, class Shown>
void copy_wand(const Copy& copy, Wand& wand, Shown& shown) {
  using M = cluster::ShownMoment;
  copy(wand.position_m, shown.wand.position_m);
  copy(wand.room_from_wand, shown.wand.orientation);
  copy(wand.buttons, shown.wand_buttons);
  copy.flag(wand.orientation_valid, shown.flags, M::kWandOriented);
  copy.flag(wand.position_valid, shown.flags, M::kWandPlaced);
  copy.flag(wand.connected, shown.flags, M::kWandConnected);
}

template <class Copy, class Moment, class Shown>
void copy_moment(const Copy& copy, Moment& moment, Shown& shown) {
  using M = cluster::ShownMoment;
  auto& wall = moment.wall;
  copy(wall.navigation, shown.navigation);
  copy(wall.journey_orders, shown.journey_orders);
  copy(wall.fade, shown.fade);
  copy(wall.centerpiece, shown.centerpiece);
  copy(wall.hovered, shown.hovered);
  copy.flag(wall.false_colours, shown.flags, M::kFalseColours);
  copy.flag(wall.stroboscope, shown.flags, M::kStroboscope);
  copy.flag(moment.by_wand, shown.flags, M::kByWand);
  copy.flag(moment.retracting, shown.flags, M::kRetracting);
  copy.flag(moment.stopped, shown.flags, M::kStopped);
  if (copy.has(wall.wand, shown.flags, M::kWand)) copy_wand(copy, *wall.wand, shown);
  if (copy.has(wall.cue, shown.flags, M::kCue)) {
    copy(wall.cue->kind, shown.cue);
    copy(wall.cue->force_n, shown.cue_force_n);
    copy(wall.cue->age_s, shown.cue_age_s);
  }
}

template <class Copy, class Depth, class View>
void copy_depth(const Copy& copy, Depth& depth, View& view) {
  copy.flag(depth.measured, view.flags, cluster::ShownView::kDepth);
  copy.flag(depth.hard, view.flags, cluster::ShownView::kHardDepth);
  copy(depth.range.nearest_m, view.depth_range_m[0]);
  copy(depth.range.farthest_m, view.depth_range_m[1]);
  copy(depth.nearest.crossed_rad, view.nearest[0]);
  copy(depth.nearest.uncrossed_m, view.nearest[1]);
  copy(depth.farthest.crossed_rad, view.farthest[0]);
  copy(depth.farthest.uncrossed_m, view.farthest[1]);
  copy(depth.relief, view.relief);
}

static_assert(cluster::ShownMoment::kMostCenterpieces == core::kEnumerators<Centerpiece>.size());
static_assert(cluster::ShownMoment::kNoCenterpiece == core::index_of(Centerpiece::Plot));
static_assert(cluster::ShownMoment::kLongestCueS == kCueSeconds);

}  // namespace

void set_moment(const Moment& moment, const scene::TipState& tip, const std::string& caption, bool blank,
                cluster::FrameMessage& message) {
  using M = cluster::ShownMoment;
  copy_tip(scene::CopyOut(), tip, message.tip);
  message.tip.servo_state = moment.servo_state;
  M& shown = message.moment;
  shown = {};
  copy_moment(scene::CopyOut(), moment, shown);
  shown.fade = std::clamp(shown.fade, 0.0, 1.0);
  if (blank) shown.flags |= M::kBlank;
  if (tip.active.scale_mode == scene::ScaleMode::Particles) shown.flags |= M::kParticlesScale;
  if (moment.scan != nullptr) {
    const ScanProgress& scan = moment.scan->progress();
    shown.flags |= M::kScan | (scan.truth ? M::kTruth : 0U);
    shown.scan_frame = scan.frame;
    shown.scan_pixel = scan.pixel;
  }
  std::vector<std::string> texts{moment.guidance, caption, moment.letters};
  for (const render::DataRow& row : moment.servo) texts.insert(texts.end(), {row.name, row.value, row.source});
  message.texts.set(texts);
}

scene::TipState tip_of(const cluster::FrameMessage& message) {
  scene::TipState tip;
  copy_tip(scene::CopyBack(), tip, message.tip);
  // the other scales look the same
  const bool particles = (message.moment.flags & cluster::ShownMoment::kParticlesScale) != 0;
  if (particles) tip.active.scale_mode = scene::ScaleMode::Particles;
  return tip;
}

Moment moment_of(const cluster::FrameMessage& message) {
  Moment moment = moment_of(tip_of(message), false);
  copy_moment(scene::CopyBack(), moment, message.moment);
  std::vector<std::string> texts = message.texts.list();
  texts.resize(std::max(texts.size(), kTextsBeforeRows));
  moment.guidance = texts.front();
  moment.letters = texts[2];
  // the last row may be cut off before its source
  for (std::size_t i = kTextsBeforeRows; i < texts.size(); i += 3) {
    const auto text = [&](std::size_t at) { return at < texts.size() ? texts[at] : std::string(); };
    moment.servo.push_back({text(i), text(i + 1), text(i + 2)});
  }
  return moment;
}

std::string caption_of(const cluster::FrameMessage& message) {
  const std::vector<std::string> texts = message.texts.list();
  return texts.size() < 2 ? "" : texts[1];
}

void set_depth(const DepthReport& depth, cluster::ShownView& view) {
  const auto sent = [](double value) { return std::clamp(std::isnan(value) ? 0.0 : value, 0.0, kFarthestSentM); };
  copy_depth(scene::CopyOut(), depth, view);
  for (double& place_m : view.depth_range_m) place_m = sent(place_m);
}

DepthReport depth_of(const cluster::ShownView& view) {
  DepthReport depth;
  copy_depth(scene::CopyBack(), depth, view);
  return depth;
}

}  // namespace afm::exhibit
