// SPDX-License-Identifier: Apache-2.0
#include "app/live/place_control.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "app/display/view_picture.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "app/view/view_wand.h"
#include "core/log.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/state/moment.h"
#include "servo/frame_log.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

constexpr double kBesideWallM = 0.01;  // contacts closer to the wall than this need no B key

}  // namespace

PlaceControl::PlaceControl(ViewParts& parts, const std::vector<input::HeadKey>& script, Eyes eyes)
    : parts_(parts),
      eyes_(eyes),
      head_(parts.stage.wall),
      simulated_head_(parts.stage.wall.viewers.front().sweet_spot, script) {}

void PlaceControl::update(const ViewFrame& frame) {
  if (eyes_ == Eyes::OfHeadset) return;
  auto seen = parts_.wand.head();
  if (!parts_.wand.tracks_head()) {
    if (const auto simulated = simulated_head_.pose(frame.now_ns)) seen = {.pose = *simulated, .time_ns = frame.now_ns};
  }
  const auto pose = seen ? std::optional(seen->pose) : std::nullopt;
  if (const auto head = head_.update(pose, seen ? seen->time_ns : 0, frame.now_ns)) parts_.picture.look_from(*head);
}

void PlaceControl::move_head(double right_m, double up_m, double nearer_m) {
  if (parts_.wand.tracks_head()) {
    core::log_line("the tracker controls the head; the arrow keys have no effect");
    return;
  }
  const scene::Screen& screen = parts_.stage.screen;
  const glm::dvec3 right = glm::normalize(screen.lower_right - screen.lower_left), normal = screen.normal();
  simulated_head_.step(right_m * right + up_m * glm::cross(normal, right) - nearer_m * normal);
  core::log_line(fmt::format("head: {:+.2f} m to the right, {:+.2f} m up, {:+.2f} m nearer", right_m, up_m, nearer_m));
}

void PlaceControl::bring_home() {
  parts_.wand.home();
  to_wall_ = glm::dmat4(1.0);
  simulated_head_.home();
}

void PlaceControl::bring_to_wall() {
  if (parts_.servo.link().tip().phase == physics::Phase::Attached) {
    core::log_line("the scene is locked while the tip is in contact");
    return;
  }
  const double before_m = before_wall_m();
  to_wall_ = glm::translate(glm::dmat4(1.0), -before_m * parts_.stage.screen.normal()) * to_wall_;
  core::log_line(fmt::format("moved the contact {:.3f} m {} the viewer, into the plane of the wall", std::abs(before_m),
                             before_m < 0.0 ? "towards" : "away from"));
}

void PlaceControl::toggle_stroboscope() {
  const auto material = parts_.servo.material();
  if (!material || !parts_.panels.edits().of(*material).model().taps()) {
    return core::log_line("stroboscope: no lever vibrates; start with --mode tapping, and choose a sample");
  }
  stroboscope_ = !stroboscope_;
  core::log_line(stroboscope_ ? "stroboscope: one swing a second" : "stroboscope: off");
}

double PlaceControl::before_wall_m() const {
  const glm::dvec3 contact(to_wall_ * parts_.wand.navigation() * glm::dvec4(parts_.stage.wall_scene.contact_m(), 1.0));
  return glm::dot(contact - parts_.stage.screen.lower_left, parts_.stage.screen.normal());
}

void PlaceControl::add_to_moment(exhibit::Moment& now, ViewFrame& frame) {
  now.wall.navigation = to_wall_ * parts_.wand.navigation();
  now.wall.stroboscope = stroboscope_;
  if (std::abs(before_wall_m()) > kBesideWallM) frame.relief = exhibit::Relief::BringToWall;
}

void PlaceControl::add_to_log(servo::FrameRecord& record) {
  record.head_latency_s = head_.presented(record.presented_ns);
}

void PlaceControl::restart(Restart what) {
  if (what != Restart::Visitor) return;
  bring_home();
  stroboscope_ = false;
}

void PlaceControl::finish() {
  head_.log_latency();
  parts_.wand.log_losses();
}

}  // namespace afm::app
