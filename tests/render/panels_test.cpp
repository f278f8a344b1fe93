// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace panels_test {

class PanelsInTheRoom : public VulkanTest {
 protected:
  PanelsInTheRoom() {
    scene::PbrMaterial material;
    add_material(empty_, material);
  }

  // Large enough for text.
  static render::RendererOptions readable() {
    auto options = small();
    options.eye_width = 512;
    options.eye_height = 384;
    options.panel_texels_per_m = 336.0;
    return options;
  }

  static render::PanelPlacement half_wall() {
    return {.lower_left_m = {-0.9, -0.7, 0.0}, .right_m = {1.8, 0, 0}, .up_m = {0, 1.4, 0}};
  }

  render::FrameState frame_with(const render::ForcePanel& panel) {
    auto frame = bare_frame(empty_);
    frame.panels.force.content = panel;
    frame.panels.force.placement = half_wall();
    return frame;
  }

  static render::ForcePanel line_panel(const glm::vec3& color) {
    render::PlotCurve curve;
    curve.color = color;
    curve.retract = {{-5.0, 0.5}, {20.0, -1.5}};
    return {.title = "", .curves = {curve}, .markers = {}, .cursor = {}, .stage = "", .live = "", .figures = {}};
  }

  scene::Scene empty_;
};

bool is_light(const Pixel& p) { return p.r > 150 && p.g > 150 && p.b > 150; }
bool is_green(const Pixel& p) { return p.g > p.r + 60 && p.g > p.b + 60; }

TEST_F(PanelsInTheRoom, TextIsThere) {
  auto frame = bare_frame(empty_);
  frame.panels.data.content = {.title = "Mica", .subtitle = "", .rows = {{"tip radius R", "50 nm", ""}}};
  frame.panels.data.placement = half_wall();
  const auto with_text = draw(empty_, frame, readable());
  frame.panels.data.content = {};
  const auto without = draw(empty_, frame, readable());
  EXPECT_EQ(count(without.left, is_light), 0U);
  EXPECT_GT(count(with_text.left, is_light), 60U);
  EXPECT_LT(count(with_text.left, is_light), 2000U);
}

TEST_F(PanelsInTheRoom, GreekMinusSignsAndSubscriptsHaveGlyphs) {
  // a missing glyph is drawn as the font's replacement, alike for all
  const auto picture = [&](const std::string& text) {
    auto frame = bare_frame(empty_);
    frame.panels.data.content.title = text;
    frame.panels.data.placement = half_wall();
    return draw(empty_, frame, readable()).left.rgba;
  };
  const auto missing = picture("\u4e2d");
  for (const char* text : {"\u03b3", "\u03b4", "\u00b5", "\u00d7", "\u2212", "\u00b7", "\u2082", "\u00b2", "\u2192",
                           "\u221a", "\u2026", "\u226b"}) {
    EXPECT_NE(picture(text), missing) << text;
  }
}

// The banner shows whether a force reaches the hand.
TEST_F(PanelsInTheRoom, NothingCoversTheBanner) {
  scene::Scene scene;
  scene::PbrMaterial material;
  material.base_color = {0.0F, 0.9F, 0.0F, 1.0F};
  add(scene, "before the wall", quad(add_material(scene, material)),
      glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 0.4)));
  const auto greens = [&](const render::PanelPlacement& banner, const render::PanelPlacement& data) {
    auto frame = bare_frame(scene);
    frame.panels.banner.placement = banner;
    frame.panels.data.placement = data;
    return count(draw(scene, frame, readable()).left, is_green);
  };
  const std::size_t seen = greens(render::kNoPlacement, render::kNoPlacement);
  ASSERT_GT(seen, 1000U);
  EXPECT_EQ(greens(render::kNoPlacement, half_wall()), seen) << "what stands before another panel hides it";
  EXPECT_EQ(greens(half_wall(), render::kNoPlacement), 0U);
}

TEST_F(PanelsInTheRoom, BothEyesReadThePanelAtTheSamePlace) {
  const auto frame = frame_with(line_panel({0.0F, 0.9F, 0.0F}));
  const auto eyes = draw(empty_, frame, readable());
  const auto found = difference(eyes.left, eyes.right, 5);
  EXPECT_LE(found.share_beyond, 0.001);
}

TEST_F(PanelsInTheRoom, ACurveLiesWhereItsNumbersAre) {
  // approach up to the middle of the axis, twice: the green line's middle is the middle of its ends
  const auto low = draw(empty_, frame_with(line_panel({0.0F, 0.9F, 0.0F})), readable());
  auto panel = line_panel({0.0F, 0.9F, 0.0F});
  panel.curves[0].retract = {{-5.0, 0.9}, {20.0, -1.1}};
  const auto high = draw(empty_, frame_with(panel), readable());
  const auto weight = [](const Pixel& p) { return is_green(p) ? 1.0 : 0.0; };
  const auto a = centroid(low.left, weight).value();
  const auto b = centroid(high.left, weight).value();
  EXPECT_NEAR(a.x, b.x, 3.0);
  EXPECT_GT(a.y, b.y + 10.0);
}

