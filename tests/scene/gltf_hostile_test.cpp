// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "gltf_document.h"
#include "scene/gltf_loader.h"

namespace afm::scene {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class HostileGltf : public GltfFolder {};

struct HostileCase {
  const char* name;
  const char* reason;
  std::function<void(json&)> spoil;
};

// tinygltf 2.7 accepts nearly all of these.
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
      {"ControlSequence", "'?[2J", [](json& d) { d["extensionsRequired"] = {"\x1B[2J\r\n"}; }},
      {"OldVersion", "version '1.0'", [](json& d) { d["asset"]["version"] = "1.0"; }},
      {"NoAsset", "parser", [](json& d) { d.erase("asset"); }},
  };
  return cases;
}

TEST_F(HostileGltf, IsRefusedWithAReason) {
  for (const HostileCase& hostile : hostile_cases()) {
    SCOPED_TRACE(hostile.name);
    json document = square_json();
    hostile.spoil(document);
    expect_refused(load(document), hostile.reason);
  }
}

TEST_F(HostileGltf, IsRefusedForPositionsThatAreNotFinite) {
  for (const std::uint32_t bits : {0x7F800000U, 0x7FC00000U}) {
    std::string binary = square_binary();
    for (std::size_t i = 0; i < 4; ++i) binary[16 + i] = static_cast<char>(bits >> (8 * i));
    expect_refused(load(square_json(), binary), "not a finite number");
  }
}

TEST_F(HostileGltf, IsRefusedForNumbersBeyondDouble) {
  std::string text = square_json().dump();
  const std::string name = R"("name":"sample")";
  text.replace(text.find(name), name.size(), R"("translation":[1e999,0,0])");
  expect_refused(load_bytes(glb(text, square_binary())), "JSON is broken");
}

TEST_F(HostileGltf, IsRefusedForDeepNestingWithoutOverflowingTheStack) {
  const std::string deep =
      R"({"asset":{"version":"2.0"},"extras":)" + std::string(200'000, '[') + std::string(200'000, ']') + "}";
  expect_refused(load_bytes(glb(deep, "")), "nested deeper");
  expect_refused(load_gltf(write("deep.gltf", deep)), "nested deeper");
}

TEST_F(HostileGltf, IsRefusedForEveryTruncation) {
  const std::string whole = glb(square_json().dump(), square_binary());
  for (std::size_t size = 0; size < whole.size(); size += 7) expect_refused(load_bytes(whole.substr(0, size)), "");
}

TEST_F(HostileGltf, IsRefusedForWrongHeadersAndChunks) {
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

TEST_F(HostileGltf, SurvivesAFlippedByteAnywhere) {
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

TEST_F(HostileGltf, ReadsNoSideFileOutsideItsFolder) {
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

TEST_F(HostileGltf, NamesWhatIsWrongWithThePath) {
  expect_refused(load_gltf(folder_ / "none.glb"), "there is no such file; check the path");
  expect_refused(load_gltf(folder_), "it is not a plain file");
  expect_refused(load_gltf(write("empty.glb", "")), "it is empty");
  expect_refused(load_gltf(write("noise.glb", "not a model at all")), "JSON is broken");
}

TEST_F(HostileGltf, IsRefusedForAFileThatIsTooLarge) {
  const std::string path = write("large.glb", "glTF");
  fs::resize_file(path, (256ULL << 20U) + 1);
  expect_refused(load_gltf(path), "256 MiB");
}

}  // namespace
}  // namespace afm::scene
