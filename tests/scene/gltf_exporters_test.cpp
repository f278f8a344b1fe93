// SPDX-License-Identifier: Apache-2.0
// Files as people have them: what exporters round, list and leave empty, what is missing beside a model, and other
// formats under its name.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "gltf_document.h"
#include "support/places.h"

namespace afm::scene {
namespace gltf_exporters_test {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Exporters : public GltfFolder {
 protected:
  // Scene with the notes of this call.
  Scene drawn(const json& document, const std::string& binary = square_binary()) {
    notes_ = {};
    auto scene = load_gltf(write("model.glb", glb(document.dump(), binary)), &notes_);
    EXPECT_TRUE(scene) << scene.error().message;
    return scene.value_or(Scene{});
  }
  core::Result<Scene> given(const std::string& name) {
    notes_ = {};
    return load_gltf(support::source("tests/scene/data/exporters/" + name), &notes_);
  }
  void expect_named(const std::string& bytes, const std::string& kind) const {
    expect_refused(load_bytes(bytes), kind);
  }

  GltfWarnings notes_;
};

TEST_F(Exporters, DrawsFactorsThatAreRounded) {
  for (const auto& [name, note] : std::vector<std::pair<std::string, std::string>>{
           {"colour-one-ulp-above-one.gltf",
            "/materials/0/pbrMetallicRoughness/baseColorFactor/0 is 1.0000001192092896: "
            "drawn as 1"},
           {"alpha-one-ulp-above-one.gltf", "baseColorFactor/3 is 1.0000001192092896: drawn as 1"},
           {"roughness-rounding.gltf", "roughnessFactor is 1.0000000000000002: drawn as 1"},
       }) {
    const auto scene = given(name);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(notes_.corrected, ElementsAre(HasSubstr(note)));
    EXPECT_LE(scene->materials[0].base_color.r, 1.0F);
    EXPECT_LE(scene->materials[0].base_color.a, 1.0F);
    EXPECT_LE(scene->materials[0].roughness, 1.0F);
  }
}

// Members without a value, as written by libraries of C#.
TEST_F(Exporters, TakesNullAsAbsent) {
  json document = square_json();
  document["animations"] = nullptr;
  document["nodes"][1]["name"] = nullptr;
  document["materials"][0]["pbrMetallicRoughness"] = {{"baseColorFactor", nullptr}};
  document["extras"] = {{"kept", nullptr}};
  EXPECT_EQ(drawn(document).materials.size(), 1U);
  document["nodes"][0]["children"] = {nullptr};
  expect_refused(load_bytes(glb(document.dump(), square_binary())), "/nodes/0/children/0");
}

TEST_F(Exporters, NamesAVersionThatIsNeeded) {
  json document = square_json();
  document["asset"]["minVersion"] = "3.0";
  expect_refused(load_bytes(glb(document.dump(), square_binary())), "a reader of glTF '3.0'");
  std::string bytes = glb(square_json().dump(), square_binary());
  bytes.replace(8, 4, 4, '\0');
  expect_refused(load_bytes(bytes), "its header announces 0 bytes");
}

TEST_F(Exporters, ClampsEveryFactorThatIsOffByOnePerCent) {
  struct Row {
    const char* path;
    double off, used;
  };
  json document = square_json();
  document["extensions"]["KHR_lights_punctual"]["lights"] = json::array(
      {{{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 1.0}}}, {"color", {1, 1, 1}}}});
  for (const Row& row :
       std::vector<Row>{{"/materials/0/pbrMetallicRoughness/metallicFactor", 1.0099, 1},
                        {"/materials/0/pbrMetallicRoughness/metallicFactor", -1e-9, 0},
                        {"/materials/0/pbrMetallicRoughness/roughnessFactor", -0.0099, 0},
                        {"/materials/0/alphaCutoff", -1e-9, 0},
                        {"/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor", 1.00016, 1},
                        {"/materials/0/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", 1.00016, 1},
                        {"/materials/0/extensions/KHR_materials_specular/specularFactor", 1.00016, 1},
                        {"/materials/0/extensions/KHR_materials_iridescence/iridescenceFactor", 1.00016, 1},
                        {"/materials/0/extensions/KHR_materials_iridescence/iridescenceIor", 0.9999999, 1},
                        {"/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", -1e-9, 0},
                        {"/materials/0/extensions/KHR_materials_ior/ior", 0.9999999, 1},
                        {"/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", 1.57079637, 1.5708},
                        {"/extensions/KHR_lights_punctual/lights/0/intensity", -1e-9, 0}}) {
    SCOPED_TRACE(row.path);
    json rounded = document;
    rounded[json::json_pointer(row.path)] = row.off;
    drawn(rounded);
    ASSERT_EQ(notes_.corrected.size(), 1U);
    EXPECT_THAT(notes_.corrected[0], HasSubstr(": drawn as "));
    rounded[json::json_pointer(row.path)] = row.off > 1 ? 1.6 : row.off < 0.5 ? -0.02 : 0.9;
    expect_refused(load(rounded), "");
  }
}

