// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/view_control.h"
#include "exhibit/scenery/journey.h"

namespace afm::app {

struct ViewParts;

// Replaces the instrument in the window by the journey of scale or the analogy.
class JourneyControl final : public ViewControl {
 public:
  JourneyControl(ViewParts& parts, exhibit::JourneyTravel::Motion motion) : parts_(parts), travel_(motion) {}

  void turn_round();
  void toggle_analogy();

  void update(const ViewFrame& frame) override;
  void add_to_moment(exhibit::Moment& now, ViewFrame& frame) override;
  void restart(Restart what) override;

 private:
  ViewParts& parts_;
  exhibit::JourneyTravel travel_;
  bool analogy_ = false;
};

}  // namespace afm::app
