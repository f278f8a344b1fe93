// SPDX-License-Identifier: Apache-2.0
#include "scene/graph/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace afm::scene {
namespace pose_test {

constexpr float kTolerance = 1e-6F;

Track track(Interpolation interpolation, std::size_t width, std::vector<float> times, std::vector<float> values) {
  return {interpolation, width, std::move(times), std::move(values)};
}

float at(const Track& track, float time_s) {
  std::vector<float> value;
  sample(track, time_s, value);
  return value.at(0);
}

TEST(Track, HoldsItsValueOutsideItsKeys) {
  for (const Interpolation interpolation : {Interpolation::Step, Interpolation::Linear}) {
    const Track ramp = track(interpolation, 1, {1, 2}, {10, 20});
    EXPECT_EQ(at(ramp, 0), 10);
    EXPECT_EQ(at(ramp, 1), 10);
    EXPECT_EQ(at(ramp, 2), 20);
    EXPECT_EQ(at(ramp, 9), 20);
  }
}

TEST(Track, StepsRisesAndCurves) {
  EXPECT_EQ(at(track(Interpolation::Step, 1, {0, 1}, {10, 20}), 0.9F), 10);
  EXPECT_NEAR(at(track(Interpolation::Linear, 1, {0, 1}, {10, 20}), 0.25F), 12.5F, kTolerance);

  // in-tangent, value, out-tangent; flat tangents ease in and out, unit ones over two seconds make the straight line
  EXPECT_NEAR(at(track(Interpolation::CubicSpline, 1, {0, 1}, {0, 10, 0, 0, 20, 0}), 0.25F), 11.5625F, kTolerance);
  EXPECT_NEAR(at(track(Interpolation::CubicSpline, 1, {0, 2}, {0, 0, 1, 1, 2, 0}), 0.5F), 0.5F, kTolerance);
}

TEST(Track, TurnsTheShorterWay) {
  const float s = std::sqrt(0.5F);
  const Track turn =
      track(Interpolation::Linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, -s, -s});  // 90 degrees about z, negated
  const glm::dvec3 x = sample_rotation(turn, 0.5F) * glm::dvec3(1, 0, 0);
  EXPECT_NEAR(x.x, std::cos(0.7853981634), 1e-6);
  EXPECT_NEAR(x.y, std::sin(0.7853981634), 1e-6);
}

// A triangle in the plane z = 0, shown by the second node.
Scene triangle() {
  Scene scene;
  Primitive primitive;
  primitive.vertices = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}};
  primitive.indices = {0, 1, 2};
  scene.meshes.push_back({"triangle", {primitive}});
  scene.materials.resize(2);
  scene.nodes.push_back({"root", std::nullopt, std::nullopt, glm::dmat4(1.0)});
  scene.nodes.push_back({"leaf", 0U, 0U, glm::dmat4(1.0)});
  return scene;
}

const Vertex& first_vertex(const Scene& scene) {
  for (const Node& node : scene.nodes) {
    if (node.mesh) return scene.meshes[*node.mesh].primitives.at(0).vertices.at(0);
  }
  throw std::logic_error("no mesh is shown");
}

TEST(Posed, IsTheSameWhereNothingMoves) { EXPECT_EQ(digest(posed(triangle(), 3.0F)), digest(triangle())); }

TEST(Posed, MovesANodeByItsAnimationAndKeepsWhatThatDoesNotMove) {
  Scene scene = triangle();
  AnimatedNode moved;
  moved.node = 1;
  moved.scale = {2, 2, 2};
  moved.translations = track(Interpolation::Linear, 3, {0, 1}, {0, 0, 0, 4, 0, 0});
  scene.animations.push_back({"slide", {moved}, 1.0F});
  AnimatedNode later = moved;
  later.translations = track(Interpolation::Linear, 3, {0}, {0, 9, 0});
  scene.animations.push_back({"second", {later}, 1.0F});

  const glm::dmat4 matrix = posed(scene, 0.5F).nodes[1].parent_from_node;
  EXPECT_EQ(glm::dvec3(matrix[3]), glm::dvec3(2, 0, 0)) << "the first animation counts";
  EXPECT_EQ(matrix[0][0], 2.0);
  EXPECT_EQ(posed(scene, std::nullopt).nodes[1].parent_from_node, glm::dmat4(1.0)) << "at rest";
}

