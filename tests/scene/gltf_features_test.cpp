// SPDX-License-Identifier: Apache-2.0
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <array>
#include <string>
#include <vector>

#include "gltf_document.h"
#include "scene/gltf/gltf_loader.h"

namespace afm::scene {
namespace gltf_features_test {

using nlohmann::json;
using testing::ElementsAre;

std::string bytes_of(std::initializer_list<int> values) {
  std::string bytes;
  for (const int value : values) bytes.push_back(static_cast<char>(value));
  return bytes;
}

std::string floats_of(std::initializer_list<float> values) {
  std::string bytes;
  put(bytes, values);
  return bytes;
}

class GltfFeatures : public GltfFolder {
 protected:
  GltfFeatures() : document_(square_json()), binary_(square_binary()) {}

  json& primitive() { return document_["meshes"][0]["primitives"][0]; }
  Primitive loaded() const {
    const core::Result<Scene> scene = load(document_, binary_);
    if (!scene) throw std::runtime_error(scene.error().message);
    return scene->meshes.at(0).primitives.at(0);
  }

  json document_;
  std::string binary_;
};

TEST_F(GltfFeatures, TurnsStripsFansAndLoopsIntoLists) {
  struct Mode {
    int number;
    Topology topology;
    std::vector<std::uint32_t> indices;
  };
  primitive().erase("indices");
  for (const Mode& mode : {Mode{0, Topology::Points, {0, 1, 2, 3}},
                           {1, Topology::Lines, {0, 1, 2, 3}},
                           {2, Topology::Lines, {0, 1, 1, 2, 2, 3, 3, 0}},
                           {3, Topology::Lines, {0, 1, 1, 2, 2, 3}}}) {
    primitive()["mode"] = mode.number;
    EXPECT_EQ(loaded().topology, mode.topology) << mode.number;
    EXPECT_EQ(loaded().indices, mode.indices) << mode.number;
    EXPECT_EQ(loaded().normals, Normals::None) << mode.number;
  }

  // flat triangles share no corners, so their positions identify them
  const auto corners = [&] {
    std::vector<glm::vec3> places;
    for (const Vertex& vertex : loaded().vertices) places.push_back(vertex.position);
    return places;
  };
  const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
  primitive()["mode"] = 5;
  EXPECT_THAT(corners(), ElementsAre(a, b, c, b, d, c)) << "every other triangle is turned round";
  primitive()["mode"] = 6;
  EXPECT_THAT(corners(), ElementsAre(b, c, a, c, d, a));
}

TEST_F(GltfFeatures, ReadsInterleavedAndNormalizedValues) {
  // two bytes of coordinates and two of filling a vertex
  const auto view = add_view(document_, binary_, bytes_of({0, 255, 9, 9, 255, 51, 9, 9, 0, 0, 9, 9, 102, 0, 9, 9}));
  document_["bufferViews"][view]["byteStride"] = 4;
  primitive()["attributes"]["TEXCOORD_1"] = add_accessor(document_, view, 5121, 4, "VEC2", true);
  primitive()["attributes"]["NORMAL"] = 0;
  const Primitive square = loaded();
  ASSERT_EQ(square.texture_coordinates.size(), 4U);
  EXPECT_EQ(square.texture_coordinates[0].set_1, glm::vec2(0, 1));
  EXPECT_FLOAT_EQ(square.texture_coordinates[1].set_1.y, 0.2F);
  EXPECT_EQ(square.texture_coordinates[3].set_0, glm::vec2(0));
}

TEST_F(GltfFeatures, ReadsSmallIntegersOnlyWhereTheFileSaysSo) {
  const auto view = add_view(document_, binary_, bytes_of({0, 0, 0, 0, -127, 0, 0, 0, 127, 127, 0, 0, 0, -128, 0, 0}));
  document_["bufferViews"][view]["byteStride"] = 4;
  primitive()["attributes"]["POSITION"] = add_accessor(document_, view, 5120, 4, "VEC3", true);
  expect_refused(load(document_, binary_), "POSITION of a forbidden type");
  document_["extensionsUsed"] = {"KHR_mesh_quantization"};
  EXPECT_EQ(loaded().vertices.at(1).position, glm::vec3(-1, 0, 0));
  EXPECT_EQ(loaded().vertices.at(5).position, glm::vec3(0, -1, 0)) << "-128 is no less than -1";
}

TEST_F(GltfFeatures, ReplacesTheValuesThatASparseAccessorNames) {
  const auto indices = add_view(document_, binary_, bytes_of({1, 3}));
  const auto values = add_view(document_, binary_, floats_of({7, 7, 7, 8, 8, 8}));
  json& accessor = document_["accessors"][0];
  accessor["sparse"] = {{"count", 2},
                        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                        {"values", {{"bufferView", values}}}};
  primitive()["attributes"]["NORMAL"] = 0;
  EXPECT_EQ(loaded().vertices.at(1).position, glm::vec3(7));
  EXPECT_EQ(loaded().vertices.at(2).position, glm::vec3(1, 1, 0));
  accessor.erase("bufferView");
  EXPECT_EQ(loaded().vertices.at(2).position, glm::vec3(0)) << "zeros below";
  EXPECT_EQ(loaded().vertices.at(3).position, glm::vec3(8));
  binary_[binary_.size() - 24 - 4] = 3;
  expect_refused(load(document_, binary_), "not increasing");
}

TEST_F(GltfFeatures, DecodesImagesAndKeepsWhatAMaterialSaysOfThem) {
  const auto view = add_view(document_, binary_, tiny_png());
  document_["images"] = json::array({{{"bufferView", view}, {"mimeType", "image/png"}}});
  document_["samplers"] = json::array({{{"magFilter", 9728}, {"minFilter", 9985}, {"wrapS", 33071}, {"wrapT", 33648}}});
  document_["textures"] = json::array({{{"source", 0}}, {{"source", 0}, {"sampler", 0}}});
  document_["materials"][0]["alphaMode"] = "MASK";
  document_["materials"][0]["normalTexture"] = {
      {"index", 1},
      {"texCoord", 1},
      {"scale", 0.5},
      {"extensions", {{"KHR_texture_transform", {{"offset", {0.25, 0}}, {"rotation", 1}, {"scale", {2, 3}}}}}}};
  const core::Result<Scene> scene = load(document_, binary_);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->images.size(), 1U);
  EXPECT_THAT(scene->images[0].rgba, ElementsAre(255, 0, 0, 128));
  ASSERT_EQ(scene->textures.size(), 1U) << "what is not used is not read";
  EXPECT_EQ(scene->textures[0].magnified, TextureFilter::Nearest);
  EXPECT_EQ(scene->textures[0].minified, TextureFilter::Linear);
  EXPECT_EQ(scene->textures[0].between_mips, TextureFilter::Nearest);
  EXPECT_EQ(scene->textures[0].wrap_u, TextureWrap::ClampToEdge);
  EXPECT_EQ(scene->textures[0].wrap_v, TextureWrap::MirroredRepeat);
  const PbrMaterial& material = scene->materials.at(0);
  const TextureUse& use = material.texture(TextureSlot::Normal);
  EXPECT_EQ(use.texture, 0U);
  EXPECT_EQ(use.coordinates, 1U);
  EXPECT_EQ(use.scale, glm::vec2(2, 3));
  EXPECT_EQ(use.rotation_rad, 1.0F);
  EXPECT_EQ(material.normal_scale, 0.5F);
  EXPECT_EQ(material.alpha_cutoff, 0.5F);
  EXPECT_FALSE(material.texture(TextureSlot::BaseColor).texture);
}

TEST_F(GltfFeatures, ReadsAStreamOfMeshoptimizer) {
  const std::array<float, 12> places{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::string stream(meshopt_encodeVertexBufferBound(4, 12), '\0');
  stream.resize(
      meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(stream.data()), stream.size(), places.data(), 4, 12));
  const auto view = add_view(document_, binary_, stream);

  // the view's own buffer is a placeholder that no file holds
  document_["buffers"].push_back({{"byteLength", 48}});
  document_["bufferViews"][0] = {{"buffer", 1},
                                 {"byteLength", 48},
                                 {"byteStride", 12},
                                 {"extensions",
                                  {{"EXT_meshopt_compression",
                                    {{"buffer", 0},
                                     {"byteOffset", document_["bufferViews"][view]["byteOffset"]},
                                     {"byteLength", stream.size()},
                                     {"byteStride", 12},
                                     {"count", 4},
                                     {"mode", "ATTRIBUTES"}}}}}};
  document_["extensionsUsed"] = document_["extensionsRequired"] = {"EXT_meshopt_compression"};
  EXPECT_EQ(loaded().vertices.at(2).position, glm::vec3(1, 1, 0));
  binary_[document_["bufferViews"][view]["byteOffset"].get<std::size_t>()] = 0x55;
  expect_refused(load(document_, binary_), "contains a corrupt compressed stream");
}

// Two views of 129 MiB each, of zeros that take a few kilobytes in the file: more than a model may unpack to.
TEST_F(GltfFeatures, RefusesStreamsOfMeshoptimizerThatUnpackToMoreThan256MiB) {
  constexpr std::size_t kStride = 252, kCount = (129U << 20U) / kStride;
  std::string stream(meshopt_encodeVertexBufferBound(kCount, kStride), '\0');
  {
    const std::vector<unsigned char> zeros(kCount * kStride);
    stream.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(stream.data()), stream.size(),
                                             zeros.data(), kCount, kStride));
  }
  const auto view = add_view(document_, binary_, stream);
  document_["buffers"].push_back({{"byteLength", kCount * kStride}});
  for (int i = 0; i < 2; ++i) {
    document_["bufferViews"].push_back({{"buffer", 1},
                                        {"byteLength", kCount * kStride},
                                        {"byteStride", kStride},
                                        {"extensions",
                                         {{"EXT_meshopt_compression",
                                           {{"buffer", 0},
                                            {"byteOffset", document_["bufferViews"][view]["byteOffset"]},
                                            {"byteLength", stream.size()},
                                            {"byteStride", kStride},
                                            {"count", kCount},
                                            {"mode", "ATTRIBUTES"}}}}}});
    document_["extensionsUsed"] = document_["extensionsRequired"] = {"EXT_meshopt_compression"};
    if (i == 0) {
      EXPECT_NO_THROW(loaded());
    }
  }
  expect_refused(load(document_, binary_), "its compressed buffer views expand to more than 256 MiB");
}

