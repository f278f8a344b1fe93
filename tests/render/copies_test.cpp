// SPDX-License-Identifier: Apache-2.0
// Invariant: two thousand copies of a mesh are one draw, and one that moves is redrawn as if all were
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <string>
#include <vector>

#include "support/deep.h"
#include "support/pictures.h"
#include "support/vulkan_fixture.h"

// Copies of one mesh, as many particles: drawn in one call, moved one by one.
namespace afm::test {
namespace copies_test {

constexpr int kRings = 6;

struct Crowd {
  scene::Scene scene;
  scene::NodeIndex copied = 0;
  std::uint32_t material = 0;
  render::FrameState frame;
};

// A floor with many spheres on it, some of them shadowed by others.
Crowd crowd(std::size_t count, unsigned seed) {
  Crowd crowd;
  crowd.material = add_material(crowd.scene, {.name = "chalk", .metallic = 0.0F});
  const glm::dmat4 floor = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -0.5, -0.4)) *
                           glm::rotate(glm::dmat4(1.0), glm::radians(-70.0), glm::dvec3(1.0, 0.0, 0.0));
  add(crowd.scene, "floor", quad(crowd.material), glm::scale(floor, glm::dvec3(2.6, 1.6, 1.0)));
  crowd.copied = add(crowd.scene, "spheres", sphere(crowd.material, kRings), floor);
  crowd.scene.nodes[crowd.copied].most_copies = static_cast<std::uint32_t>(count);
  crowd.frame = bare_frame(crowd.scene);
  std::mt19937 random(seed);
  const auto real = [&](float low, float high) { return std::uniform_real_distribution(low, high)(random); };
  render::MeshCopies copies{.node = crowd.copied, .copies = {}};
  for (std::size_t i = 0; i < count; ++i) {
    const float radius = real(0.01F, 0.02F);
    copies.copies.push_back({.place = {real(-1.2F, 1.2F), real(-0.7F, 0.7F), radius},
                             .scale = 2.0F * radius,
                             .tint = {real(0.2F, 1.0F), real(0.2F, 1.0F), real(0.2F, 1.0F), 1.0F}});
  }
  crowd.frame.copies = {std::move(copies)};
  return crowd;
}

render::RendererOptions sized(render::Redraw redraw, render::PassMode pass_mode = render::PassMode::Multiview) {
  render::RendererOptions options = small(4, pass_mode);
  options.eye_width = 512;
  options.eye_height = 384;
  options.redraw = redraw;
  return options;
}

using Copies = VulkanTest;

TEST_F(Copies, LookLikeNodesOfTheirOwn) {
  Crowd crowd = copies_test::crowd(12, 3);
  std::vector<render::MeshCopy>& copies = crowd.frame.copies.front().copies;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const glm::quat turn = glm::angleAxis(0.4F * static_cast<float>(i), glm::normalize(glm::vec3(1.0F, 2.0F, 3.0F)));
    copies[i].turn = {turn.x, turn.y, turn.z, turn.w};
    copies[i].scale *= 4.0F;
    copies[i].place.z *= 4.0F;
  }
  scene::Scene apart;
  add_material(apart, {.name = "chalk", .metallic = 0.0F});
  add(apart, "floor", quad(0), crowd.frame.room_from_node[0]);
  for (const render::MeshCopy& copy : copies) {
    const std::uint32_t material =
        add_material(apart, {.name = "chalk", .base_color = glm::vec4(glm::vec3(copy.tint), 1.0F), .metallic = 0.0F});
    const glm::dvec4 q(copy.turn);
    const glm::dquat turn(q.w, q.x, q.y, q.z);
    add(apart, "sphere", sphere(material, kRings),
        crowd.frame.room_from_node[crowd.copied] * glm::translate(glm::dmat4(1.0), glm::dvec3(copy.place)) *
            glm::mat4_cast(turn) * glm::scale(glm::dmat4(1.0), glm::dvec3(static_cast<double>(copy.scale))));
  }
  for (const render::PassMode mode : {render::PassMode::Multiview, render::PassMode::TwoPasses}) {
    const auto options = sized(render::Redraw::Changes, mode);
    const Pair as_copies = draw(crowd.scene, crowd.frame, options);
    const Pair as_nodes = draw(apart, bare_frame(apart), options);
    constexpr int kRounding = 6;  // tolerance, since the light of a node may be computed per vertex
    EXPECT_LT(difference(as_copies.left, as_nodes.left, kRounding).share_beyond, 0.004);
    EXPECT_LT(difference(as_copies.right, as_nodes.right, kRounding).share_beyond, 0.004);
  }
}

