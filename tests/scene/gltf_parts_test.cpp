// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <array>
#include <string>
#include <vector>

#include "gltf_document.h"
#include "scene/gltf/gltf_loader.h"

// Repeated parts of a model, each with its own numbers.
namespace afm::scene {
namespace gltf_parts_test {

using nlohmann::json;
using testing::ElementsAre;

class GltfParts : public GltfFolder {
 protected:
  json document_ = square_json();
  std::string binary_ = square_binary();
};

TEST_F(GltfParts, GiveEachJointItsOwnMatrix) {
  std::string matrices;
  // the last row of the second is not of this world, and is not taken over
  put(matrices, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 3, 4, 1});
  put(matrices, {2, 0, 0, 0.25F, 0, 2, 0, 0.25F, 0, 0, 2, 0.25F, 5, 6, 7, 3});
  const auto view = add_view(document_, binary_, matrices);
  const auto accessor = add_accessor(document_, view, 5126, 2, "MAT4");
  document_["skins"] = json::array({{{"joints", {0, 1}}, {"inverseBindMatrices", accessor}}});
  document_["nodes"][1]["skin"] = 0;
  const core::Result<Scene> scene = load(document_, binary_);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->skins.at(0).joint_from_mesh.size(), 2U);
  EXPECT_EQ(scene->skins[0].joint_from_mesh[0], glm::mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 3, 4, 1));
  EXPECT_EQ(scene->skins[0].joint_from_mesh[1], glm::mat4(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1));
}

TEST_F(GltfParts, GiveEachCameraItsOwnView) {
  document_["cameras"] = json::array(
      {{{"type", "perspective"},
        {"name", "near"},
        {"perspective", {{"yfov", 0.5}, {"aspectRatio", 1.5}, {"znear", 0.25}, {"zfar", 8}}}},
       {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0.125}, {"zfar", 16}}}}});
  document_["nodes"][0]["camera"] = 1;
  document_["nodes"][1]["camera"] = 0;
  const core::Result<Scene> scene = load(document_, binary_);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->cameras.size(), 2U);
  const Camera& eye = scene->cameras[0];
  EXPECT_EQ(eye.name, "near");
  EXPECT_TRUE(eye.perspective);
  EXPECT_EQ(eye.yfov_rad, 0.5F);
  EXPECT_EQ(eye.aspect_ratio, 1.5F);
  EXPECT_EQ(eye.near_m, 0.25F);
  EXPECT_EQ(eye.far_m, 8.0F);
  const Camera& plan = scene->cameras[1];
  EXPECT_FALSE(plan.perspective);
  EXPECT_EQ(plan.half_size_m, glm::vec2(2, 3));
  EXPECT_EQ(plan.near_m, 0.125F);
  EXPECT_EQ(plan.far_m, 16.0F);
  EXPECT_EQ(scene->nodes[0].camera, 1U);
  EXPECT_EQ(scene->nodes[1].camera, 0U);
}

// Indices of so many corners of the square, as a stream of meshoptimizer in the mode TRIANGLES.
class MeshoptTriangles : public GltfParts {
 protected:
  core::Result<Scene> load_triangles(const std::vector<std::uint16_t>& indices, std::size_t count) {
    std::string stream(meshopt_encodeIndexBufferBound(indices.size(), 4), '\0');
    stream.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(stream.data()), stream.size(),
                                            indices.data(), indices.size()));
    const auto view = add_view(document_, binary_, stream);
    const json offset = document_["bufferViews"][view]["byteOffset"];
    document_["buffers"].push_back({{"byteLength", 2 * count}});
    document_["bufferViews"][1] = {{"buffer", 1},
                                   {"byteLength", 2 * count},
                                   {"extensions",
                                    {{"EXT_meshopt_compression",
                                      {{"buffer", 0},
                                       {"byteOffset", offset},
                                       {"byteLength", stream.size()},
                                       {"byteStride", 2},
                                       {"count", count},
                                       {"mode", "TRIANGLES"}}}}}};
    document_["accessors"][1]["count"] = count;
    document_["extensionsUsed"] = document_["extensionsRequired"] = {"EXT_meshopt_compression"};
    return load(document_, binary_);
  }
};

TEST_F(MeshoptTriangles, MayBeAnyNumber) {
  const core::Result<Scene> one = load_triangles({0, 1, 2}, 3);
  ASSERT_TRUE(one) << one.error().message;
  EXPECT_EQ(one->meshes.at(0).primitives.at(0).indices.size(), 3U);
}

TEST_F(MeshoptTriangles, AreTheOnesThatWerePacked) {
  const core::Result<Scene> two = load_triangles({0, 1, 2, 0, 2, 3}, 6);
  ASSERT_TRUE(two) << two.error().message;
  EXPECT_EQ(two->meshes.at(0).primitives.at(0).indices.size(), 6U);
}

TEST_F(MeshoptTriangles, HaveThreeCornersEach) {
  expect_refused(load_triangles({0, 1, 2}, 4), "inconsistent count, byteStride and filter");
}

}  // namespace gltf_parts_test
}  // namespace afm::scene
