// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace calibration_test {

class Calibration : public VulkanTest {
 protected:
  Pair pattern(render::PassMode mode, bool eye_marks = true, const std::array<scene::EdgeRamp, 4>& ramps = {}) {
    auto frame = bare_frame(test_.scene);
    frame.visible.assign(test_.scene.nodes.size(), 0);
    frame.panels.calibration.content = {.size = "wall",
                                        .mode = "side-by-side",
                                        .legend = "squares",
                                        .ruler = "eyes",
                                        .ipd_m = 0.063,
                                        .eye_marks = eye_marks,
                                        .ramps = ramps};
    for (std::size_t edge = 0; edge < ramps.size(); ++edge) {
      if (ramps.at(edge).width_m > 0.0) frame.panels.calibration.content.ramp_widths.at(edge) = "300 mm";
    }
    const scene::Screen screen = paper_screen();
    frame.panels.calibration.placement = {.lower_left_m = screen.lower_left,
                                          .right_m = screen.lower_right - screen.lower_left,
                                          .up_m = screen.upper_left - screen.lower_left};
    return draw(test_.scene, frame, small(4, mode));
  }
  // White pixels in a part of the picture, in shares of its size.
  static std::size_t whites(const render::Image& image, double left, double right) {
    std::size_t found = 0;
    for (std::uint32_t y = image.height / 3; y < 2 * image.height / 3; ++y) {
      for (auto x = static_cast<std::uint32_t>(left * image.width); x < right * image.width; ++x) {
        const Pixel p = pixel(image, x, y);
        found += std::min({p.r, p.g, p.b}) > 230 ? 1U : 0U;
      }
    }
    return found;
  }
  TestScene test_ = make_test_scene();
};

TEST_F(Calibration, ShowsTheLToTheLeftEyeAndTheRToTheRightEyeAlone) {
  for (const auto mode : {render::PassMode::Multiview, render::PassMode::TwoPasses}) {
    const auto eyes = pattern(mode);
    EXPECT_GT(whites(eyes.left, 0.12, 0.36), 200U);
    EXPECT_LT(whites(eyes.left, 0.64, 0.88), 20U);
    EXPECT_LT(whites(eyes.right, 0.12, 0.36), 20U);
    EXPECT_GT(whites(eyes.right, 0.64, 0.88), 200U);
  }
}

TEST_F(Calibration, ShowsNeitherLetterWhereBothEyesSeeOnePicture) {
  const auto eyes = pattern(render::PassMode::Multiview, false);
  for (const render::Image* eye : {&eyes.left, &eyes.right}) {
    EXPECT_LT(whites(*eye, 0.12, 0.36), 20U);
    EXPECT_LT(whites(*eye, 0.64, 0.88), 20U);
  }
}

// Green lines at both ends of a ramp, at its stated width from the edge.
TEST_F(Calibration, MarksWhereThePictureFadesOut) {
  const auto columns_of = [&](const std::array<scene::EdgeRamp, 4>& ramps) {
    const render::Image plain = pattern(render::PassMode::Multiview).left;
    const render::Image marked = pattern(render::PassMode::Multiview, true, ramps).left;
    std::vector<std::uint32_t> columns;
    for (std::uint32_t x = 0; x < plain.width; ++x) {
      int greener = 0;
      for (std::uint32_t y = 120; y < 180; ++y) greener += pixel(marked, x, y).g - pixel(plain, x, y).g;
      if (greener > 60 * 5) columns.push_back(x);
    }
    return columns;
  };
  const double px_per_m = 256.0 / paper_screen().width_m();
  const auto right = columns_of({scene::EdgeRamp{}, {}, {0.1, 0.3}, {}});
  ASSERT_FALSE(right.empty());
  EXPECT_NEAR(right.front(), 256.0 - 0.4 * px_per_m, 2.0);
  EXPECT_NEAR(right.back(), 256.0 - 0.1 * px_per_m, 2.0);
  EXPECT_LE(right.size(), 6U);
  const auto left = columns_of({scene::EdgeRamp{0.2, 0.3}, {}, {}, {}});
  ASSERT_FALSE(left.empty());
  EXPECT_NEAR(left.front(), 0.2 * px_per_m, 2.0);
  EXPECT_NEAR(left.back(), 0.5 * px_per_m, 2.0);
}

TEST_F(Calibration, LiesInTheWallsPlane) {
  const auto eyes = pattern(render::PassMode::Multiview);
  std::size_t unlike = 0;
  for (std::uint32_t y = 0; y < eyes.left.height; ++y) {
    for (std::uint32_t x = 0; x < eyes.left.width; ++x) {
      const bool letter = (x > 0.13 * 256 && x < 0.35 * 256) || (x > 0.65 * 256 && x < 0.87 * 256);
      const Pixel a = pixel(eyes.left, x, y), b = pixel(eyes.right, x, y);
      if (!letter) unlike += std::abs(a.g - b.g) > 2 ? 1U : 0U;
    }
  }
  EXPECT_LT(unlike, 50U);
}

}  // namespace calibration_test
}  // namespace afm::test