TEST(Posed, AddsMorphTargetsByTheirWeights) {
  Scene scene = triangle();
  scene.meshes[0].primitives[0].targets.push_back({{{0, 0, 2}, {0, 0, 2}, {0, 0, 2}}, {}, {}});
  scene.meshes[0].weights = {0.5F};
  EXPECT_EQ(first_vertex(posed(scene, std::nullopt)).position, glm::vec3(0, 0, 1));
  scene.nodes[1].weights = {0.25F};
  EXPECT_EQ(first_vertex(posed(scene, std::nullopt)).position, glm::vec3(0, 0, 0.5F)) << "the node's own weights";
  scene.nodes[1].weights = {0.0F};
  EXPECT_EQ(first_vertex(posed(scene, std::nullopt)).position, glm::vec3(0, 0, 0));
}

TEST(Posed, PutsASkinWhereItsJointsAreWhereverTheNodeIs) {
  Scene scene = triangle();
  scene.nodes[1].parent_from_node[3] = glm::dvec4(100, 0, 0, 1);  // no effect on a skin
  scene.nodes.push_back({"joint", 0U, std::nullopt, glm::dmat4(1.0)});
  scene.nodes[2].parent_from_node[3] = glm::dvec4(0, 0, 5, 1);
  scene.nodes[1].skin = 0;
  glm::mat4 inverse_bind(1.0F);
  inverse_bind[3] = glm::vec4(0, 0, -2, 1);
  scene.skins.push_back({"skin", {2, 0}, {inverse_bind, glm::mat4(1.0F)}});
  auto& primitive = scene.meshes[0].primitives[0];
  primitive.influences.assign(3, {{0, 1, 0, 0}, {1.0F, 1.0F, 0.0F, 0.0F}});  // not normalised: half and half

  const Scene skinned = posed(scene, std::nullopt);
  EXPECT_EQ(first_vertex(skinned).position, glm::vec3(0, 0, 1.5F));
  ASSERT_EQ(skinned.nodes.size(), 4U);
  EXPECT_FALSE(skinned.nodes[3].parent);
  EXPECT_FALSE(skinned.nodes[1].mesh);
  EXPECT_EQ(skinned.nodes[3].parent_from_node, glm::dmat4(1.0));
}

TEST(Posed, TurnsFlatNormalsWithTheirTriangles) {
  Scene scene = triangle();
  auto& primitive = scene.meshes[0].primitives[0];
  primitive.normals = Normals::Flat;
  primitive.targets.push_back({{{0, 0, 0}, {0, 0, 0}, {0, -1, 1}}, {}, {}});  // target that turns the triangle upright
  scene.meshes[0].weights = {1.0F};
  EXPECT_NEAR(glm::distance(first_vertex(posed(scene, std::nullopt)).normal, glm::vec3(0, -1, 0)), 0.0F, kTolerance);
}

TEST(Variants, ChangeTheMaterialsThatTheyName) {
  Scene scene = triangle();
  scene.variants = {"mica", "gold"};
  scene.meshes[0].primitives[0].variants = {{1, 1}};
  EXPECT_FALSE(choose_variant(scene, "silver"));
  EXPECT_TRUE(choose_variant(scene, "mica"));
  EXPECT_EQ(scene.meshes[0].primitives[0].material, 0U) << "a primitive without a mapping keeps its own";
  EXPECT_TRUE(choose_variant(scene, "gold"));
  EXPECT_EQ(scene.meshes[0].primitives[0].material, 1U);
}

TEST(Roles, AreFoundByExtrasBeforeNames) {
  Scene scene = triangle();
  EXPECT_FALSE(find_role(scene, "tip"));
  scene.nodes[0].name = "tip";
  EXPECT_EQ(find_role(scene, "tip"), 0U);
  scene.nodes[1].role = "tip";
  EXPECT_EQ(find_role(scene, "tip"), 1U);
}

}  // namespace pose_test
}  // namespace afm::scene
