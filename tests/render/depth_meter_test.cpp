// SPDX-License-Identifier: Apache-2.0
#include "render/depth_meter.h"

#include <glm/gtc/matrix_transform.hpp>

#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace depth_meter_test {

constexpr double kHeadM = 2.5;         // distance from the wall
constexpr double kHalfWidthM = 1.524;  // half the width of the wall
constexpr double kToleranceM = 1e-4;   // precision of a 32-bit depth

class DepthMeters : public VulkanTest {
 protected:
  void add_square(double z, double x, double size = 0.2) {
    add(scene_, "square", quad(white_),
        glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.0, z)), glm::dvec3(size)));
  }
  std::optional<render::DepthRange> measure(const render::RendererOptions& options) {
    auto renderer = make_renderer(scene_, options);
    renderer.render(bare_frame(scene_));
    render::DepthMeter meter(context_, renderer);
    EXPECT_FALSE(meter.newest());
    meter.measure();
    meter.wait();
    return meter.newest();
  }
  scene::Scene scene_;
  std::uint32_t white_ = add_material(scene_, {.name = "white", .unlit = true});
};

TEST_F(DepthMeters, FindsTheNearestAndTheFarthestThing) {
  add_square(0.5, -0.6);
  add_square(-1.5, 0.6);
  add_square(0.0, 0.0);
  for (const auto mode : {render::PassMode::Multiview, render::PassMode::TwoPasses}) {
    for (const std::uint32_t samples : {1U, 4U}) {
      const auto range = measure(small(samples, mode));
      ASSERT_TRUE(range);
      EXPECT_NEAR(range->nearest_m, kHeadM - 0.5, kToleranceM);
      EXPECT_NEAR(range->farthest_m, kHeadM + 1.5, kToleranceM);
    }
  }
}

TEST_F(DepthMeters, SeesWhatTheLeftEyeAloneSees) {
  // at the picture's left border, before the wall: inside the left eye's image, outside the right one's
  add_square(1.6, -0.56, 0.06);
  add_square(0.0, 0.0);
  const auto range = measure(small());
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->nearest_m, kHeadM - 1.6, kToleranceM);
}

TEST_F(DepthMeters, SeesWhatTheRightEyeAloneSees) {
  add_square(1.6, 0.56, 0.06);
  add_square(0.0, 0.0);
  const auto range = measure(small());
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->nearest_m, kHeadM - 1.6, kToleranceM);
}

// The meter works in groups of 64 pixels: column 65 needs a second group.
TEST_F(DepthMeters, SeesWhatLiesInTheLastColumnAlone) {
  add_square(-1.5, 0.0, 20.0);
  add_square(0.0, kHalfWidthM - 0.014, 0.03);
  render::RendererOptions options = small(1);
  options.eye_width = options.eye_height = 65;
  const auto range = measure(options);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->nearest_m, kHeadM, kToleranceM);
  EXPECT_NEAR(range->farthest_m, kHeadM + 1.5, kToleranceM);
}

TEST_F(DepthMeters, SaysNothingOfAnEmptyPicture) {
  add_square(9.0, 0.0);  // square behind the head
  EXPECT_FALSE(measure(small()));
}

TEST_F(DepthMeters, FollowsEveryFrameThroughResizes) {
  add_square(0.0, 0.0);
  auto renderer = make_renderer(scene_, small());
  render::DepthMeter meter(context_, renderer);
  meter.measure();  // no result before the first frame
  meter.wait();
  EXPECT_FALSE(meter.newest());
  for (const double z : {0.3, -0.4, 1.0}) {
    auto frame = bare_frame(scene_);
    frame.room_from_node[0][3].z = z;
    renderer.render(frame);
    meter.measure();
    meter.measure();  // request while one is running
    meter.wait();
    ASSERT_TRUE(meter.newest());
    EXPECT_NEAR(meter.newest()->nearest_m, kHeadM - z, kToleranceM);
    ASSERT_TRUE(renderer.resize(100 + static_cast<std::uint32_t>(100 * std::abs(z)), 77));
  }
}

}  // namespace depth_meter_test
}  // namespace afm::test
