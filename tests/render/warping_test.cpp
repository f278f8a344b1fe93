// SPDX-License-Identifier: Apache-2.0
// Invariant: a mesh that bends nothing shows the same bytes; no mesh changes a pixel's eye (docs/decisions/0013)
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>

#include "support/anaglyph.h"
#include "support/pictures.h"
#include "support/vulkan_fixture.h"

// Warp meshes bend an output's picture after the stereo layout has chosen each pixel's eye.
namespace afm::test {
namespace warping_test {

using scene::EyeOrder;
using scene::StereoMode;

using PlaceOfPicture = std::function<glm::dvec2(const glm::dvec2& output)>;

std::shared_ptr<const scene::WarpMesh> mesh_of(std::uint32_t columns, std::uint32_t rows, const PlaceOfPicture& place,
                                               double intensity = 1.0) {
  scene::WarpMesh mesh{columns, rows, {}};
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const glm::dvec2 output(double(column) / (columns - 1), double(row) / (rows - 1));
      mesh.nodes.push_back({output, place(output), intensity});
    }
  }
  return std::make_shared<const scene::WarpMesh>(std::move(mesh));
}

glm::dvec2 straight_place(const glm::dvec2& output) { return output; }
glm::dvec2 quarter_to_the_right(const glm::dvec2& output) { return output - glm::dvec2(0.25, 0.0); }

class Warped : public VulkanTest {
 protected:
  void SetUp() override {
    renderer_.emplace(make_renderer(test_.scene, small()));
    renderer_->render(full_frame(test_));
    left_ = renderer_->read_eye(scene::Eye::Left);
    right_ = renderer_->read_eye(scene::Eye::Right);
  }

  TestScene test_ = make_test_scene();
  std::optional<render::Renderer> renderer_;
  render::Image left_, right_;
};

TEST_F(Warped, AMeshThatBendsNothingShowsTheSameBytes) {
  const auto mesh = mesh_of(9, 6, straight_place);
  for (const scene::StereoModeTraits& row : scene::kStereoModes) {
    for (const EyeOrder order : {EyeOrder::Straight, EyeOrder::Swapped}) {
      render::Composition plain{.mode = row.mode, .order = order}, warped = plain;
      warped.warp = mesh;
      if (scene::has_two_pictures(row.mode)) {
        const auto a = renderer_->read_pair(plain), b = renderer_->read_pair(warped);
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(where_differ(a.at(i), b.at(i)), "") << row.name;
        continue;
      }
      for (const glm::uvec2 size_px : {glm::uvec2(0), glm::uvec2(61, 147), glm::uvec2(1, 1)}) {
        const render::ReadArea area{.size_px = size_px, .screen_px = {3, -2}};
        EXPECT_EQ(where_differ(renderer_->read_composed(plain, area), renderer_->read_composed(warped, area)), "")
            << row.name << ", " << size_px.x;
      }
    }
  }
}

// The eye of a pixel is that of the output's pixel, wherever the mesh takes its colour from.
TEST_F(Warped, AMeshMovesThePictureInsideEachEyesPartAndLeavesTheRestBlack) {
  const auto mesh = mesh_of(5, 3, quarter_to_the_right);
  constexpr unsigned kShiftPx = 64;
  for (const StereoMode mode : {StereoMode::Left, StereoMode::Right, StereoMode::SideBySide, StereoMode::TopBottom,
                                StereoMode::Row, StereoMode::Column, StereoMode::Checkerboard}) {
    const render::ReadArea area{.screen_px = {1, 2}};
    const render::Image picture = renderer_->read_composed({.mode = mode, .warp = mesh}, area);
    std::size_t wrong = 0;
    for (unsigned y = 0; y < picture.height; ++y) {
      for (unsigned x = 0; x < picture.width; ++x) {
        const auto source =
            scene::source_of_pixel(mode, EyeOrder::Straight, {picture.width, picture.height}, {x, y}, area.screen_px);
        const render::Image& eye = source.eye == scene::PixelEye::Left ? left_ : right_;
        const glm::uvec2 at(source.uv * glm::dvec2(eye.width, eye.height));
        const auto expected = at.x < kShiftPx ? std::array{0, 0, 0} : rgb_at(eye, at.x - kShiftPx, at.y);
        wrong += rgb_at(picture, x, y) == expected ? 0U : 1U;
      }
    }
    EXPECT_EQ(wrong, 0U) << scene::name_of(mode);
  }
  const auto pair = renderer_->read_pair({.mode = StereoMode::Dual, .warp = mesh});
  EXPECT_EQ(rgb_at(pair[1], 200, 100), rgb_at(right_, 200 - kShiftPx, 100));
}

