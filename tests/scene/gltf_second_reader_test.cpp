// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/gltf_loader.h"

// tinygltf reads our models too: where two readers that share no code agree, neither has misread the format.
namespace afm::scene {
namespace {

std::vector<std::string> models() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(AFM_SOURCE_DIR "/assets/models")) {
    paths.push_back(entry.path().string());
  }
  return paths;
}

tinygltf::Model read_with_tinygltf(const std::string& path) {
  tinygltf::TinyGLTF reader;
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(reader.LoadBinaryFromFile(&model, &error, &warning, path)) << path << ": " << error;
  EXPECT_EQ(error + warning, "") << path;
  return model;
}

std::vector<glm::vec3> positions_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const tinygltf::Accessor& accessor =
      model.accessors.at(static_cast<std::size_t>(primitive.attributes.at("POSITION")));
  const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  const unsigned char* bytes = model.buffers.at(static_cast<std::size_t>(view.buffer)).data.data();
  const auto stride = static_cast<std::size_t>(accessor.ByteStride(view));
  std::vector<glm::vec3> positions(accessor.count);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    std::memcpy(&positions[i], bytes + view.byteOffset + accessor.byteOffset + i * stride, sizeof(glm::vec3));
  }
  return positions;
}

TEST(SecondReader, AgreesOnTheNodesMeshesAndPositionsOfEveryModel) {
  std::size_t compared = 0;
  for (const std::string& path : models()) {
    const auto ours = load_gltf(path);
    ASSERT_TRUE(ours) << ours.error().message;
    const tinygltf::Model theirs = read_with_tinygltf(path);
    ASSERT_EQ(ours->meshes.size(), theirs.meshes.size()) << path;
    EXPECT_EQ(ours->nodes.size(), theirs.nodes.size()) << path;
    for (const tinygltf::Node& node : theirs.nodes)
      EXPECT_TRUE(ours->find_node(node.name)) << path << ": " << node.name;
    for (std::size_t m = 0; m < ours->meshes.size(); ++m) {
      ASSERT_EQ(ours->meshes[m].primitives.size(), theirs.meshes[m].primitives.size()) << path;
      for (std::size_t p = 0; p < ours->meshes[m].primitives.size(); ++p) {
        const auto positions = positions_of(theirs, theirs.meshes[m].primitives[p]);
        const std::vector<Vertex>& vertices = ours->meshes[m].primitives[p].vertices;
        ASSERT_EQ(vertices.size(), positions.size()) << path << ", mesh " << m;
        for (std::size_t v = 0; v < positions.size(); ++v) ASSERT_EQ(vertices[v].position, positions[v]) << path;
        compared += positions.size();
      }
    }
  }
  EXPECT_GT(compared, 10'000U);
}

}  // namespace
}  // namespace afm::scene
