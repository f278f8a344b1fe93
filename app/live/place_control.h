// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "app/view/view_control.h"
#include "input/simulated_head.h"
#include "input/view_head.h"

namespace afm::app {

struct ViewParts;

// Position of the viewer's head, and offset and stroboscope of the scene.
class PlaceControl final : public ViewControl {
 public:
  enum class Eyes { Followed, OfHeadset };

  // `script` moves a head if there is no tracker; may be empty.
  PlaceControl(ViewParts& parts, const std::vector<input::HeadKey>& script, Eyes eyes);

  void move_head(double right_m, double up_m, double nearer_m);

  // Returns scene and head to their initial places.
  void bring_home();

  // Moves the contact into the wall's plane, where both eyes see it at the same place.
  void bring_to_wall();

  // Switches the slow-motion view of a tapping lever's swing.
  void toggle_stroboscope();

  void update(const ViewFrame& frame) override;
  void add_to_moment(exhibit::Moment& now, ViewFrame& frame) override;
  void add_to_log(servo::FrameRecord& record) override;
  void restart(Restart what) override;
  void finish() override;

 private:
  double before_wall_m() const;  // distance of the contact point in front of the wall

  ViewParts& parts_;
  Eyes eyes_;
  input::ViewHead head_;
  input::SimulatedHead simulated_head_;  // head used without a tracker
  glm::dmat4 to_wall_{1.0};              // transform after the wand's navigation
  bool stroboscope_ = false;
};

}  // namespace afm::app
