// SPDX-License-Identifier: Apache-2.0
// Invariant: a frame draws only what differs from the last one, byte for byte as if all were drawn
// (docs/decisions/0011)
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <random>
#include <string>

#include "support/deep.h"
#include "support/pictures.h"
#include "support/vulkan_fixture.h"

// A frame draws only what differs from the last one: the pictures are byte for byte those of drawing everything.
namespace afm::test {
namespace redraw_test {

constexpr int kFrames = 40;
constexpr std::array<unsigned, 3> kSeeds{1, 2, 4};

// The redrawn part is cut at multiples of 64 pixels.
render::RendererOptions of_many_tiles(std::uint32_t samples = 4,
                                      render::PassMode pass_mode = render::PassMode::Multiview) {
  render::RendererOptions options = small(samples, pass_mode);
  options.eye_width = 512;
  options.eye_height = 384;
  return options;
}

render::RendererOptions with(render::RendererOptions options, render::Redraw redraw) {
  options.redraw = redraw;
  return options;
}

// A wall in use: in most frames the tip moves a little, the number in a panel changes, or nothing does; now and then
// something else.
class Story {
 public:
  Story(const TestScene& test, unsigned seed) : test_(&test), random_(seed), frame_(full_frame(test)) {
    frame_.visible.assign(test.scene.nodes.size(), 1);
  }

  const render::FrameState& next() {
    told.clear();
    for (int i = 0; i < 1 + whole(0, 1); ++i) change();
    return frame_;
  }

