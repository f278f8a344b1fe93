// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/blank_picture.h"

#include <gtest/gtest.h>

namespace afm::exhibit {
namespace blank_picture_test {

TEST(BlankPicture, ShowsNoPanelWhateverWasShown) {
  render::FrameState frame;
  frame.room_from_node.resize(3, glm::dmat4(1.0));
  const auto show = [](auto& slot) { slot.placement = {.right_m = {1.0, 0.0, 0.0}, .up_m = {0.0, 1.0, 0.0}}; };
  core::for_each_member(show, frame.panels);
  frame.labels.push_back({.text = "Mica", .highlighted = false, .placement = {}});
  blank(frame);
  core::for_each_member([](const auto& slot) { EXPECT_EQ(slot.placement, render::kNoPlacement); }, frame.panels);
  EXPECT_TRUE(frame.labels.empty());
  EXPECT_EQ(frame.visible, std::vector<std::uint8_t>(3, 0));
}

TEST(BlankPicture, KeepsTheWordsThatSayHowToGetItBack) {
  render::FrameState frame;
  for (const char* text : {"Mica", "X: show the picture"}) frame.labels.push_back({.text = text, .placement = {}});
  blank(frame, "X: show the picture");
  ASSERT_EQ(frame.labels.size(), 1U);
  EXPECT_EQ(frame.labels[0].text, "X: show the picture");
  blank(frame);
  EXPECT_TRUE(frame.labels.empty());
}

}  // namespace blank_picture_test
}  // namespace afm::exhibit
