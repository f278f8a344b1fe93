// SPDX-License-Identifier: Apache-2.0
#include "exhibit/blank_picture.h"

namespace afm::exhibit {

void blank(render::FrameState& frame) {
  frame.visible.assign(frame.room_from_node.size(), 0);
  frame.force_placement = frame.image_placement = frame.loop_placement = frame.data_placement = frame.banner_placement =
      frame.control_placement = render::kNoPlacement;
  frame.labels.clear();
  frame.contact = {};
}

}  // namespace afm::exhibit
