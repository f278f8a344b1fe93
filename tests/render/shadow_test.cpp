// SPDX-License-Identifier: Apache-2.0
// Invariant: the shadow map is redrawn only where a caster changed
// Invariant: no shadow ends where the map does
// Invariant: a shadow's edge is wider, the farther away its caster is
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/pictures.h"
#include "support/vulkan_fixture.h"

// The shadow map stays unchanged until something changes on which it depends.
namespace afm::test {
namespace shadow_test {

class ShadowTest : public VulkanTest {
 protected:
  // Frames in which one of the map's inputs is changed.
  std::vector<std::pair<std::string, render::FrameState>> changed_frames() {
    std::vector<std::pair<std::string, render::FrameState>> frames;
    const auto with = [&](const char* what, const std::function<void(render::FrameState&)>& change) {
      change(frames.emplace_back(what, full_frame(test_)).second);
    };
    with("a place", [&](auto& f) {
      f.room_from_node[test_.gold] = glm::translate(f.room_from_node[test_.gold], glm::dvec3(0.2, 0.1, 0.0));
    });
    with("a bend", [&](auto& f) { f.bends.front().end_deflection *= -2.0F; });
    with("a hidden caster", [&](auto& f) {
      f.visible.assign(f.room_from_node.size(), 1);
      f.visible[test_.mica] = 0;
    });
    with("a mirrored caster", [&](auto& f) {
      f.room_from_node[test_.lever] = glm::scale(f.room_from_node[test_.lever], glm::dvec3(1.0, -1.0, 1.0));
    });
    with("the light", [&](auto& f) { f.key_light.direction_to_light = {0.6F, 0.7F, 0.2F}; });
    with("what the light covers", [&](auto& f) { f.key_light.shadow_radius_m *= 0.5F; });
    return frames;
  }

  double edge_m(double height_m);

  TestScene test_ = make_test_scene();
};

TEST_F(ShadowTest, FollowsEverythingThatItDependsOn) {
  auto renderer = make_renderer(test_.scene, small(1));
  for (const auto& [what, frame] : changed_frames()) {
    for (int i = 0; i < 3; ++i) renderer.render(full_frame(test_));
    renderer.render(frame);
    const render::Image drawn = renderer.read_eye(scene::Eye::Left);
    EXPECT_EQ(drawn.rgba, draw(test_.scene, frame, small(1)).left.rgba) << what;
  }
}

// Moving casters are drawn over static ones: they leave no trace, even off the map, and another may move next.
TEST_F(ShadowTest, IsRestoredWhereSomethingHasMovedAway) {
  auto renderer = make_renderer(test_.scene, small(1));
  render::FrameState frame = full_frame(test_);
  renderer.render(frame);
  const auto expect_right = [&](const std::string& what) {
    renderer.render(frame);
    EXPECT_EQ(renderer.read_eye(scene::Eye::Left).rgba, draw(test_.scene, frame, small(1)).left.rgba) << what;
  };
  const auto move = [&](scene::NodeIndex node, const glm::dvec3& by, const std::string& what) {
    frame.room_from_node[node] = glm::translate(glm::dmat4(1.0), by) * frame.room_from_node[node];
    expect_right(what);
  };
  const auto bend = [&](float by, const std::string& what) {
    frame.bends.front().end_deflection += by;
    expect_right(what);
  };
  for (const double x : {0.15, 0.15, 3.0, -3.3}) move(test_.gold, {x, 0.05, 0.0}, "one at " + std::to_string(x));
  for (const double y : {0.1, -0.2}) move(test_.lever, {0.0, y, 0.0}, "another one beside it at " + std::to_string(y));
  for (const float by : {0.1F, -0.2F}) bend(by, "bent by " + std::to_string(by));

  // the first one rests for so long that it is one of those that do
  for (int i = 0; i < 130; ++i) {
    frame.bends.front().end_deflection += i % 2 == 0 ? 0.03F : -0.03F;
    renderer.render(frame);
  }
  bend(0.05F, "beside one that has come to rest");
  move(test_.gold, {0.1, 0.0, 0.0}, "one that has rested");
  for (int i = 0; i < 3; ++i) {
    for (const scene::NodeIndex node : {test_.gold, test_.mica, test_.lever})
      move(node, {0.0, 0.02, 0.0}, "nearly all");
  }
}

TEST_F(ShadowTest, IsNotDrawnAgainWhileNothingOfItMoves) {
  render::RendererOptions options = small(1);
  options.time_passes = true;
  auto renderer = make_renderer(test_.scene, options);
  const auto shadow_ms = [&](const render::FrameState& frame) {
    renderer.render(frame);
    renderer.wait();
    return renderer.pass_times().value().shadow_ms;
  };
  EXPECT_GT(shadow_ms(full_frame(test_)), 0.0);
  render::FrameState frame = full_frame(test_);
  EXPECT_EQ(shadow_ms(frame), 0.0);
  frame.eyes = {eye_view(scene::Eye::Left, {0.3, 0.1, 2.0}), eye_view(scene::Eye::Right, {0.3, 0.1, 2.0})};
  EXPECT_EQ(shadow_ms(frame), 0.0);
  for (const auto& [what, changed] : changed_frames()) EXPECT_GT(shadow_ms(changed), 0.0) << what;
}

// A flat floor and a ball under light that grazes them, on a map whose texels are 4 cm wide: nothing shadows itself.
// What lies outside the map is lit, so that the same picture without a shadow is to be had.
TEST_F(ShadowTest, LeavesNoSpecksOnWhatShadowsItself) {
  scene::Scene scene;
  const std::uint32_t chalk = add_material(scene, {.name = "chalk", .metallic = 0.0F});
  add(scene, "floor", quad(chalk),
      glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -0.6, 0.0)) *
          glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0)) *
          glm::scale(glm::dmat4(1.0), glm::dvec3(30.0, 30.0, 1.0)));
  render::FrameState frame = bare_frame(scene);
  for (const double elevation_deg : {3.0, 10.0, 30.0, 80.0}) {
    const double angle = glm::radians(elevation_deg);
    frame.key_light.direction_to_light = glm::dvec3(0.6 * std::cos(angle), std::sin(angle), 0.8 * std::cos(angle));
    frame.key_light.shadow_radius_m = 40.0F;
    frame.key_light.shadow_center_m = glm::vec3(0.0F);
    const render::Image shadowed = draw(scene, frame, small(1)).left;
    frame.key_light.shadow_center_m = glm::vec3(160.0F, 0.0F, -120.0F);  // place beside it, as seen from the light
    const render::Image lit = draw(scene, frame, small(1)).left;
    EXPECT_EQ(difference(shadowed, lit, 2).share_beyond, 0.0) << elevation_deg;
  }
}