// Computed picture: bilinear in linear light at the mesh's place, times its intensity.
TEST_F(Warped, ABarrelShowsWhatItsArithmeticSays) {
  const auto barrel = [](const glm::dvec2& output) {
    const glm::dvec2 from_middle = output - 0.5;
    return 0.5 + (0.88 + 0.2 * (from_middle.x * from_middle.x + from_middle.y * from_middle.y)) * from_middle;
  };
  constexpr double kIntensity = 0.75;
  const auto mesh = mesh_of(17, 13, barrel, kIntensity);
  const render::Image picture = renderer_->read_composed({.mode = StereoMode::Right, .warp = mesh});
  const auto light_at = [&](int x, int y) {
    const auto clamped = glm::clamp(glm::ivec2(x, y), glm::ivec2(0), glm::ivec2(right_.width - 1, right_.height - 1));
    return linear_light(rgb_at(right_, static_cast<unsigned>(clamped.x), static_cast<unsigned>(clamped.y)));
  };
  int largest = 0;
  double moved_px = 0;
  for (unsigned y = 0; y < picture.height; ++y) {
    for (unsigned x = 0; x < picture.width; ++x) {
      const glm::dvec2 output((x + 0.5) / picture.width, (y + 0.5) / picture.height);
      const auto place = scene::warped_place(*mesh, output);
      ASSERT_TRUE(place);
      const glm::dvec2 texel = place->picture * glm::dvec2(right_.width, right_.height) - 0.5;
      moved_px = std::max(moved_px, glm::length(texel - glm::dvec2(x, y)));
      const glm::ivec2 low(glm::floor(texel));
      const glm::dvec2 t = texel - glm::dvec2(low);
      const glm::dvec3 light = (1.0 - t.y) * ((1.0 - t.x) * light_at(low.x, low.y) + t.x * light_at(low.x + 1, low.y)) +
                               t.y * ((1.0 - t.x) * light_at(low.x, low.y + 1) + t.x * light_at(low.x + 1, low.y + 1));
      const auto shown = rgb_at(picture, x, y);
      for (glm::length_t c = 0; c < 3; ++c) {
        const double expected = 255.0 * kIntensity * srgb_from_linear(light[c]);
        largest = std::max(largest, static_cast<int>(std::abs(shown.at(static_cast<std::size_t>(c)) - expected)));
      }
    }
  }
  EXPECT_LE(largest, 3);  // filters have 8 bits between two pixels
  EXPECT_GT(moved_px, 5.0);
}

TEST_F(Warped, BlendsWhereThePictureIsNotWhereTheOutputIs) {
  scene::Blend blend;
  blend.fields = {{.width = {0.0, 0.0, 0.5, 0.0}},
                  {.low = {0.5, 0.0}, .high = {1.5, 1.0}, .width = {0.5, 0.0, 0.0, 0.0}}};
  const auto shared = std::make_shared<const scene::Blend>(blend);
  const auto mesh = mesh_of(5, 3, quarter_to_the_right);
  const render::Image picture = renderer_->read_composed({.mode = StereoMode::Left, .warp = mesh, .blend = shared});
  int largest = 0;
  for (unsigned x = 64; x < picture.width; ++x) {
    const auto at = blend.at({(x - 64 + 0.5) / picture.width, 0.5});
    const glm::dvec3 light = at.own / at.all * linear_light(rgb_at(left_, x - 64, 96));
    largest = std::max(largest, std::abs(rgb_at(picture, x, 96)[1] - srgb8(light.y)));
  }
  EXPECT_LE(largest, 1);
}

TEST_F(Warped, ShowsItsLinesWhereThatIsAskedFor) {
  const auto mesh = mesh_of(3, 2, quarter_to_the_right);
  render::Composition composition{.mode = StereoMode::Left, .warp = mesh};
  const auto is_line = [](const Pixel& p) { return p.r == 255 && p.g == 89 && p.b == 191; };
  EXPECT_EQ(count(renderer_->read_composed(composition), is_line), 0U);
  composition.mesh_lines = true;
  const render::Image picture = renderer_->read_composed(composition);
  EXPECT_TRUE(is_line(pixel(picture, 127, 90)) && is_line(pixel(picture, 128, 90)));
  EXPECT_TRUE(is_line(pixel(picture, 255, 90)) && is_line(pixel(picture, 150, 0)) && is_line(pixel(picture, 150, 191)));
  EXPECT_FALSE(is_line(pixel(picture, 100, 90)));
}

// A window that is resized needs the mesh at many sizes; the pictures stay right.
TEST_F(Warped, IsRightAtManySizes) {
  const auto mesh = mesh_of(5, 3, straight_place);
  for (unsigned size = 100; size < 112; ++size) {
    const render::ReadArea area{.size_px = {size, size}};
    EXPECT_EQ(where_differ(renderer_->read_composed({.mode = StereoMode::Left, .warp = mesh}, area),
                           renderer_->read_composed({.mode = StereoMode::Left}, area)),
              "");
  }
}

}  // namespace warping_test
}  // namespace afm::test
