// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "haptics/contact_model.h"
#include "haptics/felt_marks.h"

// The contact with a sample on which the tip leaves marks, which has no law of force.
namespace afm::haptics {

Touch ContactModel::step_marks(const glm::dvec3& hand_m, const ScanFeedback& feedback) noexcept {
  const Scaling& scale = scaling();
  level_ = false;
  Touch touch;
  touch.tip_xy_m = glm::dvec2(hand_m) / scale.lateral_m_per_m();
  touch.z_m = scale.z_m(hand_m.z);
  if (feedback.without_force) {
    marks_->lift();
    const bool off = touch.z_m > scale.release_z_m();
    touch.response.phase = off ? physics::Phase::Free : physics::Phase::WaitForLift;
    touch.response.tip_height = physics::Length(touch.z_m);
    return touch;
  }
  touch.push = marks_->step(touch.tip_xy_m, touch.z_m, feedback.elapsed_s);
  touch.hand_force_n = marks_->scale().hand_n_per_n * touch.push.push_n;
  const bool on = touch.push.near;
  touch.response.phase = marks_->phase();
  touch.response.force = physics::Force(touch.push.push_n.z);
  // Z minus the deflection is the height of the tip; it includes the rise of a lever over which a hand moves too fast
  touch.response.tip_height = physics::Length(on ? marks_->apex_z_m() : touch.z_m);
  touch.response.cantilever_deflection = physics::Length(touch.z_m) - touch.response.tip_height;
  touch.response.sample_deformation = std::min(physics::Length(0.0), touch.response.tip_height);
  return touch;
}

PassivityObserver::Law ContactModel::marks_energy(const Touch& touch) const noexcept {
  return {
      .stored_j = marks_->stored_j(), .stiffness_n_per_m = marks_->stiffness_n_per_m(), .given_j = touch.push.given_j};
}

}  // namespace afm::haptics