// A floor below a ball: objects without a map shadow look as if there were no caster.
TEST_F(ShadowTest, FallsNeitherOnWhatTakesNoneNorInAFrameWithoutOne) {
  scene::Scene scene;
  const std::uint32_t chalk = add_material(scene, {.name = "chalk", .metallic = 0.0F});
  const auto wide = [](double y, double size) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, y, -0.5)) *
           glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0)) *
           glm::scale(glm::dmat4(1.0), glm::dvec3(size, size, 1.0));
  };
  const scene::NodeIndex floor = add(scene, "floor", quad(chalk), wide(-0.6, 3.0));
  const scene::NodeIndex lid = add(scene, "lid", quad(chalk), wide(0.9, 1.0));
  render::FrameState frame = bare_frame(scene);
  frame.key_light.direction_to_light = {0.1F, 1.0F, 0.1F};
  const render::Image shadowed = draw(scene, frame, small(1)).left;
  frame.visible.assign(scene.nodes.size(), 1);
  frame.visible[lid] = 0;
  const render::Image lit = draw(scene, frame, small(1)).left;
  EXPECT_GT(difference(shadowed, lit, 8).share_beyond, 0.01);
  frame.visible[lid] = 1;
  frame.unshadowed = {floor};
  EXPECT_EQ(draw(scene, frame, small(1)).left.rgba, lit.rgba);
  frame.unshadowed.clear();
  frame.key_light.map_share = 0.0F;
  EXPECT_EQ(draw(scene, frame, small(1)).left.rgba, lit.rgba);

  // nor in a frame with only one light
  frame.key_light.map_share = 1.0F;
  render::RendererOptions one_light = small(1);
  one_light.lighting = render::Lighting::KeyAlone;
  const render::Image alone = draw(scene, frame, one_light).left;
  EXPECT_GT(difference(alone, lit, 8).share_beyond, 0.01);  // part lit by the studio
  constexpr std::array<std::uint8_t, 4> kPlain{64, 69, 79, 255};
  EXPECT_TRUE(std::equal(kPlain.begin(), kPlain.end(), alone.rgba.begin()));  // background in the corner
  frame.visible[lid] = 0;
  EXPECT_EQ(draw(scene, frame, one_light).left.rgba, alone.rgba);
}