TEST_F(Copies, AreNotShownWithoutAnEntryOfTheFrame) {
  Crowd crowd = copies_test::crowd(5, 4);
  const render::Image with = draw(crowd.scene, crowd.frame, small()).left;
  crowd.frame.copies.clear();
  const render::Image without = draw(crowd.scene, crowd.frame, small()).left;
  EXPECT_NE(where_differ(with, without), "");
  crowd.frame.visible.assign(crowd.scene.nodes.size(), 1);
  crowd.frame.visible[crowd.copied] = 0;
  crowd.frame.copies = copies_test::crowd(5, 4).frame.copies;
  EXPECT_EQ(where_differ(draw(crowd.scene, crowd.frame, small()).left, without), "") << "hidden";
}

// Two thousand spheres, of which a few move, roll or change their colour: what is redrawn gives the bytes of drawing
// everything, with their shadows, and is a small part of the picture.
TEST_F(Copies, RedrawnWhereTheyChangeGiveTheBytesOfRedrawingEverything) {
  const std::size_t count = support::deep() ? 2000 : 200;
  constexpr int kFrames = 24;
  Crowd crowd = copies_test::crowd(count, 5);
  auto changes = make_renderer(crowd.scene, sized(render::Redraw::Changes));
  auto everything = make_renderer(crowd.scene, sized(render::Redraw::Everything));
  std::mt19937 random(6);
  const auto whole = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  const auto step = [&] { return std::uniform_real_distribution(-0.03F, 0.03F)(random); };
  std::vector<render::MeshCopy>& copies = crowd.frame.copies.front().copies;
  double redrawn = 0.0;
  for (int i = 0; i < kFrames; ++i) {
    for (int moved = whole(0, 3); moved > 0; --moved) {
      render::MeshCopy& copy = copies[static_cast<std::size_t>(whole(0, static_cast<int>(copies.size()) - 1))];
      const int what = whole(0, 2);
      if (what != 1) copy.place += glm::vec3(step(), step(), 0.0F);
      if (what == 1) copy.tint = {1.0F, 1.0F, 0.2F, 1.0F};
      if (what == 2) {
        const glm::quat turn = glm::angleAxis(step() * 30.0F, glm::vec3(0.0F, 1.0F, 0.0F));
        copy.turn = {turn.x, turn.y, turn.z, turn.w};
      }
    }
    if (i == 10) copies.resize(count / 2);
    if (i == 14) crowd.frame.room_from_node[crowd.copied][3].x += 0.05;
    if (i == 18) crowd.frame.fog.fade = 0.3F;
    changes.render(crowd.frame);
    everything.render(crowd.frame);
    if (i > 0 && i < 10) redrawn += changes.redrawn_share() / 9.0;
    for (const scene::Eye eye : scene::kEyes) {
      ASSERT_EQ(where_differ(changes.read_eye(eye), everything.read_eye(eye)), "") << "frame " << i;
    }
  }
  EXPECT_LT(redrawn, 0.4);
  EXPECT_GT(redrawn, 0.0);
  changes.render(crowd.frame);
  EXPECT_EQ(changes.redrawn_share(), 0.0) << "nothing has changed";
}

// Includes copies that both frames in flight received at different times.
TEST_F(Copies, AreThoseOfTheNewestFrame) {
  Crowd crowd = copies_test::crowd(40, 7);
  auto renderer = make_renderer(crowd.scene, small());
  std::vector<render::MeshCopy>& copies = crowd.frame.copies.front().copies;
  for (std::size_t i = 0; i < 6; ++i) {
    copies[i].place.x += 0.2F;
    renderer.render(crowd.frame);
    EXPECT_EQ(where_differ(renderer.read_eye(scene::Eye::Left), draw(crowd.scene, crowd.frame, small()).left), "") << i;
  }
}

}  // namespace copies_test
}  // namespace afm::test
