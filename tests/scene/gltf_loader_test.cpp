// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_loader.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "gltf_document.h"

namespace afm::scene {
namespace gltf_loader_test {

using nlohmann::json;

class GltfLoader : public GltfFolder {};

TEST_F(GltfLoader, ReadsNodesMeshesAndMaterials) {
  const core::Result<Scene> scene = load(square_json());
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->nodes.size(), 2U);
  EXPECT_EQ(scene->nodes[1].name, "surface");
  EXPECT_EQ(scene->nodes[1].parent, 0U);
  EXPECT_EQ(scene->nodes[1].mesh, 0U);
  EXPECT_EQ(scene->materials.at(0).name, "mica");
  EXPECT_EQ(scene->materials.at(0).metallic, 1.0F);
  EXPECT_EQ(scene->meshes.at(0).name, "square");
}

TEST_F(GltfLoader, MakesFlatNormalsWhereThereAreNone) {
  const core::Result<Scene> scene = load(square_json());
  ASSERT_TRUE(scene) << scene.error().message;
  const Primitive& square = scene->meshes.at(0).primitives.at(0);
  EXPECT_EQ(square.vertices.size(), 6U) << "corners are no longer shared";
  EXPECT_EQ(square.indices.size(), 6U);
  for (const Vertex& vertex : square.vertices) EXPECT_EQ(vertex.normal, glm::vec3(0, 0, 1));
}

TEST_F(GltfLoader, ReadsIndicesOfEveryWidthAndNone) {
  for (const auto& [type, size] : {std::pair{5121, 1}, std::pair{5123, 2}, std::pair{5125, 4}}) {
    json document = square_json();
    std::string binary = square_binary().substr(0, 48);
    for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U}) put(binary, index, size);
    document["accessors"][1]["componentType"] = type;
    document["bufferViews"][1]["byteLength"] = 6 * size;
    document["buffers"][0]["byteLength"] = 48 + 6 * size;
    const core::Result<Scene> scene = load(document, binary);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->meshes[0].primitives[0].vertices.at(5).position, glm::vec3(0, 1, 0)) << size << " bytes";
  }
  json document = square_json();
  document["meshes"][0]["primitives"][0].erase("indices");
  document["accessors"][0]["count"] = 3;
  const core::Result<Scene> scene = load(document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes[0].primitives[0].indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST_F(GltfLoader, ReadsNormalsAndColours) {
  json document = square_json();
  std::string binary = square_binary();
  put(binary, {0, 0, 2, 0, 3, 0, 1, 0, 0, 0, 0, 0});                                             // data at 60
  for (const std::uint32_t c : {255U, 0U, 51U, 102U}) put(binary, c * 0x010101U | 0xFF000000U);  // data at 108
  document["buffers"][0]["byteLength"] = binary.size();
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 60}, {"byteLength", 48}});
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 108}, {"byteLength", 16}});
  document["accessors"].push_back({{"bufferView", 2}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  document["accessors"].push_back(
      {{"bufferView", 3}, {"componentType", 5121}, {"normalized", true}, {"count", 4}, {"type", "VEC4"}});
  document["meshes"][0]["primitives"][0]["attributes"] = {{"POSITION", 0}, {"NORMAL", 2}, {"COLOR_0", 3}};
  const core::Result<Scene> scene = load(document, binary);
  ASSERT_TRUE(scene) << scene.error().message;
  const std::vector<Vertex>& vertices = scene->meshes[0].primitives[0].vertices;
  ASSERT_EQ(vertices.size(), 4U);
  EXPECT_EQ(vertices[0].normal, glm::vec3(0, 0, 1)) << "made unit length";
  EXPECT_EQ(vertices[1].normal, glm::vec3(0, 1, 0));
  EXPECT_EQ(vertices[3].normal, glm::vec3(0, 0, 1)) << "a zero normal becomes +z";
  EXPECT_FLOAT_EQ(vertices[2].color.g, 0.2F);
  EXPECT_EQ(vertices[2].color.a, 1.0F);
}

TEST_F(GltfLoader, ReadsTransformsOfBothKinds) {
  json document = square_json();
  document["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 5, 6, 7, 1};
  document["nodes"][1]["translation"] = {1, 2, 3};
  document["nodes"][1]["rotation"] = {0, 0, 0.7071067811865476, 0.7071067811865476};
  document["nodes"][1]["scale"] = {2, 3, 4};
  const core::Result<Scene> scene = load(document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(glm::dvec3(scene->nodes[0].parent_from_node * glm::dvec4(0, 0, 1, 0)), glm::dvec3(0, 1, 0));
  EXPECT_EQ(glm::dvec3(scene->nodes[0].parent_from_node[3]), glm::dvec3(5, 6, 7));
  const glm::dvec4 point = scene->nodes[1].parent_from_node * glm::dvec4(1, 1, 1, 1);
  EXPECT_NEAR(point.x, 1 - 3, 1e-12);
  EXPECT_NEAR(point.y, 2 + 2, 1e-12);
  EXPECT_NEAR(point.z, 3 + 4, 1e-12);
}

TEST_F(GltfLoader, ReadsMaterialFactorsAndExtensions) {
  json document = square_json();
  document["extensionsUsed"] = {"KHR_materials_emissive_strength"};
  document["extensionsRequired"] = document["extensionsUsed"];
  document["materials"][0] = json::parse(R"({"name": "beam", "doubleSided": true, "alphaMode": "BLEND",
    "emissiveFactor": [1, 0.5, 0],
    "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0, "roughnessFactor": 0.25},
    "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}})");
  const core::Result<Scene> scene = load(document);
  ASSERT_TRUE(scene) << scene.error().message;
  const PbrMaterial& material = scene->materials.at(0);
  EXPECT_EQ(material.base_color, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
  EXPECT_EQ(material.emissive, glm::vec3(4, 2, 0));
  EXPECT_EQ(material.metallic, 0.0F);
  EXPECT_EQ(material.roughness, 0.25F);
  EXPECT_TRUE(material.double_sided && material.blended && !material.unlit);
}

// Fields other than the base colour are for programs that do not know the extension.
TEST_F(GltfLoader, TakesNoEmissionFromAnUnlitMaterial) {
  json document = square_json();
  document["extensionsUsed"] = {"KHR_materials_unlit"};
  document["materials"][0] =
      json::parse(R"({"emissiveFactor": [1, 0.5, 0], "extensions": {"KHR_materials_unlit": {}}})");
  const core::Result<Scene> scene = load(document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->materials.at(0).unlit);
  EXPECT_EQ(scene->materials.at(0).emissive, glm::vec3(0));
}

TEST_F(GltfLoader, GivesPrimitivesWithoutMaterialTheDefaultOne) {
  json document = square_json();
  document["meshes"][0]["primitives"][0].erase("material");
  const core::Result<Scene> scene = load(document);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->materials.size(), 2U);
  EXPECT_EQ(scene->meshes[0].primitives[0].material, 1U);
  EXPECT_EQ(scene->materials[1].name, "default");
}

TEST_F(GltfLoader, ReadsNoImageThatNothingShows) {
  json document = square_json();
  document["images"] = json::array({{{"uri", "../../../../etc/passwd"}}});
  document["textures"] = json::array({{{"source", 0}}});
  const core::Result<Scene> scene = load(document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->textures.empty() && scene->images.empty());
}

TEST_F(GltfLoader, LetsExtrasHoldAnything) {
  json document = square_json();
  document["accessors"][0]["extras"] = {{"count", -1}, {"byteOffset", {-2}}};
  document["extras"] = {{"byteLength", -1}};
  const core::Result<Scene> scene = load(document);
  EXPECT_TRUE(scene) << scene.error().message;
}

TEST_F(GltfLoader, PutsParentsBeforeChildrenWhateverTheirOrder) {
  json document = square_json();
  document["nodes"] =
      json::parse(R"([{"name": "leaf", "mesh": 0}, {"name": "other"}, {"name": "root", "children": [3, 1]},
                                      {"name": "middle", "children": [0]}])");
  document["scenes"][0]["nodes"] = {2};
  const core::Result<Scene> scene = load(document);
  ASSERT_TRUE(scene) << scene.error().message;
  std::vector<std::string> names;
  for (const Node& node : scene->nodes) names.push_back(node.name);
  EXPECT_EQ(names, (std::vector<std::string>{"root", "middle", "leaf", "other"}));
  EXPECT_EQ(scene->nodes[2].parent, 1U);
  EXPECT_EQ(scene->nodes[3].parent, 0U);
}

TEST_F(GltfLoader, ReadsAVeryDeepHierarchy) {
  json document = square_json();
  constexpr int kDepth = 50'000;
  document["nodes"] = json::array();
  for (int i = 0; i + 1 < kDepth; ++i) document["nodes"].push_back({{"children", {i + 1}}});
  document["nodes"].push_back({{"mesh", 0}});
  const core::Result<Scene> scene = load(document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->nodes.size(), static_cast<std::size_t>(kDepth));
}

TEST_F(GltfLoader, ReadsTextFilesWithSideFilesAndEmbeddedData) {
  json document = square_json();
  document["buffers"][0]["uri"] = "square.bin";
  write("square.bin", square_binary());
  const core::Result<Scene> beside = load_gltf(write("beside.gltf", document.dump()));
  ASSERT_TRUE(beside) << beside.error().message;

  // "AAAA..." is 60 zero bytes: every position and index is zero
  document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + std::string(80, 'A');
  const core::Result<Scene> embedded = load_gltf(write("embedded.gltf", document.dump()));
  ASSERT_TRUE(embedded) << embedded.error().message;
  EXPECT_EQ(embedded->meshes[0].primitives[0].indices.size(), 6U);
}

}  // namespace gltf_loader_test
}  // namespace afm::scene