// Width of the edge of the shadow that a lid casts on a floor `height_m` below, in a picture of the left eye.
double ShadowTest::edge_m(double height_m) {
  scene::Scene scene;
  const std::uint32_t chalk = add_material(scene, {.name = "chalk", .metallic = 0.0F});
  const auto flat = [](const glm::dvec3& middle, const glm::dvec3& size) {
    return glm::translate(glm::dmat4(1.0), middle) *
           glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0)) *
           glm::scale(glm::dmat4(1.0), size);
  };
  const glm::dvec3 middle(0.0, -0.6, -0.5);
  add(scene, "floor", quad(chalk), flat(middle, {4.0, 3.0, 1.0}));
  const scene::NodeIndex lid =
      add(scene, "lid", quad(chalk), flat(middle + glm::dvec3(0.5, height_m, 0.0), {1.0, 0.3, 1.0}));
  render::FrameState frame = bare_frame(scene);
  frame.key_light.direction_to_light = {0.0F, 1.0F, 0.05F};
  frame.key_light.shadow_center_m = glm::vec3(middle);
  frame.key_light.shadow_radius_m = 5.0F;
  const render::Image shaded = draw(scene, frame, small(1)).left;
  frame.visible.assign(scene.nodes.size(), 1);
  frame.visible[lid] = 0;
  const render::Image lit = draw(scene, frame, small(1)).left;
  const auto darker = [&](double x) {
    const glm::dvec4 clip =
        frame.eyes[0].projection * frame.eyes[0].view * glm::dvec4(middle + glm::dvec3(x, 0.0, 0.0), 1.0);
    const auto column = static_cast<std::size_t>((0.5 + 0.5 * clip.x / clip.w) * lit.width);
    const auto row = static_cast<std::size_t>((0.5 + 0.5 * clip.y / clip.w) * lit.height);
    const std::size_t at = 4 * (row * lit.width + column);
    return static_cast<double>(lit.rgba.at(at)) - static_cast<double>(shaded.rgba.at(at));
  };
  const double whole = darker(0.25);
  EXPECT_GT(whole, 20.0) << height_m;
  EXPECT_LT(darker(-0.25), 3.0) << height_m;
  double width_m = 0.0;
  for (int i = -250; i <= 250; ++i) {
    const double share = darker(0.001 * i) / whole;
    if (share > 0.1 && share < 0.9) width_m += 0.001;
  }
  return width_m;
}

TEST_F(ShadowTest, HasAWiderEdgeTheFartherItsCasterIs) {
  const double near_m = edge_m(0.05), middle_m = edge_m(0.25), far_m = edge_m(0.5);
  EXPECT_GT(near_m, 0.01);
  EXPECT_GT(middle_m, 1.15 * near_m);
  EXPECT_GT(far_m, 1.15 * middle_m);
}

// The shade of a cone on its tip is a wedge that begins there and grows softer with the distance.
TEST_F(ShadowTest, OfAConeIsASoftWedgeAwayFromTheLight) {
  scene::Scene scene;
  const std::uint32_t chalk = add_material(scene, {.name = "chalk", .metallic = 0.0F});
  const glm::dvec3 contact(0.0, -0.5, -0.5);
  add(scene, "floor", quad(chalk),
      glm::translate(glm::dmat4(1.0), contact) *
          glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0)) *
          glm::scale(glm::dmat4(1.0), glm::dvec3(4.0, 4.0, 1.0)));
  render::FrameState frame = bare_frame(scene);
  frame.key_light.direction_to_light = {-0.8F, 0.6F, 0.0F};
  frame.fog.begin_m = 50.0F;
  frame.fog.end_m = 60.0F;
  const render::Image lit = draw(scene, frame, small(1)).left;
  frame.cone = {.apex_m = glm::vec3(contact), .radius_m = 0.001F, .slope = 0.36F, .height_m = 30.0F, .share = 1.0F};
  const render::Image shaded = draw(scene, frame, small(1)).left;
  // share of the light at a place of the floor, from the picture
  const auto darker = [&](double x, double z) {
    const glm::dvec4 clip =
        frame.eyes[0].projection * frame.eyes[0].view * glm::dvec4(contact + glm::dvec3(x, 0.0, z), 1.0);
    const auto column = static_cast<std::size_t>((0.5 + 0.5 * clip.x / clip.w) * lit.width);
    const auto row = static_cast<std::size_t>((0.5 + 0.5 * clip.y / clip.w) * lit.height);
    const std::size_t at = 4 * (row * lit.width + column);
    return static_cast<int>(lit.rgba.at(at)) - static_cast<int>(shaded.rgba.at(at));
  };
  for (const double away : {0.5, 0.7, 0.9}) {
    EXPECT_GT(darker(away, 0.0), 20) << away;
    EXPECT_LT(darker(-away, 0.0), 3) << away;
    EXPECT_GT(darker(away, 0.0), darker(away, 0.7 * away)) << away;
  }
  frame.cone.share = 0.0F;
  EXPECT_EQ(draw(scene, frame, small(1)).left.rgba, lit.rgba);
}

}  // namespace shadow_test
}  // namespace afm::test
