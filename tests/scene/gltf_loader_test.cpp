// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_loader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace afm::scene {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

void put(std::string& bytes, std::uint32_t value, int size = 4) {
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i)));
}

void put(std::string& bytes, std::initializer_list<float> values) {
  for (const float value : values) put(bytes, std::bit_cast<std::uint32_t>(value));
}

// A square of four vertices: 48 bytes of positions, then six 16-bit indices.
std::string square_binary() {
  std::string bytes;
  put(bytes, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U}) put(bytes, index, 2);
  return bytes;
}

json square_json() {
  return json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "sample", "children": [1]}, {"name": "surface", "mesh": 0}],
    "meshes": [{"name": "square", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "materials": [{"name": "mica"}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
    "buffers": [{"byteLength": 60}]})");
}

std::string glb(std::string text, std::string binary) {
  while (text.size() % 4 != 0) text += ' ';
  while (binary.size() % 4 != 0) binary += '\0';
  std::string bytes = "glTF";
  put(bytes, 2);
  put(bytes, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary.size()));
  put(bytes, static_cast<std::uint32_t>(text.size()));
  put(bytes, 0x4E4F534A);
  bytes += text;
  put(bytes, static_cast<std::uint32_t>(binary.size()));
  put(bytes, 0x004E4942);
  return bytes + binary;
}

class GltfLoader : public testing::Test {
 protected:
  GltfLoader() : folder_(fs::path(testing::TempDir()) / ("gltf_loader_" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "models");
  }
  ~GltfLoader() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& bytes) const {
    const fs::path path = folder_ / "models" / name;
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
  }
  core::Result<Scene> load(const json& document, const std::string& binary = square_binary()) const {
    return load_gltf(write("model.glb", glb(document.dump(), binary)));
  }
  core::Result<Scene> load_bytes(const std::string& bytes) const { return load_gltf(write("model.glb", bytes)); }

  void expect_refused(const core::Result<Scene>& scene, const std::string& reason) const {
    ASSERT_FALSE(scene) << reason;
    EXPECT_EQ(scene.error().category, core::ErrorCategory::BadInputFile);
    EXPECT_THAT(scene.error().message, AllOf(HasSubstr("cannot load the model '" + folder_.string()), HasSubstr(reason),
                                             HasSubstr("; "), Not(HasSubstr("\n"))));
  }

  fs::path folder_;
};