  int whole(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  double real(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

  std::string told;  // changes in the newest frame

 private:
  void change() {
    const std::array<std::pair<const char*, std::function<void()>>, 18> all{{
        {"the bend", [&] { frame_.bends.front().end_deflection = static_cast<float>(real(-0.15, 0.15)); }},
        {"the lever's place", [&] { move(test_->lever, 0.02); }},
        {"the beam's place", [&] { move(test_->beam, 0.05); }},
        {"the contact", [&] { touch(); }},
        {"nothing", [] {}},
        {"a number", [&] { frame_.panels.data.content.rows[0].value = std::to_string(whole(0, 999)); }},
        {"the cursor", [&] { frame_.panels.force.content.cursor->place_nm = real(-4.0, 19.0); }},
        {"a label", [&] { frame_.labels[0].highlighted = !frame_.labels[0].highlighted; }},
        {"a label that comes or goes",
         [&] { frame_.labels.resize(frame_.labels.size() == 3 ? 2 : 3, frame_.labels[0]); }},
        {"a sample's place", [&] { move(test_->gold, 0.1); }},
        {"a far place", [&] { move(test_->mica, 2.0); }},
        {"the highlight", [&] { frame_.highlighted = {whole(0, 1) == 0 ? test_->gold : test_->nitride}; }},
        {"what is shown", [&] { frame_.visible[static_cast<std::size_t>(whole(0, 5))] ^= 1U; }},
        {"a panel's place", [&] { frame_.panels.data.placement.lower_left_m.x = real(0.0, 0.6); }},
        {"a mirror",
         [&] {
           auto& placed = frame_.room_from_node[test_->nitride];
           placed = glm::scale(placed, glm::dvec3(-1.0, 1.0, 1.0));
         }},
        {"the head", [&] { look(); }},
        {"the light", [&] { frame_.key_light.direction_to_light.x = static_cast<float>(real(-0.6, 0.6)); }},
        {"the fog", [&] { frame_.fog.fade = whole(0, 1) == 0 ? 0.0F : 0.3F; }},
    }};
    // changes of everything are rare
    const int drawn = whole(0, 99);
    const auto& [what, happens] = all[static_cast<std::size_t>(drawn < 94 ? drawn % 15 : whole(15, 17))];
    told += std::string(told.empty() ? "" : ", ") + what;
    happens();
  }

  void move(scene::NodeIndex node, double far) {
    const glm::dvec3 by{real(-far, far), real(-far, far), real(-far, far)};
    auto& placed = frame_.room_from_node[node];
    const glm::dvec3 home(full_frame(*test_).room_from_node[node][3]);
    placed[3] = glm::dvec4(home + by, 1.0);
  }

  void touch() {
    frame_.contact = {};
    if (whole(0, 4) == 0) return;
    frame_.contact = {.place_m = glm::vec3(glm::dvec3{real(-0.5, 0.5), real(-0.6, 0.2), real(-0.2, 0.2)}),
                      .shade_radius_m = static_cast<float>(real(0.01, 0.08))};
    if (whole(0, 1) == 0) return;
    frame_.contact.ring_color = {2.0F, 1.4F, 0.6F};
    frame_.contact.ring_radius_m = static_cast<float>(real(0.0, 0.2));
  }

  void look() {
    const glm::dvec3 head{real(-0.8, 0.8), real(-0.3, 0.3), real(1.2, 2.8)};
    const double ipd_m = whole(0, 3) == 0 ? 0.0 : 0.063;
    frame_.eyes = {eye_view(scene::Eye::Left, head, ipd_m), eye_view(scene::Eye::Right, head, ipd_m)};
  }

  const TestScene* test_;
  std::mt19937 random_;
  render::FrameState frame_;
};

class Redraw : public VulkanTest {
 protected:
  // Both renderers draw the same story; sizes and quality change too, and pictures are composed in every mode.
  void expect_same(const render::RendererOptions& options, unsigned seed) {
    auto changes = make_renderer(test_.scene, with(options, render::Redraw::Changes));
    auto everything = make_renderer(test_.scene, with(options, render::Redraw::Everything));
    const auto both = [&](const auto& work) {
      work(changes);
      work(everything);
    };
    Story story(test_, seed);
    scene::StereoMode mode = scene::StereoMode::SideBySide;
    glm::uvec2 size_px(0);
    int correction = 0;  // 1: warped, 2: blended
    for (int i = 0; i < kFrames; ++i) {
      const render::FrameState& frame = story.next();
      if (story.whole(0, 29) == 0) resize(story, both);
      if (story.whole(0, 29) == 0) detail(story, options.samples, both);
      both([&](render::Renderer& renderer) { renderer.render(frame); });
      const std::string what = "seed " + std::to_string(seed) + ", frame " + std::to_string(i) + ": " + story.told;
      for (const scene::Eye eye : scene::kEyes) {
        ASSERT_EQ(where_differ(changes.read_eye(eye), everything.read_eye(eye)), "")
            << what << ", eye " << static_cast<int>(eye);
      }
      if (story.whole(0, 3) == 0) mode = any_mode(story);
      if (story.whole(0, 3) == 0) size_px = story.whole(0, 1) == 0 ? glm::uvec2(0) : glm::uvec2(300, 170);
      if (story.whole(0, 3) == 0) correction = story.whole(0, 3);
      if (story.whole(0, 2) == 0) continue;
      const render::ReadArea area{.size_px = size_px, .screen_px = {1, 1}};
      render::Composition composition{.mode = mode};
      if ((correction & 1) != 0) composition.warp = mesh_;
      if ((correction & 2) != 0) composition.blend = blend_;
      ASSERT_EQ(where_differ(changes.read_composed(composition, area), everything.read_composed(composition, area)), "")
          << what << ", mode " << scene::name_of(mode) << ", correction " << correction;
    }
  }

  // Mode with one picture, no larger than both eyes side by side.
  static scene::StereoMode any_mode(Story& story) {
    scene::StereoMode mode{};
    do {
      mode = scene::kStereoModes[static_cast<std::size_t>(
                                     story.whole(0, static_cast<int>(scene::kStereoModes.size()) - 1))]
                 .mode;
    } while (scene::has_two_pictures(mode) || scene::frame_packing(mode));
    return mode;
  }

  static void resize(Story& story, const auto& both) {
    const auto width = static_cast<std::uint32_t>(story.whole(200, 600));
    both([&](render::Renderer& renderer) { ASSERT_TRUE(renderer.resize(width, 3 * width / 4)); });
  }

  static void detail(Story& story, std::uint32_t samples, const auto& both) {
    const render::FrameQuality quality{story.whole(0, 1) == 0 ? 1.0 : 0.7, story.whole(0, 1) == 0 ? 1 : samples};
    both([&](render::Renderer& renderer) { renderer.set_quality(quality); });
  }

  // Twisted about its middle, with black corners.
  static std::shared_ptr<const scene::WarpMesh> twisted() {
    scene::WarpMesh mesh{6, 5, {}};
    for (std::uint32_t row = 0; row < mesh.rows; ++row) {
      for (std::uint32_t column = 0; column < mesh.columns; ++column) {
        const glm::dvec2 output(column / 5.0, row / 4.0), from_middle = output - 0.5;
        const double turn = 0.5 - glm::dot(from_middle, from_middle);
        mesh.nodes.push_back(
            {output, 0.5 + glm::dvec2(std::cos(turn) * from_middle.x - std::sin(turn) * from_middle.y,
                                      std::sin(turn) * from_middle.x + std::cos(turn) * from_middle.y)});
      }
    }
    return std::make_shared<const scene::WarpMesh>(std::move(mesh));
  }

  static std::shared_ptr<const scene::Blend> at_the_right() {
    scene::Blend blend;
    blend.fields = {{.width = {0, 0, 0.3, 0}, .black = 0.01},
                    {.low = {0.7, 0}, .high = {1.7, 1}, .width = {0.3, 0, 0, 0}, .black = 0.01}};
    blend.brightest_black = 0.02;
    blend.darkest_black = 0.01;
    return std::make_shared<const scene::Blend>(std::move(blend));
  }

  TestScene test_ = make_test_scene();
  std::shared_ptr<const scene::WarpMesh> mesh_ = twisted();
  std::shared_ptr<const scene::Blend> blend_ = at_the_right();
};

TEST_F(Redraw, OfWhatChangedGivesTheBytesOfRedrawingEverything) {
  for (const unsigned seed : kSeeds) {
    if (!support::deep() && seed != kSeeds.front()) continue;
    expect_same(of_many_tiles(4, render::PassMode::Automatic), seed);
    if (HasFatalFailure()) return;
  }
}

TEST_F(Redraw, EyeByEyeGivesTheBytesOfRedrawingEverything) {
  for (const unsigned seed : {11U, 17U, 23U}) {
    expect_same(of_many_tiles(4, render::PassMode::TwoPasses), seed);
    if (HasFatalFailure()) return;
  }
}

TEST_F(Redraw, WithOneSampleGivesTheBytesOfRedrawingEverything) {
  expect_same(of_many_tiles(1, render::PassMode::Multiview), 21);
}

// The background of one light is cleared, not drawn.
TEST_F(Redraw, WithOneLightGivesTheBytesOfRedrawingEverything) {
  render::RendererOptions options = of_many_tiles(4, render::PassMode::Automatic);
  options.lighting = render::Lighting::KeyAlone;
  expect_same(options, 31);
}

// Includes a picture that was composed before more frames than are remembered.
TEST_F(Redraw, OfAComposedPictureIsRightHoweverOldItIs) {
  auto changes = make_renderer(test_.scene, of_many_tiles());
  render::FrameState frame = full_frame(test_);
  for (const int frames : {1, 7, 8, 9, 30}) {
    for (int i = 0; i < frames; ++i) {
      frame.room_from_node[test_.gold][3].x = 0.1 * ((i + frames) % 5);
      frame.labels.front().highlighted = i == 0;
      changes.render(frame);
    }
    auto everything = make_renderer(test_.scene, of_many_tiles());
    everything.render(frame);
    const render::Composition rows{.mode = scene::StereoMode::Row};
    EXPECT_EQ(where_differ(changes.read_composed(rows), everything.read_composed(rows)), "") << frames;
  }
}

// An equal object draws nothing; a moved one, its part; another head, everything.
TEST_F(Redraw, DrawsAsMuchAsHasChanged) {
  auto renderer = make_renderer(test_.scene, of_many_tiles());
  const auto share = [&](const render::FrameState& frame) {
    renderer.render(frame);
    return renderer.redrawn_share();
  };
  render::FrameState frame = full_frame(test_);
  EXPECT_EQ(share(frame), 1.0);
  EXPECT_EQ(share(full_frame(test_)), 0.0);
  frame.labels.front().highlighted = true;
  EXPECT_GT(share(frame), 0.0);
  EXPECT_EQ(share(frame), 0.0);
  frame.labels.front().highlighted = false;
  EXPECT_LT(share(frame), 0.15);
  frame.room_from_node[test_.gold][3].x += 0.01;
  EXPECT_LT(share(frame), 0.4);
  frame.eyes = {eye_view(scene::Eye::Left, {0.1, 0.0, 2.5}), eye_view(scene::Eye::Right, {0.1, 0.0, 2.5})};
  EXPECT_EQ(share(frame), 1.0);
  EXPECT_EQ(share(frame), 0.0);
}

}  // namespace redraw_test
}  // namespace afm::test