TEST_F(Exporters, NarrowsAnInnerConeThatEqualsTheOuterOne) {
  json document = square_json();
  document["extensions"]["KHR_lights_punctual"]["lights"] =
      json::array({{{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}}}}});
  const Scene scene = drawn(document);
  EXPECT_LT(scene.lights[0].inner_cone_rad, scene.lights[0].outer_cone_rad);
  EXPECT_THAT(notes_.corrected, ElementsAre(HasSubstr("equal cones")));
}

TEST_F(Exporters, ClampsLightThatASurfaceEmits) {
  const auto scene = given("emissive-above-one.gltf");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->materials[0].emissive, glm::vec3(1, 1, 0));
  EXPECT_THAT(notes_.corrected, ElementsAre(HasSubstr("/materials/0/emissiveFactor/0 is 3"), HasSubstr("1 is 1.5")));
  json document = square_json();
  document["materials"][0]["emissiveFactor"] = {-1, 0, 0};
  expect_refused(load(document), "emissiveFactor/0 is -1");
}

TEST_F(Exporters, DrawsAListedChildWhoseParentIsInNoScene) {
  const auto scene = given("scene-lists-a-child.gltf");
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->nodes.size(), 1U);
  EXPECT_TRUE(scene->nodes[0].mesh);
  EXPECT_EQ(notes_.empty, "");
  EXPECT_THAT(notes_.corrected, ElementsAre(HasSubstr("/scenes/0 lists the node 1, whose parent it does not list")));
  json document = square_json();
  document["scenes"][0]["nodes"] = {0, 1};
  expect_refused(load(document), "not a root");
  document["scenes"][0]["nodes"] = {1, 1};
  expect_refused(load(document), "listed twice");
}

TEST_F(Exporters, DrawsBesideEmptyPartsThatNothingUses) {
  const auto scene = given("unused-empty-view.gltf");
  ASSERT_TRUE(scene) << scene.error().message;
  for (const char* part :
       {R"({"bufferViews": {"buffer": 0, "byteOffset": 60, "byteLength": 0}})",
        R"({"bufferViews": {"buffer": 0, "byteOffset": 4000, "byteLength": 0}})",
        R"({"accessors": {"bufferView": 0, "componentType": 5126, "count": 0, "type": "VEC3"}})",
        R"({"accessors": {"componentType": 5123, "count": 0, "type": "SCALAR", "min": [], "max": []}})",
        R"({"meshes": {"name": "nothing", "primitives": []}})", R"({"buffers": {"byteLength": 0}})",
        R"({"buffers": {"byteLength": 0, "uri": "nothing.bin"}})", R"({"skins": {"joints": []}})", R"({"images": {}})",
        R"({"textures": {}})", R"({"samplers": {}})", R"({"materials": {}})",
        R"({"animations": {"channels": [], "samplers": []}})", R"({"scenes": {"nodes": []}})", R"({"nodes": {}})"}) {
    SCOPED_TRACE(part);
    json document = square_json();
    const json added = json::parse(part);
    document[added.begin().key()].push_back(added.begin().value());
    EXPECT_EQ(drawn(document).meshes[0].primitives.size(), 1U);
  }
}

