// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scenery/wall_places.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "scene/display/disparity.h"

namespace afm::exhibit {

using glm::dvec3;

namespace {

// Placement on a side screen, at the corner shared with the main screen, at the height of `beside_m`.
render::PanelPlacement on_side_screen(const scene::Screen& side, bool at_its_right_end, const dvec3& beside_m,
                                      double unit_m) {
  const dvec3 right = glm::normalize(side.lower_right - side.lower_left);
  const dvec3 up = glm::cross(side.normal(), right);
  const double gap_m = kCornerGap * unit_m, height_m = kPanelHeight * unit_m;
  const double width_m = std::min(kWidestPanel * unit_m, side.width_m() - 2.0 * gap_m);
  const double left_m = at_its_right_end ? side.width_m() - gap_m - width_m : gap_m;
  const double bottom_m =
      std::clamp(glm::dot(beside_m - side.lower_left, up), 0.0, std::max(0.0, side.height_m() - height_m));
  return {.lower_left_m = side.lower_left + left_m * right + bottom_m * up,
          .right_m = width_m * right,
          .up_m = height_m * up};
}

render::PanelPlacement in_frame(const glm::dmat4& room_from_frame, double left, double bottom, double width,
                                double height) {
  const auto vector = [&](const dvec3& v) { return dvec3(room_from_frame * glm::dvec4(v, 0.0)); };
  return {.lower_left_m = dvec3(room_from_frame * glm::dvec4(left, bottom, 0.0, 1.0)),
          .right_m = vector({width, 0.0, 0.0}),
          .up_m = vector({0.0, height, 0.0})};
}

}  // namespace

WallPlaces::WallPlaces(const StagePlace& stage, std::size_t swatches) {
  const scene::Screen& screen = stage.main;
  shape_ = wall_shape(stage, swatches);
  const double unit = shape_.unit_m;
  const Contact contact = contact_of(stage, shape_);
  const dvec3 right = glm::normalize(screen.lower_right - screen.lower_left), out = screen.normal();
  room_from_wall_ = frame_matrix(unit * right, unit * glm::cross(out, right), unit * out, contact.place_m);
  room_from_layout_ =
      contact.turn_rad == 0.0 ? room_from_wall_ : glm::rotate(room_from_wall_, contact.turn_rad, dvec3(1.0, 0.0, 0.0));
  wall_top_ = (screen.height_m() - contact.height_m) / unit;
  wall_bottom_ = -contact.height_m / unit;
  lay_out_front(stage);
  lay_out_panels(stage);
  lay_out_cue(stage);
  lay_out_height_bar(stage, swatches);
}

// Places shelf and wand in front of the wall, no nearer than the eyes can look without strain.
void WallPlaces::lay_out_front(const StagePlace& stage) {
  const double unit = shape_.unit_m;
  const glm::dmat4 layout_from_room = glm::inverse(room_from_layout_);
  const auto in_layout = [&](const dvec3& place_m) { return dvec3(layout_from_room * glm::dvec4(place_m, 1.0)); };
  const dvec3 eye = in_layout(stage.viewer_m);
  journey_view_ = {.eye = eye, .lower_corners = {in_layout(stage.main.lower_left), in_layout(stage.main.lower_right)}};
  const scene::ComfortZone zone =
      scene::comfort_zone(eye.z * unit, stage.ipd_m, kComfortMargin * scene::kComfortableDisparityRad);
  const double nearest = eye.z - zone.nearest_m / unit;
  shelf_z_ = std::clamp(nearest - kSwatchReach, kLeastShelfZ, kShelfZ);
  back_z_ = shelf_z_ - (kShelfZ - kBackZ);
  wand_grip_ = kWandGrip;
  wand_grip_.z = std::clamp(nearest - kWandReach, kLeastShelfZ, kWandGrip.z);

  // objects in front of the wall appear lower to a viewer above them, so the shelf is raised
  const double bottom = shape_.arrangement == Arrangement::Below ? -shape_.room_below : wall_bottom_;
  const double lowest_seen = eye.y + (bottom + kPanelMargin - eye.y) * (eye.z - shelf_z_) / eye.z;
  const bool deep = shape_.room_below > kRoomBelow || shelf_z_ < kNearShelfZ;
  shelf_y_ = std::clamp(lowest_seen + kShelfHeight, deep ? kLowestShelfY : kShelfY, kHighestShelfY);
}

// Limits the width of panels to 1.6 times their height on wide walls.
void WallPlaces::lay_out_panels(const StagePlace& stage) {
  const double half_wall = 0.5 * stage.main.width_m() / shape_.unit_m;
  const auto beside = [&] {
    const double width = half_width_ - kPanelInnerEdge - kPanelMargin;
    force_placement_ = in_wall(-half_width_ + kPanelMargin, kPanelBottom, width, kPanelHeight);
    data_placement_ = in_wall(kPanelInnerEdge, kPanelBottom, width, kPanelHeight);
  };
  half_width_ = std::min(half_wall, kPanelInnerEdge + kWidestPanel + kPanelMargin);
  if (shape_.arrangement == Arrangement::Below) {
    half_width_ = std::min(half_wall, kWidestPanel + 1.5 * kPanelMargin);
    const double width = half_width_ - 1.5 * kPanelMargin;
    force_placement_ = in_wall(-half_width_ + kPanelMargin, kBelowBottom, width, kPanelHeight);
    data_placement_ = in_wall(0.5 * kPanelMargin, kBelowBottom, width, kPanelHeight);
    return;
  }
  if (shape_.arrangement == Arrangement::Beside) {
    beside();
    return lay_out_far_panels(stage);
  }
  const dvec3 bottom(room_from_wall_ * glm::dvec4(0.0, kPanelBottom, 0.0, 1.0));
  force_placement_ = on_side_screen(*stage.left, true, bottom, shape_.unit_m);
  data_placement_ = on_side_screen(*stage.right, false, bottom, shape_.unit_m);
}

void WallPlaces::lay_out_far_panels(const StagePlace& stage) {
  const double unit = shape_.unit_m, begin = half_width_, end = begin + kWidestPanel;
  const dvec3 eye(glm::inverse(room_from_wall_) * glm::dvec4(stage.viewer_m, 1.0));
  const bool fits = end + kPanelMargin <= 0.5 * stage.main.width_m() / unit;
  if (!fits || std::atan2(end + std::abs(eye.x), eye.z) > kFarthestSightRad) return;
  far_ = Far{.left = in_wall(-end, kPanelBottom, kWidestPanel, kPanelHeight),
             .right = in_wall(begin, kPanelBottom, kWidestPanel, kPanelHeight)};
}

render::PanelPlacement WallPlaces::in_wall(double left, double bottom, double width, double height) const {
  return in_frame(room_from_wall_, left, bottom, width, height);
}

render::PanelPlacement WallPlaces::in_scene(double left, double bottom, double width, double height) const {
  return in_frame(room_from_layout_, left, bottom, width, height);
}

// Place of the data panel, with a strip of this width free on its left.
render::PanelPlacement WallPlaces::right_of_data(double inset) const {
  render::PanelPlacement panel = data_placement_;
  const dvec3 step = inset * shape_.unit_m * glm::normalize(panel.right_m);
  panel.lower_left_m += step;
  panel.right_m -= step;
  return panel;
}

render::PanelPlacement WallPlaces::parameters() const { return right_of_data(kParameterInset); }

render::PanelPlacement WallPlaces::parameter_tab() const {
  render::PanelPlacement tab = right_of_data(kTabInset);
  const dvec3 up = shape_.unit_m * glm::normalize(tab.up_m);
  tab.lower_left_m -= (kPanelMargin + kTabHeight) * up;
  tab.up_m = kTabHeight * up;
  return tab;
}

render::PanelPlacement WallPlaces::keys() const {
  const double bottom = (shape_.arrangement == Arrangement::Below ? kBelowBottom : wall_bottom_) + kPanelMargin;
  const double top = wall_top_ - kBannerHeight - 2.0 * kPanelMargin;
  return in_wall(-half_width_ + kPanelMargin, bottom, 2.0 * (half_width_ - kPanelMargin), top - bottom);
}

render::PanelPlacement WallPlaces::note() const {
  render::PanelPlacement note = force_placement_;
  const dvec3 right = shape_.unit_m * glm::normalize(note.right_m), up = shape_.unit_m * glm::normalize(note.up_m);
  note.lower_left_m -= (kPanelMargin + kTabHeight) * up;
  note.right_m -= kTabInset * right;
  note.up_m = kTabHeight * up;
  return note;
}

render::PanelPlacement WallPlaces::rung(std::size_t i) const {
  return in_wall(-half_width_ + kPanelMargin, kLowestRung + kRungPitch * static_cast<double>(i), kRungWidth,
                 kRungHeight);
}

glm::dvec3 WallPlaces::swatch(std::size_t i, std::size_t count) const {
  const std::size_t front = std::min(count, kFrontSwatches);
  const auto across = [](std::size_t place, std::size_t places, double spacing) {
    return spacing * (static_cast<double>(place) - 0.5 * static_cast<double>(places - 1));
  };
  if (i < front) return {across(i, front, kSwatchSpacing), shelf_y_, shelf_z_};
  return {across(i - front, count - front, kBackSpacing), shelf_y_ + kBackRise, back_z_};
}

// Before a screen that lies, the plate leans towards the viewer and is seen larger than the panel beside it.
void WallPlaces::lay_out_cue(const StagePlace& stage) {
  if (shape_.arrangement != Arrangement::Beside) return;
  const glm::dmat4 layout_from_room = glm::inverse(room_from_layout_);
  const dvec3 eye(layout_from_room * glm::dvec4(stage.viewer_m, 1.0));
  const dvec3 corner(layout_from_room * glm::dvec4(force_placement_.lower_left_m + force_placement_.right_m, 1.0));
  const dvec3 out(layout_from_room * glm::dvec4(glm::cross(force_placement_.right_m, force_placement_.up_m), 0.0));
  const double beside_eye = 0.5 * stage.ipd_m / shape_.unit_m;
  for (const double y : {kCuePlace.y, kCuePlace.y + kCueHeight}) {
    for (const double x : {eye.x - beside_eye, eye.x + beside_eye}) {
      // the panel's right edge and the plate are seen one above the other where the sight reaches the panel's plane
      const double nearer = glm::dot(out, corner - eye) / glm::dot(out, dvec3(0.0, y, 0.0) - eye);
      cue_left_ = std::max(cue_left_, x + (corner.x + kCueGap - x) / nearer);
    }
  }
}

// Places the bar left of all swatches that seem to be at its height, as far as the wall leaves room for the numbers.
void WallPlaces::lay_out_height_bar(const StagePlace& stage, std::size_t swatches) {
  const dvec3 eye(glm::inverse(room_from_layout_) * glm::dvec4(stage.viewer_m, 1.0));
  const double lowest = kHeightBarBottom - 0.5 * kHeightBarTextHeight,
               highest = kHeightBarBottom + kHeightBarHeight + 0.5 * kHeightBarTextHeight;
  double right = kHeightBarX + kHeightBarWidth;
  for (std::size_t i = 0; i < swatches; ++i) {
    const dvec3 middle = swatch(i, swatches) + kSwatchCenter;
    const double nearer = eye.z / (eye.z - middle.z);  // enlargement on the wall
    const double y = eye.y + nearer * (middle.y - eye.y), radius = nearer * kSwatchRadius;
    if (y + radius < lowest || y - radius > highest) continue;
    right = std::min(right, eye.x + nearer * (middle.x - eye.x) - radius - kHeightBarTextGap);
  }
  height_bar_x_ =
      std::max(right - kHeightBarWidth, kPanelMargin + kHeightBarTextWidth + kHeightBarTextGap - half_width_);
}

render::PanelPlacement WallPlaces::height_bar_text(double share) const {
  return in_wall(height_bar_x() - kHeightBarTextGap - kHeightBarTextWidth,
                 kHeightBarBottom + share * kHeightBarHeight - 0.5 * kHeightBarTextHeight, kHeightBarTextWidth,
                 kHeightBarTextHeight);
}

render::PanelPlacement WallPlaces::ruler_text(double length, RulerSide side) const {
  const double beside = side == RulerSide::Left ? -kRulerTextGap - kRulerTextWidth : kRulerTextGap;
  return in_wall(kRulerFoot.x + beside, 0.5 * (length - kRulerTextHeight), kRulerTextWidth, kRulerTextHeight);
}

double WallPlaces::unit_m() const { return glm::length(dvec3(room_from_layout_[0])); }

glm::dvec3 WallPlaces::wand_grip_m() const { return dvec3(room_from_layout_ * glm::dvec4(wand_grip_, 1.0)); }

// Placement of the finale's large plot, which replaces the instrument.
render::PanelPlacement WallPlaces::finale() const {
  if (shape_.arrangement == Arrangement::Beside) {
    const double width = std::min(kPanelInnerEdge + half_width_ - 2.0 * kPanelMargin, kWidestPlot);
    return in_wall(kPanelInnerEdge - kPanelMargin - width, kPanelBottom, width, kPanelHeight);
  }
  const double width = std::min(2.0 * (half_width_ - kPanelMargin), kWidestPanel);
  return in_wall(-0.5 * width, kPanelBottom, width, kPanelHeight);
}

void WallPlaces::place_panels(const WallState& state, render::FrameState& frame) const {
  render::FramePanels& panels = frame.panels;
  hide(panels);
  panels.banner.placement = in_wall(-half_width_ + kPanelMargin, wall_top_ - kBannerHeight - kPanelMargin,
                                    2.0 * (half_width_ - kPanelMargin), kBannerHeight);
  if (state.centerpiece == Centerpiece::Journey) return;
  const bool plot = state.centerpiece == Centerpiece::Plot;
  if (state.scan && !plot && far_) panels.image.placement = far_->left;
  const bool in_place = state.scan && !plot && !far_;
  (in_place ? panels.image.placement : panels.force.placement) = plot ? finale() : force_placement_;
  (state.particles != nullptr && !plot ? panels.particles.placement : panels.data.placement) = data_placement_;
}

}  // namespace afm::exhibit
