// SPDX-License-Identifier: Apache-2.0
#include "passes/pixel_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <span>
#include <vector>

namespace afm::render {
namespace {

bool covers(const PixelArea& area, const PixelBox& box) {
  return area.everything() || std::any_of(area.boxes().begin(), area.boxes().end(),
                                          [&](const PixelBox& has) { return has.within(box) == box; });
}

TEST(PixelAreaTest, HasWhateverWasAddedInAFewBoxes) {
  std::mt19937 random(7);
  std::uniform_int_distribution place(0, 900), size(1, 300);
  for (int round = 0; round < 200; ++round) {
    PixelArea area;
    std::vector<PixelBox> added;
    for (int i = 0; i < 12; ++i) {
      const glm::ivec2 low{place(random), place(random)};
      added.push_back({low, low + glm::ivec2{size(random), size(random)}});
      area.add(added.back());
      ASSERT_LE(area.boxes().size(), PixelArea::kMostBoxes);
      for (const PixelBox& box : added) ASSERT_TRUE(covers(area, box)) << "round " << round;
    }
  }
}

bool overlap(const PixelArea& area) {
  const std::span<const PixelBox> boxes = area.boxes();
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      if (!boxes[a].within(boxes[b]).empty()) return true;
    }
  }
  return false;
}

// Copies into overlapping rectangles would need a barrier between them.
TEST(PixelAreaTest, NeverHasAPixelTwice) {
  std::mt19937 random(11);
  std::uniform_int_distribution place(0, 900), size(1, 700);
  for (int round = 0; round < 200; ++round) {
    PixelArea area;
    for (int i = 0; i < 12; ++i) {
      const glm::ivec2 low{place(random), place(random)};
      area.add({low, low + glm::ivec2{size(random), size(random)}});
      ASSERT_FALSE(overlap(area)) << "round " << round;
    }
  }
  PixelArea cross;
  cross.add({{0, 400}, {900, 500}});
  cross.add({{400, 0}, {500, 900}});
  EXPECT_EQ(cross.boxes().size(), 1U) << "one rectangle around both";
}

TEST(PixelAreaTest, KeepsApartWhatIsFarApart) {
  PixelArea area;
  area.add({{0, 0}, {10, 10}});
  area.add({{800, 500}, {810, 510}});
  area.add({{5, 5}, {5, 9}});  // empty
  EXPECT_EQ(area.boxes().size(), 2U);
  EXPECT_DOUBLE_EQ(area.share_of({1000, 1000}), 200e-6);
}

}  // namespace
}  // namespace afm::render