std::string draco_triangle() {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const std::array<std::array<float, 3>, 3> places{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}};
  builder.SetAttributeValuesForFace(position, draco::FaceIndex(0), places[0].data(), places[1].data(),
                                    places[2].data());
  const auto mesh = builder.Finalize();
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(draco::Encoder().EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

TEST_F(GltfFeatures, ReadsAStreamOfDraco) {
  const auto view = add_view(document_, binary_, draco_triangle());
  document_["accessors"][0]["count"] = document_["accessors"][1]["count"] = 3;
  for (json& accessor : document_["accessors"]) accessor.erase("bufferView");
  primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
  document_["extensionsUsed"] = document_["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  float far = 0;
  for (const Vertex& vertex : loaded().vertices) far = std::max(far, vertex.position.x + vertex.position.y);
  EXPECT_EQ(far, 2.0F);
  document_["accessors"][1]["count"] = 6;
  expect_refused(load(document_, binary_), "announces 1 triangles");
  document_["accessors"][1]["count"] = 3;
  document_["accessors"][0]["count"] = 4;
  expect_refused(load(document_, binary_), "does not contain POSITION");
}

TEST_F(GltfFeatures, SurvivesAFlippedByteInAStreamOfDraco) {
  const std::string stream = draco_triangle();
  const auto view = add_view(document_, binary_, stream);
  document_["accessors"][0]["count"] = document_["accessors"][1]["count"] = 3;
  for (json& accessor : document_["accessors"]) accessor.erase("bufferView");
  primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
  const auto at = document_["bufferViews"][view]["byteOffset"].get<std::size_t>();
  int refused = 0;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    std::string spoilt = binary_;
    spoilt[at + i] = static_cast<char>(spoilt[at + i] ^ 0x2A);
    refused += load(document_, spoilt) ? 0 : 1;
  }
  EXPECT_GT(refused, 8) << "the header at least";
}

TEST_F(GltfFeatures, RefusesAStreamOfDracoThatTakesMoreRoomThanItsTriangles) {
  const std::string stream = draco_triangle();
  ASSERT_EQ(stream[8], 1) << "edgebreaker: kind of traversal, vertices, triangles, tables of seams";
  document_["accessors"][0]["count"] = document_["accessors"][1]["count"] = 3;
  for (json& accessor : document_["accessors"]) accessor.erase("bufferView");
  const auto spoilt = [&](std::size_t at, const std::string& bytes) {
    std::string binary = binary_;
    json document = document_;
    const auto view = add_view(document, binary, std::string(stream).replace(at, 1, bytes));
    json& only = document["meshes"][0]["primitives"][0];
    only["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
    return load(document, binary);
  };
  expect_refused(spoilt(12, "\xFF\xFF\xFF\xFF\x0F"), "announces 4294967295 vertices");
  EXPECT_TRUE(spoilt(12, stream.substr(12, 1))) << "as it was";
}

TEST_F(GltfFeatures, RefusesAStreamOfDracoWhoseAttributesFillTheMemory) {
  constexpr int kTriangles = 100'000;
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(kTriangles);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int other = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 1, draco::DT_UINT8);
  const std::uint8_t zero = 0;
  for (std::uint32_t i = 0; i < kTriangles; ++i) {
    const auto far = static_cast<float>(i);
    const std::array<std::array<float, 3>, 3> places{{{far, 0, 0}, {far, 1, 0}, {far, 0, 1}}};
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(i), places[0].data(), places[1].data(),
                                      places[2].data());
    builder.SetAttributeValuesForFace(other, draco::FaceIndex(i), &zero, &zero, &zero);
  }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
  draco::EncoderBuffer buffer;
  ASSERT_TRUE(encoder.EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok());
  std::string stream(buffer.data(), buffer.size());

  document_["accessors"][0]["count"] = document_["accessors"][1]["count"] = 3 * kTriangles;
  document_["accessors"][1]["componentType"] = 5125;
  for (json& accessor : document_["accessors"]) accessor.erase("bufferView");
  const auto with = [&](const std::string& bytes) {
    std::string binary = binary_;
    json document = document_;
    const auto view = add_view(document, binary, bytes);
    json& only = document["meshes"][0]["primitives"][0];
    only["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
    return load(document, binary);
  };
  const auto sound = with(stream);
  EXPECT_TRUE(sound) << sound.error().message;

  // the attribute's kind, type, number of components, normalisation and name
  const std::size_t at = stream.find(std::string("\x04\x02\x01\x00\x01", 5));
  ASSERT_NE(at, std::string::npos);
  stream[at + 2] = 127;
  expect_refused(with(stream), "more than 128 MiB of attributes");
}

TEST_F(GltfFeatures, ReadsWhatTinygltfRefuses) {
  document_["buffers"].push_back({{"byteLength", 1'000'000}});
  document_["animations"] = json::array(
      {{{"samplers", {{{"input", 2}, {"output", 2}}}},
        {"channels",
         {{{"sampler", 0},
           {"target", {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", "/x"}}}}}}}}}}}});
  document_["accessors"].push_back({{"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}});
  EXPECT_EQ(loaded().indices.size(), 6U) << "a buffer without data, a channel without a node";
  document_["accessors"][1].erase("bufferView");
  EXPECT_EQ(loaded().indices.size(), 6U) << "indices without a view are zeros";
}

TEST_F(GltfFeatures, PutsInstancesBelowTheirNode) {
  const auto view = add_view(document_, binary_, floats_of({0, 0, 0, 5, 0, 0, 0, 6, 0}));
  document_["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", add_accessor(document_, view, 5126, 3, "VEC3")}};
  const core::Result<Scene> scene = load(document_, binary_);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->nodes.size(), 5U);
  EXPECT_FALSE(scene->nodes[1].mesh);
  EXPECT_EQ(scene->nodes[3].parent, 1U);
  EXPECT_EQ(scene->nodes[3].mesh, 0U);
  EXPECT_EQ(glm::dvec3(scene->nodes[4].parent_from_node[3]), glm::dvec3(0, 6, 0));
}

TEST_F(GltfFeatures, TakesWhatIsAllowedToBeMissing) {
  document_["skins"] = json::array({{{"joints", {0}}}});
  document_["nodes"][1]["skin"] = 0;
  document_["animations"] = json::array({{{"samplers", json::array()}, {"channels", json::array()}}});
  document_["cameras"] = json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}});
  document_["nodes"][0]["camera"] = 0;
  document_["nodes"][0]["extras"] = {{"touchafm", {{"role", "surface"}}}};
  const core::Result<Scene> scene = load(document_, binary_);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->skins.at(0).joint_from_mesh.at(0), glm::mat4(1.0F));
  EXPECT_FALSE(scene->cameras.at(0).far_m);
  EXPECT_EQ(scene->nodes.at(0).role, "surface");
}

TEST_F(GltfFeatures, TakesWholeNumbersHoweverTheyAreWritten) {
  document_["accessors"][0]["count"] = 4.0;
  primitive()["indices"] = 1.0;
  EXPECT_EQ(loaded().vertices.size(), 6U);
  primitive()["indices"] = 0.5;
  expect_refused(load(document_, binary_), "indices is 0.5");
}

TEST_F(GltfFeatures, NotesWhatIsNotShown) {
  document_["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_sheen"};
  document_["asset"]["generator"] = "a test";
  primitive()["attributes"] = {{"_TEMPERATURE", 0}};
  GltfWarnings notes;
  ASSERT_TRUE(load_gltf(write("model.glb", glb(document_.dump(), binary_)), &notes));
  EXPECT_EQ(notes.generator, "a test");
  EXPECT_THAT(notes.extensions, ElementsAre("KHR_materials_unlit"));
  EXPECT_THAT(notes.ignored, ElementsAre(testing::HasSubstr("KHR_materials_sheen"), testing::HasSubstr("_TEMPERATURE"),
                                         testing::HasSubstr("without POSITION")));
}

}  // namespace gltf_features_test
}  // namespace afm::scene
