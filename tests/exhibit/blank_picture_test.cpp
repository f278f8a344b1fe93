// SPDX-License-Identifier: Apache-2.0
#include "exhibit/blank_picture.h"

#include <gtest/gtest.h>

namespace afm::exhibit {
namespace blank_picture_test {

TEST(BlankPicture, ShowsNoPanelWhateverWasShown) {
  render::FrameState frame;
  frame.room_from_node.resize(3, glm::dmat4(1.0));
  for (render::PanelPlacement* const placement :
       {&frame.force_placement, &frame.image_placement, &frame.loop_placement, &frame.data_placement,
        &frame.banner_placement, &frame.control_placement}) {
    *placement = {.right_m = {1.0, 0.0, 0.0}, .up_m = {0.0, 1.0, 0.0}};
  }
  frame.labels.push_back({.text = "Mica", .highlighted = false, .placement = {}});
  blank(frame);
  for (const render::PanelPlacement& placement :
       {frame.force_placement, frame.image_placement, frame.loop_placement, frame.data_placement,
        frame.banner_placement, frame.control_placement}) {
    EXPECT_EQ(placement, render::kNoPlacement);
  }
  EXPECT_TRUE(frame.labels.empty());
  EXPECT_EQ(frame.visible, std::vector<std::uint8_t>(3, 0));
}

}  // namespace blank_picture_test
}  // namespace afm::exhibit
