// SPDX-License-Identifier: Apache-2.0
#include "panels/painted_shapes.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <span>

namespace afm::render {
namespace painted_shapes_test {

class PaintedShapesTest : public testing::Test {
 protected:
  // Squares of ten texels at these places along x.
  PaintedShapes squares(std::span<const float> places, float clip_to = 1000.0F) {
    ImDrawList list(ImGui::GetDrawListSharedData());
    list._ResetForNewFrame();
    list.PushClipRect({0.0F, 0.0F}, {clip_to, 1000.0F});
    for (const float x : places) list.AddRectFilled({x, 20.0F}, {x + 10.0F, 30.0F}, IM_COL32_WHITE);
    PaintedShapes shapes;
    shapes.add(list);
    return shapes;
  }

 private:
  struct Deleter {
    void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
  };
  std::unique_ptr<ImGuiContext, Deleter> context_{ImGui::CreateContext()};
};

TEST_F(PaintedShapesTest, DifferWhereAShapeHasMovedFromAndTo) {
  const auto difference =
      squares(std::array{0.0F, 100.0F, 300.0F}).difference(squares(std::array{0.0F, 140.0F, 300.0F}));
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->low.x, 100.0F);
  EXPECT_EQ(difference->high.x, 150.0F);
  EXPECT_EQ(difference->low.y, 20.0F);
  EXPECT_EQ(difference->high.y, 30.0F);
}

TEST_F(PaintedShapesTest, DifferWhereOneIsMore) {
  const auto difference = squares(std::array{0.0F, 100.0F, 300.0F}).difference(squares(std::array{0.0F, 300.0F}));
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->low.x, 100.0F);
  EXPECT_EQ(difference->high.x, 110.0F);
}

TEST_F(PaintedShapesTest, OfTheSamePaintingDifferNowhere) {
  const auto difference = squares(std::array{0.0F, 100.0F}).difference(squares(std::array{0.0F, 100.0F}));
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->low, difference->high);
}

TEST_F(PaintedShapesTest, OfAnotherClipMayDifferAnywhere) {
  EXPECT_FALSE(squares(std::array{0.0F}).difference(squares(std::array{0.0F}, 5.0F)));
  EXPECT_FALSE(squares(std::array{0.0F}).difference(PaintedShapes()));
}

}  // namespace painted_shapes_test
}  // namespace afm::render
