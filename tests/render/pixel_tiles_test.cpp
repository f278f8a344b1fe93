// SPDX-License-Identifier: Apache-2.0
#include "drawing/pixel_tiles.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace afm::render {
namespace pixel_tiles_test {

// Number of the area's boxes that contain the pixel.
int times(const PixelArea& area, const glm::ivec2& pixel) {
  int count = 0;
  for (const PixelBox& box : area.boxes()) {
    count += PixelBox{pixel, pixel + 1}.within(box).empty() ? 0 : 1;
  }
  return count;
}

TEST(PixelTilesTest, HaveWhateverWasAddedInAFewBoxesThatDoNotOverlap) {
  std::mt19937 random(5);
  for (const vk::Extent2D extent : {vk::Extent2D{960, 540}, vk::Extent2D{101, 77}, vk::Extent2D{4096, 300}}) {
    const glm::ivec2 size(PixelBox::whole(extent).high);
    std::uniform_int_distribution x(-50, size.x + 50), y(-50, size.y + 50), side(1, 120);
    for (int round = 0; round < 60; ++round) {
      PixelTiles tiles(extent);
      std::vector<PixelBox> added;
      for (int i = 0; i < 1 + round % 7; ++i) {
        const glm::ivec2 low{x(random), y(random)};
        added.push_back({low, low + glm::ivec2{side(random), side(random)}});
        tiles.add(added.back());
      }
      const PixelArea area = tiles.area();
      ASSERT_LE(area.boxes().size(), PixelArea::kMostBoxes);
      for (const PixelBox& box : area.boxes()) {
        ASSERT_EQ(box.within(PixelBox::whole(extent)), box);
        ASSERT_EQ(box.low.x % 64 + box.low.y % 64, 0) << "where lavapipe's scissor is exact";
      }
      for (const PixelBox& box : added) {
        const PixelBox inside = box.within(PixelBox::whole(extent));
        if (inside.empty()) continue;
        for (const glm::ivec2& pixel : {inside.low, inside.high - 1, (inside.low + inside.high) / 2}) {
          ASSERT_EQ(times(area, pixel), 1) << "round " << round;
        }
      }
    }
  }
}

// A diagonal line fills little of the rectangle around it.
TEST(PixelTilesTest, LeaveOutWhatIsBetween) {
  const vk::Extent2D extent{960, 540};
  PixelTiles tiles(extent);
  EXPECT_TRUE(tiles.area().empty());
  for (int i = 0; i < 500; i += 10) tiles.add({glm::ivec2(i), glm::ivec2(i + 10)});
  EXPECT_LT(tiles.area().share_of(extent), 0.5 * 500 * 500 / (960.0 * 540.0));
  EXPECT_EQ(tiles.area().around().low, glm::ivec2(0));
  PixelArea everything;
  everything.add_everything();
  tiles.add(everything);
  EXPECT_TRUE(tiles.area().everything());
}

}  // namespace pixel_tiles_test
}  // namespace afm::render
