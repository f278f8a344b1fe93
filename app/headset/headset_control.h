// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "app/view/view_control.h"

namespace afm::app {

class ViewHeadset;
struct ViewParts;

// Headset in the live window: the runtime's frames, whether the wearer sees them, and the controller as a wand.
class HeadsetControl final : public ViewControl {
 public:
  // Both arguments must outlive the object.
  HeadsetControl(ViewParts& parts, ViewHeadset& headset);

  void begin_frame() override;
  void add_to_log(servo::FrameRecord& record) override;

 private:
  ViewParts& parts_;
  ViewHeadset& headset_;
  std::optional<std::int64_t> felt_ring_ns_;  // beginning of the newest ring of light signalled by the controller
};

}  // namespace afm::app
