// SPDX-License-Identifier: Apache-2.0
// What is drawn of a wall, frame by frame.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "app/bench/render_subjects.h"
#include "exhibit/frame/exhibit_setup.h"
#include "support/deep.h"
#include "support/pictures.h"
#include "support/places.h"
#include "support/scratch_folder.h"
#include "support/vulkan_fixture.h"

namespace afm::exhibit {
namespace wall_pixels_test {

core::Result<Stage> stage_on(const std::string& wall_file) {
  ExhibitFiles files;
  files.assets_dir = support::source("assets");
  files.wall = wall_file;
  return load_exhibit(files);
}

using PixelsOfAWall = test::VulkanTest;

// In a cycle most of the wall stays unchanged: partial redrawing gives the same bytes as drawing all of it.
TEST_F(PixelsOfAWall, AreRedrawnWhereTheTipMovesAndAsIfAllWere) {
  const auto stage = stage_on(support::source("assets/walls/desk-red-cyan.toml"));
  ASSERT_TRUE(stage) << stage.error().message;
  const auto subject = app::wall_subject(*stage, 960, app::WallMotion::Tip).value();
  render::RendererOptions drawing = subject.drawing;
  auto changes = make_renderer(subject.scene, drawing);
  drawing.redraw = render::Redraw::Everything;
  auto everything = make_renderer(subject.scene, drawing);
  constexpr std::size_t kSettling = 2;
  const std::size_t frames = support::deep() ? 12 : 6;
  double redrawn = 0;
  for (std::size_t i = 0; i < frames; ++i) {
    changes.render(subject.frames[i]);
    everything.render(subject.frames[i]);
    if (i >= kSettling) redrawn += changes.redrawn_share();
    for (const scene::Eye eye : scene::kEyes) {
      ASSERT_EQ(test::where_differ(changes.read_eye(eye), everything.read_eye(eye)), "")
          << "frame " << i << ", eye " << static_cast<int>(eye);
    }
    const render::Composition anaglyph{.mode = scene::StereoMode::AnaglyphRedCyan};
    ASSERT_EQ(test::where_differ(changes.read_composed(anaglyph), everything.read_composed(anaglyph)), "")
        << "frame " << i;
  }
  EXPECT_LT(redrawn / static_cast<double>(frames - kSettling), 0.7);
}

TEST_F(PixelsOfAWall, MayBeFewAndMany) {
  const support::ScratchFolder folder;
  const auto stage = stage_on(folder.write("wall.toml",
                                           "[[screen]]\nname = \"wall\"\nlower_left = [-3.5, 0.5, 0.0]\n"
                                           "lower_right = [3.5, 0.5, 0.0]\nupper_left = [-3.5, 2.5, 0.0]\n[[viewer]]\n"
                                           "name = \"one\"\nipd = \"63 mm\"\nsweet_spot = [0.0, 1.65, 4.0]\n"));
  for (const double texels_per_m : {1.0, 20.0, 1e5}) {
    auto subject = app::wall_subject(*stage, 16, app::WallMotion::Tip).value();
    subject.drawing.panel_texels_per_m = texels_per_m;
    auto renderer = make_renderer(subject.scene, subject.drawing);
    renderer.render(subject.frames.front());
    renderer.wait();
  }
}

}  // namespace wall_pixels_test
}  // namespace afm::exhibit
