// SPDX-License-Identifier: Apache-2.0
// Invariant: tinygltf gets no path and no unchecked member; no stream allocates more than its limit
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
#include "scene/gltf/gltf_loader.h"

namespace afm::scene {
namespace gltf_hostile_test {

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

// Cases refused for their own reasons. A parser that believes the file accepts most of them.
const std::vector<HostileCase>& hostile_cases() {
  static const std::vector<HostileCase> cases{
      {"AccessorWithoutView", "/accessors/0/bufferView is 7", [](json& d) { d["accessors"][0]["bufferView"] = 7; }},
      {"AccessorOffsetIntoNothing", "no bufferView",
       [](json& d) {
         d["accessors"][0].erase("bufferView");
         d["accessors"][0]["byteOffset"] = 4;
       }},
      {"AccessorOfMoreZerosThanMemory", "384 MiB",
       [](json& d) {
         d["accessors"][0].erase("bufferView");
         d["accessors"][0]["count"] = 20'000'000;
       }},
      {"AccessorOffAlignment", "multiple of its component size",
       [](json& d) {
         d["accessors"][0]["byteOffset"] = 2;
         d["accessors"][0]["count"] = 3;
       }},
      {"NormalizedFloats", "normalises", [](json& d) { d["accessors"][0]["normalized"] = true; }},
      {"AccessorTooLong", "/accessors/0 reaches past", [](json& d) { d["accessors"][0]["count"] = 5; }},
      {"AccessorThatBeginsBehindItsView", "/accessors/0 reaches past",
       [](json& d) { d["accessors"][0]["byteOffset"] = 1000; }},
      // (17043522 - 1) x 252 + 12 bytes are 8 in 32 bits
      {"AccessorLongerThan32BitsCount", "/accessors/0 reaches past",
       [](json& d) {
         d["bufferViews"][0]["byteStride"] = 252;
         d["accessors"][0]["count"] = 17'043'522;
       }},
      // the indices 0, 1, 2, 0, ... of the square, read as sparse ones of an accessor of two elements
      {"SparseIndexOnePastTheEnd", "out of range",
       [](json& d) {
         d["accessors"][0]["count"] = 2;
         d["accessors"][0]["sparse"] =
             json::parse(R"({"count": 2, "indices": {"bufferView": 1, "byteOffset": 2, "componentType": 5123},
                             "values": {"bufferView": 0}})");
       }},
      {"AccessorOfFourBillion", "/accessors/0/count is 4000000000",
       [](json& d) { d["accessors"][0]["count"] = 4'000'000'000U; }},
      {"AccessorCountThatOverflows", "/accessors/0/count is",
       [](json& d) { d["accessors"][0]["count"] = 0x1555555555555556ULL; }},
      {"AccessorOffsetThatOverflows", "/accessors/0/byteOffset is",
       [](json& d) { d["accessors"][0]["byteOffset"] = ~0ULL - 11; }},
      {"AccessorOfNothing", "/accessors/0/count is 0", [](json& d) { d["accessors"][0]["count"] = 0; }},
      {"NegativeCount", "/accessors/0/count is -1", [](json& d) { d["accessors"][0]["count"] = -1; }},
      {"NegativeOffset", "/bufferViews/0/byteOffset is -4", [](json& d) { d["bufferViews"][0]["byteOffset"] = -4; }},
      {"UnknownComponentType", "/accessors/0/componentType is 5128",
       [](json& d) { d["accessors"][0]["componentType"] = 5128; }},
      {"StrideTooWide", "reaches past", [](json& d) { d["bufferViews"][0]["byteStride"] = 252; }},
      {"StrideTooNarrow", "overlap", [](json& d) { d["bufferViews"][0]["byteStride"] = 4; }},
      {"ViewPastTheBuffer", "/bufferViews/0 reaches past", [](json& d) { d["bufferViews"][0]["byteLength"] = 64; }},
      {"ViewThatOverflows", "/bufferViews/0/byteOffset is",
       [](json& d) { d["bufferViews"][0]["byteOffset"] = ~0ULL - 3; }},
      {"ViewWithoutBuffer", "/bufferViews/0/buffer is 3", [](json& d) { d["bufferViews"][0]["buffer"] = 3; }},
      {"BufferLongerThanTheFile", "announces 4096 bytes", [](json& d) { d["buffers"][0]["byteLength"] = 4096; }},
      {"BuffersThatFillTheMemory", "announces 104857600 bytes",
       [](json& d) { d["buffers"] = json(20, {{"byteLength", 100U << 20U}}); }},
      {"SparseCountTooLarge", "more sparse elements than elements",
       [](json& d) {
         d["accessors"][0]["sparse"] =
             json::parse(R"({"count": 1000000, "indices": {"bufferView": 1, "componentType": 5123},
                                                      "values": {"bufferView": 0}})");
       }},
      {"AttributeWithoutAccessor", "POSITION is 9",
       [](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9; }},
      {"NegativeAttribute", "POSITION is -2",
       [](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -2; }},
      {"PositionOfIndices", "POSITION of a forbidden type",
       [](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 1; }},
      {"IndicesOfFloats", "indices of a forbidden type",
       [](json& d) { d["meshes"][0]["primitives"][0]["indices"] = 0; }},
      {"SparseWithoutView", "/accessors/0/sparse/values/bufferView is 9",
       [](json& d) {
         d["accessors"][0]["sparse"] = json::parse(R"({"count": 1, "indices": {"bufferView": 1, "componentType": 5123},
                                                "values": {"bufferView": 9}})");
       }},
      {"NameThatIsNoText", "/nodes/0/name is 5, not a string", [](json& d) { d["nodes"][0]["name"] = 5; }},
      {"MatrixBesideAScale", "has both matrix and scale",
       [](json& d) {
         d["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
         d["nodes"][0]["scale"] = {1, 1, 1};
       }},
      {"IndicesWithoutAccessor", "indices is 9", [](json& d) { d["meshes"][0]["primitives"][0]["indices"] = 9; }},
      {"IndexPastTheVertices", "index 3 but only 3", [](json& d) { d["accessors"][0]["count"] = 3; }},
      {"HalfATriangle", "not a whole number", [](json& d) { d["accessors"][1]["count"] = 5; }},
      {"UnknownMode", "mode is 7", [](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 7; }},
      {"MaterialMissing", "material is 4", [](json& d) { d["meshes"][0]["primitives"][0]["material"] = 4; }},
      {"PrimitiveThatIsNoObject", "not an object", [](json& d) { d["meshes"][0]["primitives"] = json::array({1, 2}); }},
      {"MeshMissing", "/nodes/1/mesh is 2", [](json& d) { d["nodes"][1]["mesh"] = 2; }},
      {"ChildMissing", "/nodes/0/children/0 is 8", [](json& d) { d["nodes"][0]["children"] = {8}; }},
      {"NodeThatIsItsOwnChild", "loop", [](json& d) { d["nodes"][0]["children"] = {0}; }},
      {"NodesInALoop", "loop",
       [](json& d) {
         d["nodes"].push_back({{"children", {3}}});
         d["nodes"].push_back({{"children", {2}}});
       }},
      {"NodeWithTwoParents", "/nodes/2 'rack' has the child 1 'surface', which has more than one parent",
       [](json& d) { d["nodes"].push_back({{"name", "rack"}, {"children", {1}}}); }},
      {"SceneMissing", "/scene is 5", [](json& d) { d["scene"] = 5; }},
      {"SceneWithMissingNode", "/scenes/0/nodes/0 is 9", [](json& d) { d["scenes"][0]["nodes"] = {9}; }},
      {"SceneWithAChild", "not a root", [](json& d) { d["scenes"][0]["nodes"] = {0, 1}; }},
      {"MatrixOfThree", "/nodes/0/matrix is a list of 3", [](json& d) { d["nodes"][0]["matrix"] = {1, 0, 0}; }},
      {"MatrixWithPerspective", "not affine",
       [](json& d) { d["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }},
      {"ZeroQuaternion", "unit quaternion", [](json& d) { d["nodes"][0]["rotation"] = {0, 0, 0, 0}; }},
      {"FactorOutOfRange", "metallicFactor is 7, not a number of 0 to 1",
       [](json& d) { d["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 7; }},
      {"EmissiveStrengthAsText", "emissiveStrength",
       [](json& d) { d["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = "x"; }},
      {"RequiredExtension", "requires 'KHR_materials_transmission', which",
       [](json& d) { d["extensionsRequired"] = {"KHR_materials_unlit", "KHR_materials_transmission"}; }},
      {"ControlSequence", "'?[2J", [](json& d) { d["extensionsRequired"] = {"\x1B[2J\r\n"}; }},
      {"OldVersion", "version '1.0'", [](json& d) { d["asset"]["version"] = "1.0"; }},
      {"NoAsset", "has no 'asset'", [](json& d) { d.erase("asset"); }},
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
    expect_refused(load(square_json(), binary), "not finite");
  }
}

TEST_F(HostileGltf, IsRefusedForAnIndexThatRestartsThoughThereIsSuchAVertex) {
  json document = square_json();
  document["accessors"][0] = {{"componentType", 5126}, {"count", 65536}, {"type", "VEC3"}};
  std::string binary = square_binary();
  EXPECT_TRUE(load(document, binary.replace(48, 2, "\xFE\xFF")));
  expect_refused(load(document, binary.replace(48, 2, "\xFF\xFF")), "index 65535, which would restart");
  document["accessors"][1]["componentType"] = 5121;
  expect_refused(load(document, binary), "index 255, which would restart");
}

TEST_F(HostileGltf, IsRefusedForNumbersBeyondDouble) {
  std::string text = square_json().dump();
  const std::string name = R"("name":"sample")";
  text.replace(text.find(name), name.size(), R"("translation":[1e999,0,0])");
  expect_refused(load_bytes(glb(text, square_binary())), "JSON is invalid");
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
  expect_refused(load_bytes(with(8, 40)), "its header announces 40 bytes");
  expect_refused(load_bytes(with(12, 0xFFFFFFF0)), "a chunk extends past its end");
  expect_refused(load_bytes(with(16, 0x004E4942)), "not JSON");
  // the chunk's own header counts too
  expect_refused(load_bytes(with(binary_chunk, 68)), "a chunk extends past its end");
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
  expect_refused(load_gltf(folder_), "it is not a regular file");
  expect_refused(load_gltf(write("empty.glb", "")), "it is empty");
  expect_refused(load_gltf(write("noise.glb", "not a model at all")), "it is not glTF");
}

TEST_F(HostileGltf, IsRefusedForAFileThatIsTooLarge) {
  const std::string path = write("large.glb", "glTF");
  fs::resize_file(path, (256ULL << 20U) + 1);
  expect_refused(load_gltf(path), "256 MiB");
}

// Errors in the extensions and in parts other than meshes and nodes: the square with more in it.
json rich_json() {
  json d = square_json();
  d["accessors"].push_back({{"componentType", 5126}, {"count", 4}, {"type", "VEC4"}});    // 2
  d["accessors"].push_back({{"componentType", 5121}, {"count", 4}, {"type", "VEC4"}});    // 3
  d["accessors"].push_back({{"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}});  // 4
  d["accessors"].push_back({{"componentType", 5126}, {"count", 1}, {"type", "VEC3"}});    // accessor 5
  d["accessors"].push_back({{"componentType", 5126}, {"count", 1}, {"type", "MAT4"}});    // 6
  d["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = 3;
  d["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = 2;
  d["skins"] = json::array({{{"joints", {0}}, {"inverseBindMatrices", 6}}});
  d["nodes"][1]["skin"] = 0;
  d["animations"] =
      json::array({{{"samplers", {{{"input", 4}, {"output", 5}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}});
  d["cameras"] = json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}});
  return d;
}

const std::vector<HostileCase>& rich_cases() {
  static const std::vector<HostileCase> cases{
      {"JointMissing", "joints/0 is 7", [](json& d) { d["skins"][0]["joints"] = {7}; }},
      {"SkinMissing", "/nodes/1/skin is 3", [](json& d) { d["nodes"][1]["skin"] = 3; }},
      {"SkinWithoutJoints", "/skins/0/joints is a list of 0", [](json& d) { d["skins"][0]["joints"] = json::array(); }},
      {"SkinWithoutMesh", "a skin but no mesh", [](json& d) { d["nodes"][0]["skin"] = 0; }},
      {"TooFewInverseBindMatrices", "for each joint", [](json& d) { d["skins"][0]["joints"] = {0, 1}; }},
      {"InverseBindMatricesOfVectors", "for each joint", [](json& d) { d["skins"][0]["inverseBindMatrices"] = 2; }},
      {"WeightsWithoutJoints", "without joints",
       [](json& d) { d["meshes"][0]["primitives"][0]["attributes"].erase("JOINTS_0"); }},
      {"AnimationOfMissingNode", "target/node is 9",
       [](json& d) { d["animations"][0]["channels"][0]["target"]["node"] = 9; }},
      {"AnimationOfMissingSampler", "sampler that does not exist",
       [](json& d) { d["animations"][0]["channels"][0]["sampler"] = 1; }},
      {"AnimationOfWrongWidth", "output values", [](json& d) { d["animations"][0]["samplers"][0]["output"] = 4; }},
      {"AnimationOfTimesThatAreMatrices", "not floats",
       [](json& d) { d["animations"][0]["samplers"][0]["input"] = 6; }},
      {"AnimationOfUnknownInterpolation", "interpolation",
       [](json& d) { d["animations"][0]["samplers"][0]["interpolation"] = "BEZIER"; }},
      {"AnimationOfAMatrix", "is animated but has a matrix",
       [](json& d) { d["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }},
      {"AnimationOfMorphsThatAreNone", "animates a property that its node lacks",
       [](json& d) { d["animations"][0]["channels"][0]["target"]["path"] = "weights"; }},
      {"CameraMissing", "/nodes/0/camera is 4", [](json& d) { d["nodes"][0]["camera"] = 4; }},
      {"CameraWithoutAngle", "yfov is 0", [](json& d) { d["cameras"][0]["perspective"]["yfov"] = 0; }},
      {"CameraWithoutHeight", "/cameras/0/orthographic/ymag is 0",
       [](json& d) {
         d["cameras"][0] = {{"type", "orthographic"},
                            {"orthographic", {{"xmag", 1}, {"ymag", 0}, {"znear", 1}, {"zfar", 2}}}};
       }},
      {"CameraOfBothKinds", "both orthographic and perspective",
       [](json& d) { d["cameras"][0]["orthographic"] = {{"xmag", 1}, {"ymag", 1}, {"znear", 1}, {"zfar", 2}}; }},
      {"TargetsOfUnequalCount", "TANGENT",
       [](json& d) { d["meshes"][0]["primitives"][0]["targets"] = {{{"TANGENT", 5}, {"POSITION", 0}}}; }},
      {"WeightsOfNoTarget", "different numbers of weights and morph targets",
       [](json& d) { d["meshes"][0]["weights"] = {1}; }},
      {"TextureMissing", "index is 0", [](json& d) { d["materials"][0]["normalTexture"] = {{"index", 0}}; }},
      {"ImageMissing", "source is 2", [](json& d) { d["textures"] = json::array({{{"source", 2}}}); }},
      {"UnknownAlphaMode", "alphaMode", [](json& d) { d["materials"][0]["alphaMode"] = "GLASS"; }},
      {"LightMissing", "light is 0", [](json& d) { d["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0; }},
      {"VariantMissing", "variants/0 is 0",
       [](json& d) {
         d["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
             {{"material", 0}, {"variants", {0}}}};
       }},
      {"InstancesOfUnequalCount", "different counts",
       [](json& d) {
         d["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 0}, {"SCALE", 5}};
       }},
      {"UnknownRole", "role", [](json& d) { d["nodes"][0]["extras"]["touchafm"]["role"] = "laser"; }},
      {"MeshoptCountTooLarge", "inconsistent count, byteStride and filter",
       [](json& d) {
         d["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
             {"buffer", 0}, {"byteLength", 48}, {"byteStride", 12}, {"count", 200000000}, {"mode", "ATTRIBUTES"}};
       }},
      {"MeshoptGarbage", "corrupt compressed stream",
       [](json& d) {
         d["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
             {"buffer", 0}, {"byteLength", 48}, {"byteStride", 12}, {"count", 4}, {"mode", "ATTRIBUTES"}};
       }},
      {"DracoGarbage", "not a mesh of bitstream 2.2",
       [](json& d) {
         d["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
             {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
       }},
  };
  return cases;
}

TEST_F(HostileGltf, IsRefusedForWhatIsWrongBesideItsMeshes) {
  const core::Result<Scene> sound = load(rich_json());
  ASSERT_TRUE(sound) << sound.error().message;
  for (const HostileCase& hostile : rich_cases()) {
    SCOPED_TRACE(hostile.name);
    json document = rich_json();
    hostile.spoil(document);
    expect_refused(load(document), hostile.reason);
  }
}

json with_image(const std::string& uri) {
  json document = square_json();
  document["images"] = json::array({{{"uri", uri}}});
  document["textures"] = json::array({{{"source", 0}}});
  document["materials"][0]["emissiveTexture"] = {{"index", 0}};
  return document;
}

TEST_F(HostileGltf, IsRefusedForImagesThatAreNone) {
  std::string bomb = tiny_png();
  bomb.replace(16, 8, std::string("\0\0\xFF\xFF\0\0\xFF\xFF", 8));
  write("bomb.png", bomb);
  expect_refused(load(with_image("bomb.png")), "65535 x 65535 pixels");
  write("cut.png", tiny_png().substr(0, 50));
  expect_refused(load(with_image("cut.png")), "/images/0 'cut.png' cannot be decoded: its PNG data is corrupt");
  write("cut.jpg", "\xFF\xD8\xFF\xE0 and nothing more");
  expect_refused(load(with_image("cut.jpg")), "its JPEG header is corrupt");
  write("text.png", "not an image at all");
  expect_refused(load(with_image("text.png")), "neither PNG nor JPEG");
  expect_refused(load(with_image("data:image/png;base64,####")), "invalid base64");
}

// Drawn without it, and never read.
TEST_F(HostileGltf, ReadsNoImageOutsideItsFolder) {
  for (const char* uri : {"missing.png", "../../../../etc/passwd", "/etc/passwd", "..\\..\\secret.png"}) {
    GltfWarnings notes;
    std::ofstream(folder_ / "secret.png", std::ios::binary) << tiny_png();
    const auto scene = load_gltf(write("model.glb", glb(with_image(uri).dump(), square_binary())), &notes);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->images.empty()) << uri;
    EXPECT_THAT(notes.missing, testing::ElementsAre(HasSubstr("not a regular file in the model's folder")));
  }
}

}  // namespace gltf_hostile_test
}  // namespace afm::scene
