// SPDX-License-Identifier: Apache-2.0
#include "scene/graph/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

namespace afm::scene {
namespace scene_test {

// A lever with a tip below it: two nodes, one mesh of one triangle, one material, one texture of two pixels.
Scene probe() {
  Scene scene;
  scene.materials.push_back(PbrMaterial{.name = "nitride"});
  Primitive triangle;
  triangle.vertices.resize(3);
  triangle.vertices[1].position = {1, 0, 0};
  triangle.vertices[2].position = {0, 1, 0};
  triangle.indices = {0, 1, 2};
  triangle.texture_coordinates.resize(3);
  triangle.tangents.resize(3, glm::vec4(1.0F));
  scene.textures.push_back({});
  scene.images.push_back({.name = "grain", .width = 2, .height = 1, .rgba = std::vector<std::uint8_t>(8)});
  scene.meshes.push_back({"lever", {triangle}});
  scene.nodes.push_back({"lever", std::nullopt, 0U, glm::dmat4(1.0)});
  scene.nodes.push_back({"tip", 0U, std::nullopt, glm::translate(glm::dmat4(1.0), glm::dvec3(2, 0, -1))});
  return scene;
}

TEST(FindNode, GivesTheFirstOfThatName) {
  Scene scene = probe();
  scene.nodes.push_back({"tip", std::nullopt, std::nullopt, glm::dmat4(1.0)});
  EXPECT_EQ(scene.find_node("tip"), 1U);
  EXPECT_EQ(scene.find_node("apex"), std::nullopt);
  EXPECT_EQ(scene.find_node(""), std::nullopt);
}

TEST(Append, PutsThePartBelowANewNodeAndPrefixesItsNames) {
  Scene scene = probe();
  const NodeIndex root = append(scene, probe(), "second", 1U, glm::translate(glm::dmat4(1.0), glm::dvec3(0, 5, 0)));
  EXPECT_EQ(root, 2U);
  ASSERT_EQ(scene.nodes.size(), 5U);
  EXPECT_EQ(scene.nodes[root].parent, 1U);
  EXPECT_EQ(scene.nodes[root].mesh, std::nullopt);
  EXPECT_EQ(scene.nodes[root].parent_from_node[3][1], 5.0);
  EXPECT_EQ(scene.find_node("second/lever"), root + 1);
  EXPECT_EQ(scene.nodes[root + 1].parent, root);
  EXPECT_EQ(scene.nodes[root + 2].parent, root + 1);
  EXPECT_EQ(scene.nodes[root + 2].parent_from_node, probe().nodes[1].parent_from_node);
}

TEST(Append, KeepsMeshesAndMaterialsApart) {
  Scene scene = probe();
  const NodeIndex root = append(scene, probe(), "second", std::nullopt, glm::dmat4(1.0));
  ASSERT_EQ(scene.meshes.size(), 2U);
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.nodes[root + 1].mesh, 1U);
  EXPECT_EQ(scene.meshes[0].primitives[0].material, 0U);
  EXPECT_EQ(scene.meshes[1].primitives[0].material, 1U);
}

TEST(Append, KeepsParentsBeforeChildren) {
  Scene scene = probe();
  append(scene, probe(), "a", 1U, glm::dmat4(1.0));
  append(scene, probe(), "b", 0U, glm::dmat4(1.0));
  for (NodeIndex i = 0; i < scene.nodes.size(); ++i) {
    EXPECT_LT(scene.nodes[i].parent.value_or(0), std::max(i, 1U));
  }
}

TEST(Append, RefusesAParentThatDoesNotExist) {
  Scene scene = probe();
  EXPECT_DEATH(append(scene, probe(), "lost", 9U, glm::dmat4(1.0)), "parent");
}

TEST(Digest, IsTheSameForEqualScenes) { EXPECT_EQ(digest(probe()), digest(probe())); }

TEST(Digest, ChangesWithEveryField) {
  const std::vector<std::function<void(Scene&)>> changes{
      [](Scene& s) { s.nodes[0].name = "Lever"; },
      [](Scene& s) { s.nodes[1].parent = std::nullopt; },
      [](Scene& s) { s.nodes[1].mesh = 0U; },
      [](Scene& s) { s.nodes[1].parent_from_node[3][2] = -1.0000001; },
      [](Scene& s) { s.meshes[0].name = "other"; },
      [](Scene& s) { s.meshes[0].primitives[0].vertices[2].position.z = 1e-9F; },
      [](Scene& s) { s.meshes[0].primitives[0].vertices[2].normal.x = 1e-3F; },
      [](Scene& s) { s.meshes[0].primitives[0].vertices[2].color.g = 0.5F; },
      [](Scene& s) { std::swap(s.meshes[0].primitives[0].indices[0], s.meshes[0].primitives[0].indices[1]); },
      [](Scene& s) { s.meshes[0].primitives[0].material = 1; },
      [](Scene& s) { s.meshes[0].primitives[0].topology = Topology::Points; },
      [](Scene& s) { s.meshes[0].primitives[0].normals = Normals::Flat; },
      [](Scene& s) { s.meshes[0].primitives[0].texture_coordinates[1].set_0.x = 0.25F; },
      [](Scene& s) { s.meshes[0].primitives[0].texture_coordinates[1].set_1.y = 0.25F; },
      [](Scene& s) { s.meshes[0].primitives[0].tangents[2].w = -1.0F; },
      [](Scene& s) { s.textures[0].image = 1; },
      [](Scene& s) { s.textures[0].magnified = TextureFilter::Nearest; },
      [](Scene& s) { s.textures[0].minified = TextureFilter::Nearest; },
      [](Scene& s) { s.textures[0].between_mips = TextureFilter::Nearest; },
      [](Scene& s) { s.textures[0].between_mips = std::nullopt; },
      [](Scene& s) { s.textures[0].wrap_u = TextureWrap::ClampToEdge; },
      [](Scene& s) { s.textures[0].wrap_v = TextureWrap::ClampToEdge; },
      [](Scene& s) { std::swap(s.images[0].width, s.images[0].height); },
      [](Scene& s) { s.images[0].rgba[7] = 1; },
  };
  std::set<std::uint64_t> digests{digest(probe())};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Scene scene = probe();
    changes[i](scene);
    EXPECT_TRUE(digests.insert(digest(scene)).second) << "change " << i;
  }
}

void change(bool& flag) { flag = !flag; }
void change(float& number) { number += 0.25F; }
void change(std::string& text) { text += "x"; }
void change(std::optional<float>& number) { number = 0.5F; }
void change(glm::vec2& v) { v.y += 0.25F; }
void change(glm::vec3& v) { v.y += 0.25F; }
void change(glm::vec4& v) { v.y += 0.25F; }
void change(std::array<TextureUse, kTextureSlots>& textures) { textures.back().offset.y = 0.25F; }

TEST(Digest, ChangesWithEveryFieldOfAMaterial) {
  std::set<std::uint64_t> digests{digest(probe())};
  for_each_pbr_field([&](const auto& field) {
    Scene scene = probe();
    change(scene.materials[0].*field.member);
    EXPECT_TRUE(digests.insert(digest(scene)).second) << field.name;
  });
}

}  // namespace scene_test
}  // namespace afm::scene
