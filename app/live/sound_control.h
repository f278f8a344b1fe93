// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/view_control.h"

namespace afm::app {

struct ViewParts;

// Sound of the live window. The picture can be blank for people who only listen.
class SoundControl final : public ViewControl {
 public:
  explicit SoundControl(ViewParts& parts) : parts_(parts) {}

  void say_state();
  void toggle_sound();
  void toggle_picture();

  void update(const ViewFrame& frame) override;
  void add_to_picture(render::FrameState& picture, const ViewFrame& frame) override;
  void restart(Restart what) override;

 private:
  ViewParts& parts_;
};

}  // namespace afm::app