TEST_F(Exporters, DrawsBesideAMeshOfNothingThatNoNodeUses) {
  json document = square_json();
  document["accessors"].push_back({{"bufferView", 0}, {"componentType", 5126}, {"count", 0}, {"type", "VEC3"}});
  document["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 2}}}}}}});
  EXPECT_EQ(drawn(document).meshes.size(), 2U);
  EXPECT_THAT(notes_.ignored, ElementsAre(HasSubstr("/meshes/1: no node uses it, and it cannot be read")));
  document["nodes"][0]["mesh"] = 1;
  expect_refused(load(document), "/accessors/2/count is 0");
}

TEST_F(Exporters, RefusesAnEmptyPartThatIsUsed) {
  json document = square_json();
  document["bufferViews"][0]["byteLength"] = 0;
  expect_refused(load(document), "/accessors/0 reaches past the end of its buffer view");
  document = square_json();
  document["buffers"][0]["byteLength"] = 0;
  expect_refused(load(document), "refers to a buffer without data");
  document = square_json();
  document["skins"] = json::array({{{"joints", json::array()}}});
  document["nodes"][1]["skin"] = 0;
  expect_refused(load(document), "/skins/0/joints is a list of 0");
}

TEST_F(Exporters, SaysThatNothingIsShownAndWhichSceneWasTaken) {
  ASSERT_TRUE(given("empty-scene.gltf"));
  EXPECT_EQ(notes_.empty, "scene 0 'Scene' has no node with a mesh");
  json document = square_json();
  document["nodes"][1].erase("mesh");
  drawn(document);
  EXPECT_EQ(notes_.empty, "scene 0 has no node with a mesh");
  document = square_json();
  document["meshes"][0]["primitives"][0]["attributes"].erase("POSITION");
  drawn(document);
  EXPECT_EQ(notes_.empty, "scene 0 has only meshes that cannot be drawn");
  document = square_json();
  document["nodes"][0]["scale"] = {0, 0, 0};
  document["nodes"][1]["scale"] = {0, 0, 0};
  drawn(document);
  EXPECT_EQ(notes_.empty, "scene 0 has only meshes without size");
  document["nodes"][0]["scale"] = document["nodes"][1]["scale"] = {1, 0, 0};
  drawn(document);
  EXPECT_EQ(notes_.empty, "");
  drawn(json::parse(R"({"asset": {"version": "2.0"}, "bufferViews": [], "buffers": []})"));
  EXPECT_EQ(notes_.empty, "the file, which lists no scene, has no node with a mesh");
  drawn(square_json());
  EXPECT_EQ(notes_.empty, "");
}

TEST_F(Exporters, DrawsWithoutAnImageThatIsNotThere) {
  for (const auto& [name, image] : std::vector<std::pair<std::string, std::string>>{
           {"texture-missing.gltf", "/images/0: it refers to '"}, {"texture-in-parent-folder.gltf", "'../"}}) {
    const auto scene = given(name);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(notes_.missing, ElementsAre(HasSubstr(image)));
    EXPECT_FALSE(scene->materials[0].texture(TextureSlot::BaseColor).texture);
    EXPECT_TRUE(scene->images.empty() && scene->textures.empty());
  }
  // one of two members is present
  json document = square_json();
  document["images"] = json::array({{{"uri", "C:\\work\\red.png"}}, {{"uri", "tex\\red.png"}}});
  document["textures"] = json::array({{{"source", 0}}, {{"source", 1}}});
  document["materials"][0]["normalTexture"] = {{"index", 0}};
  document["materials"][0]["emissiveTexture"] = {{"index", 1}};
  std::filesystem::create_directories(folder_ / "models" / "tex");
  write("tex/red.png", tiny_png());
  const Scene scene = drawn(document);
  EXPECT_THAT(notes_.missing, ElementsAre(HasSubstr("C:\\work\\red.png")));
  ASSERT_EQ(scene.images.size(), 1U);
  EXPECT_EQ(scene.images[0].width, 1U);
  EXPECT_FALSE(scene.materials[0].texture(TextureSlot::Normal).texture);
  EXPECT_EQ(scene.materials[0].texture(TextureSlot::Emissive).texture, 0U);
}

TEST_F(Exporters, NamesAnImageOfAnotherFormat) {
  const auto named = [](const core::Result<Scene>& scene) { return scene ? "drawn" : scene.error().message; };
  EXPECT_THAT(named(given("ktx2-as-plain-source.gltf")),
              AllOf(HasSubstr("/images/0"), HasSubstr("it is a KTX2 image; export the model with PNG or JPEG images")));
  json document = square_json();
  document["images"] = json::array({{{"uri", "image"}}});
  document["textures"] = json::array({{{"source", 0}}});
  document["materials"][0]["emissiveTexture"] = {{"index", 0}};
  for (const auto& [bytes, kind] : std::vector<std::pair<std::string, std::string>>{
           {std::string("RIFF\x10\0\0\0WEBPVP8 ", 16), "a WebP image"},
           {"DDS \x7C", "a DDS image"},
           {"version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "a Git LFS pointer"},
           {"GIF89a", "a GIF image"},
           {"<!DOCTYPE html><html>", "an HTML page"},
           {"", "empty"}}) {
    write("image", bytes);
    expect_refused(load(document), "/images/0 'image' cannot be decoded: it is " + kind);
  }
}

TEST_F(Exporters, NamesAFileOfAnotherFormat) {
  const auto named = [](const core::Result<Scene>& scene) { return scene ? "drawn" : scene.error().message; };
  EXPECT_THAT(named(given("stl-named.stl")), AllOf(HasSubstr("an STL file"), HasSubstr("export glTF 2.0")));
  EXPECT_THAT(named(given("lfs-pointer.glb")), AllOf(HasSubstr("a Git LFS pointer"), HasSubstr("git lfs pull")));
  EXPECT_THAT(named(given("compressed.gltf")), AllOf(HasSubstr("a gzip file"), HasSubstr("unpack it")));
  std::string stl(84 + 2 * 50, 'x');
  stl.replace(80, 4, std::string("\x02\0\0\0", 4));
  for (const auto& [bytes, kind] : std::vector<std::pair<std::string, std::string>>{
           {stl, "an STL file"},
           {"solid cube\n facet normal 0 0 1\n", "an STL file"},
           {"# made by hand\r\n\r\n# two\nmtllib cube.mtl\nv 0 0 0\n", "an OBJ file"},
           {"v 0 0 0\nv 1 0 0\n", "an OBJ file"},
           {"ply\nformat ascii 1.0\n", "a PLY file"},
           {"ISO-10303-21;\nHEADER;", "a STEP file"},
           {"Kaydara FBX Binary  ", "an FBX file"},
           {"; FBX 7.3.0 project file", "an FBX file"},
           {"PK\x03\x04 usdz", "a ZIP archive"},
           {"#VRML V2.0 utf8", "a VRML file"},
           {"#usda 1.0", "a USD file"},
           {"<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"x\">", "a COLLADA file"},
           {"\n  <!DOCTYPE html>\n<html>", "an HTML page"},
           {"<HTML><head>", "an HTML page"},
           {std::string("\xFF\xFE{\0\"\0", 6), "a text in UTF-16"},
           {std::string("\0{\0\"", 4), "a text in UTF-16"},
           {tiny_png(), "a PNG image"},
           {"BLENDER-v300", "a Blender file"}}) {
    expect_named(bytes, kind);
  }
  EXPECT_TRUE(load_gltf(write("mark.gltf",
                              "\xEF\xBB\xBF "
                              R"({"asset": {"version": "2.0"}})")));
}

TEST_F(Exporters, QuotesTheBeginningOfATextThatIsNotGltf) {
  expect_named("ATOM      1  N   ALA A   1\n", "it is not glTF: it begins with 'ATOM      1 '");
  expect_named("3\nxyz\nC 0 0 0\n", "it begins with '3', neither with '{'");
  expect_named(" \n\t", "it has only blanks");
}

// A validator finds no fault in such a file, so that the message sends nobody there.
TEST_F(Exporters, SaysThatALimitIsItsOwn) {
  const auto too_large = [&](const json& document, const std::string& place) {
    const auto scene = load(document);
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, AllOf(HasSubstr(place), HasSubstr("at most; make the model smaller"),
                                             testing::Not(HasSubstr("gltf-validator"))));
  };
  json document = square_json();
  document["buffers"][0]["byteLength"] = 300'000'000;
  too_large(document, "/buffers/0/byteLength is 300000000, of which TouchAFM reads 268435456");
  document = square_json();
  document["accessors"][0]["count"] = 25'000'000;
  too_large(document, "/accessors/0/count is 25000000, of which TouchAFM reads 24000000");
  document = square_json();
  for (std::size_t i = 0; i < 17'000; ++i) document["materials"][i]["name"] = "m";
  too_large(document, "/materials is a list of 17000, of which TouchAFM reads 16384");
  document = square_json();
  document["buffers"][0]["byteLength"] = -1;
  expect_refused(load(document), "byteLength is -1, not a whole number of 0 to 268435456; export it again");
}

TEST_F(Exporters, SaysThatAMeshIsTooLargeToBeFramed) {
  json document = square_json();
  document["nodes"][1]["scale"] = {1e30, 1e30, 1e30};
  document["nodes"][0]["scale"] = {1e10, 1e10, 1e10};
  drawn(document);
  EXPECT_EQ(notes_.empty, "scene 0 has a mesh larger than 1e37 m: scale it down");
}

TEST_F(Exporters, IgnoresBytesBehindTheAnnouncedEnd) {
  const auto scene = given("bytes-behind-the-end.glb");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(notes_.empty, "");
  const std::string whole = glb(square_json().dump(), square_binary());
  EXPECT_TRUE(load_bytes(whole + std::string(1000, '\x7F')));
  expect_refused(load_bytes(whole.substr(0, whole.size() - 1)), "it is cut off");
}

}  // namespace gltf_exporters_test
}  // namespace afm::scene
