// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/blank_picture.h"

#include <algorithm>
#include <vector>

namespace afm::exhibit {

void blank(render::FrameState& frame, std::string_view kept) {
  frame.visible.assign(frame.room_from_node.size(), 0);
  hide(frame.panels);
  std::erase_if(frame.labels, [&](const render::Label& label) { return kept.empty() || label.text != kept; });
  frame.contact = {};
}

void blank(render::FrameState& frame, const Phrases& phrases) {
  std::string_view kept;
  for (const Phrase why : {Phrase::PictureBlank, Phrase::PictureDark, Phrase::HeardFarEnough}) {
    const auto says = [&](const render::Label& label) { return label.text == phrases[why]; };
    if (std::any_of(frame.labels.begin(), frame.labels.end(), says)) kept = phrases[why];
  }
  blank(frame, kept);
}

}  // namespace afm::exhibit
