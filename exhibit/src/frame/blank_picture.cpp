// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/blank_picture.h"

#include <vector>

namespace afm::exhibit {

void blank(render::FrameState& frame, std::string_view kept) {
  frame.visible.assign(frame.room_from_node.size(), 0);
  hide(frame.panels);
  std::erase_if(frame.labels, [&](const render::Label& label) { return kept.empty() || label.text != kept; });
  frame.contact = {};
}

}  // namespace afm::exhibit