// ---- what is read ----

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
  put(binary, {0, 0, 2, 0, 3, 0, 1, 0, 0, 0, 0, 0});                                             // at 60
  for (const std::uint32_t c : {255U, 0U, 51U, 102U}) put(binary, c * 0x010101U | 0xFF000000U);  // at 108
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
  document["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_emissive_strength"};
  document["extensionsRequired"] = document["extensionsUsed"];
  document["materials"][0] = json::parse(R"({"name": "beam", "doubleSided": true, "alphaMode": "BLEND",
    "emissiveFactor": [1, 0.5, 0],
    "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0, "roughnessFactor": 0.25},
    "extensions": {"KHR_materials_unlit": {}, "KHR_materials_emissive_strength": {"emissiveStrength": 4}}})");
  const core::Result<Scene> scene = load(document);
  ASSERT_TRUE(scene) << scene.error().message;
  const Material& material = scene->materials.at(0);
  EXPECT_EQ(material.base_color, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
  EXPECT_EQ(material.emissive, glm::vec3(4, 2, 0));
  EXPECT_EQ(material.metallic, 0.0F);
  EXPECT_EQ(material.roughness, 0.25F);
  EXPECT_TRUE(material.double_sided && material.blended && material.unlit);
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

TEST_F(GltfLoader, LoadsTheFactorsOfAFileWithTextures) {
  json document = square_json();
  document["images"] = json::array({{{"uri", "../../../../etc/passwd"}},
                                    {{"uri", "data:image/png;base64,AAAA"}},
                                    {{"bufferView", 0}, {"mimeType", "image/png"}}});
  document["textures"] = json::array({{{"source", 0}}});
  document["materials"][0]["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}, {"roughnessFactor", 0.5}};
  const core::Result<Scene> scene = load(document);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->materials.at(0).roughness, 0.5F);
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

// ---- what is refused ----

struct HostileCase {
  const char* name;
  const char* reason;
  std::function<void(json&)> spoil;
};

// powerwall.md of the research, section 5.2, and more: tinygltf accepts nearly all of these.
const std::vector<HostileCase>& hostile_cases() {
  static const std::vector<HostileCase> cases{
      {"AccessorWithoutView", "buffer view 7", [](json& d) { d["accessors"][0]["bufferView"] = 7; }},
      {"AccessorWithNoData", "does not exist", [](json& d) { d["accessors"][0].erase("bufferView"); }},
      {"AccessorTooLong", "accessor 0 reaches past", [](json& d) { d["accessors"][0]["count"] = 5; }},
      {"AccessorOfFourBillion", "accessor 0 reaches past",
       [](json& d) { d["accessors"][0]["count"] = 4'000'000'000U; }},
      {"AccessorCountThatOverflows", "reaches past",
       [](json& d) { d["accessors"][0]["count"] = 0x1555555555555556ULL; }},
      {"AccessorOffsetThatOverflows", "reaches past", [](json& d) { d["accessors"][0]["byteOffset"] = ~0ULL - 11; }},
      {"AccessorOfNothing", "accessor 0 reaches past", [](json& d) { d["accessors"][0]["count"] = 0; }},
      {"NegativeCount", "negative", [](json& d) { d["accessors"][0]["count"] = -1; }},
      {"NegativeOffset", "'byteOffset' is -4", [](json& d) { d["bufferViews"][0]["byteOffset"] = -4; }},
      {"UnknownComponentType", "type", [](json& d) { d["accessors"][0]["componentType"] = 5128; }},
      {"StrideTooWide", "reaches past", [](json& d) { d["bufferViews"][0]["byteStride"] = 252; }},
      {"StrideTooNarrow", "overlap", [](json& d) { d["bufferViews"][0]["byteStride"] = 4; }},
      {"ViewPastTheBuffer", "buffer view 0 reaches past", [](json& d) { d["bufferViews"][0]["byteLength"] = 64; }},
      {"ViewThatOverflows", "buffer view 0 reaches past",
       [](json& d) { d["bufferViews"][0]["byteOffset"] = ~0ULL - 3; }},
      {"ViewWithoutBuffer", "buffer 3", [](json& d) { d["bufferViews"][0]["buffer"] = 3; }},
      {"BufferLongerThanTheFile", "parser", [](json& d) { d["buffers"][0]["byteLength"] = 4096; }},
      {"BuffersThatFillTheMemory", "256 MiB",
       [](json& d) {
         d["buffers"] = json(20, {{"byteLength", 100U << 20U}});
       }},
      {"SparseAccessor", "sparse",
       [](json& d) {
         d["accessors"][0]["sparse"] =
             json::parse(R"({"count": 1000000, "indices": {"bufferView": 9, "componentType": 5123},
                                                      "values": {"bufferView": 9}})");
       }},
      {"AttributeWithoutAccessor", "accessor 9",
       [](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9; }},
      {"NegativeAttribute", "accessor -2",
       [](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -2; }},
      {"NoPosition", "without POSITION",
       [](json& d) {
         d["meshes"][0]["primitives"][0]["attributes"] = {{"NORMAL", 0}};
       }},
      {"PositionOfIndices", "POSITION of a type",
       [](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 1; }},
      {"IndicesOfFloats", "indices of a type", [](json& d) { d["meshes"][0]["primitives"][0]["indices"] = 0; }},
      {"IndicesWithoutAccessor", "out of bounds", [](json& d) { d["meshes"][0]["primitives"][0]["indices"] = 9; }},
      {"IndexPastTheVertices", "index 3 but only 3", [](json& d) { d["accessors"][0]["count"] = 3; }},
      {"HalfATriangle", "not a whole number", [](json& d) { d["accessors"][1]["count"] = 5; }},
      {"LineList", "mode 1", [](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 1; }},
      {"MaterialMissing", "material 4", [](json& d) { d["meshes"][0]["primitives"][0]["material"] = 4; }},
      {"PrimitiveThatIsNoObject", "parser",
       [](json& d) {
         d["meshes"][0]["primitives"] = json::array({1, 2});
       }},
      {"MeshMissing", "mesh 2", [](json& d) { d["nodes"][1]["mesh"] = 2; }},
      {"ChildMissing", "node 8", [](json& d) { d["nodes"][0]["children"] = {8}; }},
      {"NodeThatIsItsOwnChild", "loop", [](json& d) { d["nodes"][0]["children"] = {0}; }},
      {"NodesInALoop", "loop",
       [](json& d) {
         d["nodes"].push_back({{"children", {3}}});
         d["nodes"].push_back({{"children", {2}}});
       }},
      {"NodeWithTwoParents", "more than one parent",
       [](json& d) {
         d["nodes"].push_back({{"children", {1}}});
       }},
      {"SceneMissing", "default scene 5", [](json& d) { d["scene"] = 5; }},
      {"SceneWithMissingNode", "node 9", [](json& d) { d["scenes"][0]["nodes"] = {9}; }},
      {"SceneWithAChild", "not a root",
       [](json& d) {
         d["scenes"][0]["nodes"] = {0, 1};
       }},
      {"MatrixOfThree", "wrong number",
       [](json& d) {
         d["nodes"][0]["matrix"] = {1, 0, 0};
       }},
      {"MatrixWithPerspective", "not affine",
       [](json& d) { d["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }},
      {"ZeroQuaternion", "unit quaternion",
       [](json& d) {
         d["nodes"][0]["rotation"] = {0, 0, 0, 0};
       }},
      {"FactorOutOfRange", "0..1", [](json& d) { d["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 7; }},
      {"EmissiveStrengthAsText", "emissiveStrength",
       [](json& d) { d["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = "x"; }},
      {"RequiredExtension", "'KHR_draco_mesh_compression'",
       [](json& d) {
         d["extensionsRequired"] = {"KHR_materials_unlit", "KHR_draco_mesh_compression"};
       }},
      {"OldVersion", "version '1.0'", [](json& d) { d["asset"]["version"] = "1.0"; }},
      {"NoAsset", "parser", [](json& d) { d.erase("asset"); }},
  };
  return cases;
}

TEST_F(GltfLoader, RefusesEveryHostileDocument) {
  for (const HostileCase& hostile : hostile_cases()) {
    SCOPED_TRACE(hostile.name);
    json document = square_json();
    hostile.spoil(document);
    expect_refused(load(document), hostile.reason);
  }
}

TEST_F(GltfLoader, RefusesPositionsThatAreNotFinite) {
  for (const std::uint32_t bits : {0x7F800000U, 0x7FC00000U}) {
    std::string binary = square_binary();
    for (std::size_t i = 0; i < 4; ++i) binary[16 + i] = static_cast<char>(bits >> (8 * i));
    expect_refused(load(square_json(), binary), "not a finite number");
  }
}

TEST_F(GltfLoader, RefusesNumbersBeyondDouble) {
  std::string text = square_json().dump();
  const std::string name = R"("name":"sample")";
  text.replace(text.find(name), name.size(), R"("translation":[1e999,0,0])");
  expect_refused(load_bytes(glb(text, square_binary())), "JSON is broken");
}

TEST_F(GltfLoader, RefusesDeepNestingWithoutOverflowingTheStack) {
  const std::string deep =
      R"({"asset":{"version":"2.0"},"extras":)" + std::string(200'000, '[') + std::string(200'000, ']') + "}";
  expect_refused(load_bytes(glb(deep, "")), "nested deeper");
  expect_refused(load_gltf(write("deep.gltf", deep)), "nested deeper");
}

TEST_F(GltfLoader, RefusesEveryTruncation) {
  const std::string whole = glb(square_json().dump(), square_binary());
  for (std::size_t size = 0; size < whole.size(); size += 7) expect_refused(load_bytes(whole.substr(0, size)), "");
}

TEST_F(GltfLoader, RefusesWrongHeadersAndChunks) {
  const std::string whole = glb(square_json().dump(), square_binary());
  const auto with = [&](std::size_t offset, std::uint32_t value) {
    std::string bytes = whole, word;
    put(word, value);
    return bytes.replace(offset, 4, word);
  };
  const std::size_t binary_chunk = whole.size() - 60 - 8;
  expect_refused(load_bytes(with(4, 3)), "version 3");
  expect_refused(load_bytes(with(8, 40)), "its header says 40 bytes");
  expect_refused(load_bytes(with(12, 0xFFFFFFF0)), "a chunk reaches past its end");
  expect_refused(load_bytes(with(16, 0x004E4942)), "not JSON");
  // tinygltf forgets the chunk's own header and would read these 8 bytes past the end of the file
  expect_refused(load_bytes(with(binary_chunk, 68)), "a chunk reaches past its end");
}

TEST_F(GltfLoader, SurvivesAFlippedByteAnywhere) {
  const std::string whole = glb(square_json().dump(), square_binary());
  std::size_t refused = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string bytes = whole;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x15);
    const core::Result<Scene> scene = load_bytes(bytes);
    if (scene) continue;
    ++refused;
    EXPECT_THAT(scene.error().message, Not(HasSubstr("\n")));
  }
  EXPECT_GT(refused, whole.size() / 4);
}

TEST_F(GltfLoader, ReadsNoSideFileOutsideItsFolder) {
  std::ofstream(folder_ / "secret.bin", std::ios::binary) << square_binary();
  fs::create_symlink(folder_ / "secret.bin", folder_ / "models" / "link.bin");
  fs::create_symlink(folder_, folder_ / "models" / "up");
  fs::create_directory(folder_ / "models" / "folder.bin");
  ASSERT_EQ(mkfifo((folder_ / "models" / "pipe.bin").c_str(), 0600), 0);
  const std::vector<std::string> uris{"../secret.bin",
                                      "%2e%2e/secret.bin",
                                      (folder_ / "secret.bin").string(),
                                      "link.bin",
                                      "up/secret.bin",
                                      "folder.bin",
                                      "pipe.bin",
                                      "",
                                      "missing.bin",
                                      "./../secret.bin",
                                      "/etc/passwd"};
  for (const std::string& uri : uris) {
    SCOPED_TRACE(uri);
    json document = square_json();
    document["buffers"][0]["uri"] = uri;
    expect_refused(load_gltf(write("model.gltf", document.dump())), "");
  }
}

TEST_F(GltfLoader, NamesWhatIsWrongWithThePath) {
  expect_refused(load_gltf(folder_ / "none.glb"), "there is no such file; check the path");
  expect_refused(load_gltf(folder_), "it is not a plain file");
  expect_refused(load_gltf(write("empty.glb", "")), "it is empty");
  expect_refused(load_gltf(write("noise.glb", "not a model at all")), "JSON is broken");
}

TEST_F(GltfLoader, RefusesAFileThatIsTooLarge) {
  const std::string path = write("large.glb", "glTF");
  fs::resize_file(path, (256ULL << 20U) + 1);
  expect_refused(load_gltf(path), "256 MiB");
}

}  // namespace
}  // namespace afm::scene