// 9000 texels, more than a texture can have: the panel was once cut at 4096, with the state of the force.
TEST_F(PanelsInTheRoom, OneThatIsLargerThanATextureIsShownWhole) {
  auto frame = bare_frame(empty_);
  frame.panels.banner.content.state_word = "FORCE ON";
  frame.panels.banner.content.state_color = {0.0F, 1.0F, 0.0F};
  frame.panels.banner.placement = {.lower_left_m = {-0.9, 0.0, 0.0}, .right_m = {1.8, 0, 0}, .up_m = {0, 0.15, 0}};
  const auto place_of_state = [&](double texels_per_m) {
    auto options = readable();
    options.panel_texels_per_m = texels_per_m;
    return centroid(draw(empty_, frame, options).left, [](const Pixel& p) { return is_green(p) ? 1.0 : 0.0; });
  };
  const auto expected = place_of_state(600.0), found = place_of_state(5000.0);
  ASSERT_TRUE(expected);
  EXPECT_GT(expected->x, 360.0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x, expected->x, 6.0);
  EXPECT_NEAR(found->y, expected->y, 6.0);
}

TEST_F(PanelsInTheRoom, NumbersThatAreNotFiniteAreLeftOut) {
  auto panel = line_panel({0.0F, 0.9F, 0.0F});
  const auto plain = draw(empty_, frame_with(panel), readable());
  panel.curves[0].retract.insert(panel.curves[0].retract.begin() + 1, {std::nan(""), 0.0});
  panel.cursor = render::PlotPoint{1.0, std::nan("")};
  EXPECT_EQ(draw(empty_, frame_with(panel), readable()).left.rgba, plain.left.rgba);
}

TEST_F(PanelsInTheRoom, ChangedContentIsPaintedAgain) {
  auto frame = frame_with(line_panel({0.0F, 0.9F, 0.0F}));
  auto renderer = make_renderer(empty_, readable());
  renderer.render(frame);
  const auto before = renderer.read_eye(scene::Eye::Left);
  frame.panels.force.content.cursor = render::PlotPoint{10.0, -1.0};
  renderer.render(frame);
  const auto after = renderer.read_eye(scene::Eye::Left);
  EXPECT_GT(difference(before, after, 20).share_beyond, 5e-5);
  EXPECT_EQ(after.rgba, draw(empty_, frame, readable()).left.rgba);
}

// The glyphs are drawn with the first panel that is shown.
TEST_F(PanelsInTheRoom, OneThatComesLaterIsTheSame) {
  auto frame = bare_frame(empty_);
  auto renderer = make_renderer(empty_, readable());
  renderer.render(frame);
  EXPECT_EQ(count(renderer.read_eye(scene::Eye::Left), is_light), 0U);
  frame.panels.data.content = {.title = "Mica", .subtitle = "", .rows = {{"tip radius R", "50 nm", ""}}};
  frame.panels.data.placement = half_wall();
  renderer.render(frame);
  EXPECT_EQ(renderer.read_eye(scene::Eye::Left).rgba, draw(empty_, frame, readable()).left.rgba);
}

TEST_F(PanelsInTheRoom, WithoutAreaNothingIsShown) {
  auto frame = frame_with(line_panel({0.0F, 0.9F, 0.0F}));
  frame.panels.force.placement = nowhere();
  EXPECT_EQ(draw(empty_, frame, readable()).left.rgba, draw(empty_, bare_frame(empty_), readable()).left.rgba);
}

TEST_F(PanelsInTheRoom, NearerThingsHideIt) {
  scene::Scene scene;
  const auto white = add_material(scene, {.name = "white", .unlit = true});
  glm::dmat4 before(1.0);
  before[3] = glm::dvec4(0.0, 0.0, 0.3, 1.0);
  add(scene, "in front", quad(white), before);
  auto frame = bare_frame(scene);
  frame.panels.force.content = line_panel({0.0F, 0.9F, 0.0F});
  frame.panels.force.placement = half_wall();
  const auto eyes = draw(scene, frame, readable());
  EXPECT_GT(pixel(eyes.left, 256, 192).r, 200);
  EXPECT_LT(pixel(eyes.left, 120, 300).r, 120);
}

TEST_F(PanelsInTheRoom, TwentyThousandPointsLookLikeTheLineTheyAre) {
  auto panel = line_panel({0.0F, 0.9F, 0.0F});
  const auto plain = draw(empty_, frame_with(panel), readable());
  auto& points = panel.curves[0].retract;
  points.clear();
  for (int i = 0; i <= 20000; ++i) {
    const double share = i / 20000.0;
    points.push_back({-5.0 + 25.0 * share, 0.5 - 2.0 * share});
  }
  const auto dense = draw(empty_, frame_with(panel), readable());
  EXPECT_LE(difference(plain.left, dense.left, 24).share_beyond, 0.002);
}

}  // namespace panels_test
}  // namespace afm::test
