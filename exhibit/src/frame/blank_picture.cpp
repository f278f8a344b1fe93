// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/blank_picture.h"

namespace afm::exhibit {

void blank(render::FrameState& frame) {
  frame.visible.assign(frame.room_from_node.size(), 0);
  hide(frame.panels);
  frame.labels.clear();
  frame.contact = {};
}

}  // namespace afm::exhibit
