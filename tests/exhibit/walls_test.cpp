// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/bench/render_subjects.h"
#include "exhibit/exhibit_setup.h"
#include "places.h"
#include "support/scratch_folder.h"
#include "support/vulkan_fixture.h"

namespace afm::exhibit {
namespace {

constexpr std::uint32_t kEyeWidth = 640;
constexpr std::size_t kFrame = 18;

core::Result<Stage> stage_on(const std::string& wall_file) {
  ExhibitFiles files;
  files.assets_dir = AFM_SOURCE_DIR "/assets";
  files.wall = wall_file;
  return load_exhibit(files);
}

std::string wall_text(double width_m, double height_m, double bottom_m, double ipd_mm, const glm::dvec3& head_m) {
  return fmt::format(
      "[[screen]]\nname = \"wall\"\nlower_left = [{0}, {2}, 0.0]\nlower_right = [{1}, {2}, 0.0]\n"
      "upper_left = [{0}, {3}, 0.0]\n[[viewer]]\nname = \"one\"\nipd = \"{4} mm\"\nsweet_spot = [{5}, {6}, {7}]\n",
      -0.5 * width_m, 0.5 * width_m, bottom_m, bottom_m + height_m, ipd_mm, head_m.x, head_m.y, head_m.z);
}

// ---- a wall and its models ----

class ModelsOfAWall : public test::VulkanTest {
 protected:
  // The paper's wall times `scale`, with the viewer and his eyes.
  render::Image left_eye_before(double scale) {
    const std::string path = folder_.write(
        fmt::format("{}.toml", scale),
        wall_text(3.048 * scale, 2.286 * scale, 0.4 * scale, 63.0 * scale, scale * glm::dvec3(0, 1.65, 2.5)));
    const auto stage = stage_on(path);
    EXPECT_TRUE(stage) << stage.error().message;
    auto subject = app::wall_subject(*stage, kEyeWidth).value();
    render::FrameState& frame = subject.frames[kFrame];
    frame.banner.scale.clear();  // a metre of another wall shows something else
    auto renderer = make_renderer(subject.scene, subject.drawing);
    renderer.render(frame);
    return renderer.read_eye(scene::Eye::Left);
  }

  support::ScratchFolder folder_;
};

TEST_F(ModelsOfAWall, ShowWhatItShowsTextsToo) {
  const render::Image large = left_eye_before(1.0);
  for (const double scale : {0.5, 1.4}) {
    const render::Image other = left_eye_before(scale);
    ASSERT_EQ(other.rgba.size(), large.rgba.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < large.rgba.size(); ++i) {
      differing += std::abs(int{large.rgba[i]} - int{other.rgba[i]}) > 8 ? 1U : 0U;
    }
    EXPECT_LE(static_cast<double>(differing), 0.001 * static_cast<double>(large.rgba.size())) << scale;
  }
}

// ---- everything has its place on every wall ----

struct Rectangle {
  glm::dvec2 low{1e300}, high{-1e300};

  void take(const glm::dvec2& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  bool overlaps(const Rectangle& other) const {
    return glm::all(glm::lessThan(low, other.high)) && glm::all(glm::lessThan(other.low, high));
  }
};

// Where a panel is seen on the screen, 0..1 each way.
Rectangle seen(const render::PanelPlacement& panel, const scene::EyeView& eye) {
  Rectangle rectangle;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      const glm::dvec3 corner = panel.lower_left_m + x * panel.right_m + y * panel.up_m;
      const glm::dvec4 clip = eye.projection * eye.view * glm::dvec4(corner, 1.0);
      rectangle.take(0.5 * (glm::dvec2(clip) / clip.w + 1.0));
    }
  }
  return rectangle;
}

void expect_everything_in_its_place(const std::string& wall_file, const std::string& what) {
  const auto stage = stage_on(wall_file);
  ASSERT_TRUE(stage) << what << ": " << stage.error().message;
  const double height = glm::dot(stage->wall_scene.contact_m() - stage->screen.lower_left,
                                 glm::normalize(stage->screen.upper_left - stage->screen.lower_left)) /
                        stage->screen.height_m();
  EXPECT_GE(height, 1.0 / 3.0) << what;
  EXPECT_LE(height, 2.0 / 3.0 + 1e-12) << what;
  const render::FrameState frame = app::wall_subject(*stage, kEyeWidth).value().frames[kFrame];
  const auto place = [&](const render::PanelPlacement& panel) { return seen(panel, stage->eyes[0]); };
  std::vector<std::pair<std::string, Rectangle>> places{{"banner", place(frame.banner_placement)},
                                                        {"force", place(frame.force_placement)},
                                                        {"data", place(frame.data_placement)}};
  for (const render::Label& label : frame.labels) places.emplace_back(label.text, place(label.placement));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [name, rectangle] = places[i];
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(rectangle.low, glm::dvec2(0.0)))) << what << ": " << name;
    EXPECT_TRUE(glm::all(glm::lessThanEqual(rectangle.high, glm::dvec2(1.0)))) << what << ": " << name;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(rectangle.overlaps(places[j].second)) << what << ": " << name << " and " << places[j].first;
    }
  }
}

TEST(EveryWall, HasRoomForAllThatMustBeRead) {
  for (const char* preset : {"powerwall", "two-projectors", "3d-tv", "desk-red-cyan", "tiled-2x2"}) {
    expect_everything_in_its_place(fmt::format("{}/assets/walls/{}.toml", AFM_SOURCE_DIR, preset), preset);
  }
  const support::ScratchFolder folder;
  const auto expect = [&](const char* what, double width_m, double height_m, double bottom_m,
                          const glm::dvec3& head_m) {
    expect_everything_in_its_place(folder.write("wall.toml", wall_text(width_m, height_m, bottom_m, 63.0, head_m)),
                                   what);
  };
  expect("upright", 1.2, 2.1, 0.1, {0.0, 1.65, 2.0});
  expect("square", 2.0, 2.0, 0.5, {0.3, 1.6, 2.5});
  expect("very wide", 7.0, 2.0, 0.5, {0.0, 1.65, 4.0});
  expect("four metres high", 5.3, 4.0, 0.0, {0.0, 1.65, 4.0});
  expect("seen from below", 3.0, 1.7, 2.0, {0.0, 1.4, 4.0});
  expect("on a table", 0.6, 0.34, 0.0, {0.0, 0.5, 0.6});
}

using PixelsOfAWall = test::VulkanTest;

TEST_F(PixelsOfAWall, MayBeFewAndMany) {
  const support::ScratchFolder folder;
  const auto stage = stage_on(folder.write("wall.toml", wall_text(7.0, 2.0, 0.5, 63.0, {0.0, 1.65, 4.0})));
  for (const double texels_per_m : {1.0, 20.0, 1e5}) {
    auto subject = app::wall_subject(*stage, 16).value();
    subject.drawing.panel_texels_per_m = texels_per_m;
    auto renderer = make_renderer(subject.scene, subject.drawing);
    renderer.render(subject.frames.front());
    renderer.wait();
  }
}

}  // namespace
}  // namespace afm::exhibit
