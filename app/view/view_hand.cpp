// SPDX-License-Identifier: Apache-2.0
#include "app/view/view_hand.h"

#include <glm/geometric.hpp>

#include "app/view/servo_supervisor.h"
#include "exhibit/frame/exhibit_setup.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

MouseHand hand_over(const exhibit::WallScene& wall_scene) {
  return MouseHand(wall_scene.sample_normal(), wall_scene.sample_right());
}

}  // namespace

ViewHand::ViewHand(const exhibit::Stage& stage, ServoSupervisor& servo, const Settings& settings)
    : stage_(stage),
      servo_(servo),
      settings_(settings),
      swatches_(stage.wall_scene.swatch_targets()),
      mouse_(hand_over(stage.wall_scene)),
      person_(stage.wall_scene.places().wand_grip_m(), stage.wall_scene.sample_normal(), input::HandPath{}) {}

// Source of the hand's motion; mouse and simulated person cannot move a real device.
HandSource ViewHand::source() const {
  if (has_own_hand()) return HandSource::Device;
  return demonstrates_ ? HandSource::Simulated : settings_.source;
}

bool ViewHand::has_own_hand() const { return servo_.link().device().has_own_hand != 0; }

exhibit::Controls ViewHand::controls(exhibit::Pointer pointer) const {
  using exhibit::HandControls;
  switch (source()) {
    case HandSource::Mouse:
      return {HandControls::Mouse, pointer};
    case HandSource::Simulated:
      return {HandControls::Simulated, pointer};
    case HandSource::Device:
      break;
  }
  return {settings_.device, pointer};
}

void ViewHand::renew_mouse() { mouse_ = hand_over(stage_.wall_scene); }

void ViewHand::begin_person(std::size_t material, std::int64_t now_ns) {
  person_.begin(swatches_[material].center_m, static_cast<std::int32_t>(material), now_ns);
}

void ViewHand::move(const Motion& motion) {
  if (!servo_.running() || source() == HandSource::Device) return;
  servo::ServoClient& servo = servo_.link();
  if (source() == HandSource::Mouse) {
    mouse_.update(motion.cursor_px, motion.m_per_px, motion.frame_s, motion.now_ns);
    return servo.script(mouse_.script());
  }
  if (replaced_.revision != 0) return servo.script(replaced_);
  const std::int32_t material = servo.tip().material;
  const bool done = person_.step() == input::SimulatedPerson::Step::Done && !demonstrates_;
  const bool another = person_.material() != material && servo.chosen() == material;  // a lesson has chosen it
  if (material >= 0 && (done || another)) begin_person(static_cast<std::size_t>(material), motion.now_ns);
  person_.update(motion.now_ns, servo.tip());
  servo.script(person_.hand());
}

void ViewHand::set_axes(const glm::dvec3& normal, const glm::dvec3& right) {
  const glm::dvec3 unit = glm::normalize(normal);
  mouse_.set_axes(unit, glm::normalize(right));
  person_.set_normal(unit);
}

}  // namespace afm::app
