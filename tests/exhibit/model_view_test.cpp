// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/model_view.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <stop_token>
#include <thread>
#include <utility>

#include "exhibit/models/particle_models.h"
#include "exhibit/models/user_models.h"
#include "scene/gltf/loading_notice.h"
#include "scene/graph/height_field.h"
#include "scene/graph/pose.h"
#include "support/scratch_folder.h"

namespace afm::exhibit {
namespace model_view_test {

using testing::HasSubstr;

// A square from (0, 0, 0) to (1, 1, 0); positions of 48 bytes and six 8-bit indices, without padding, in base64.
constexpr const char* kBuffers =
    R"("buffers": [{"byteLength": 54, "uri": "data:application/octet-stream;base64,)"
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAECAAID"
    R"("}], "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 6}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5121, "count": 6, "type": "SCALAR"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0,
      "extensions": {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [0]}]}}}]}],
    "materials": [{"name": "plain"}, {"name": "golden"}],
    "extensions": {"KHR_materials_variants": {"variants": [{"name": "Gold"}]}},
    "extensionsUsed": ["KHR_materials_variants", "KHR_materials_sheen"],
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], )";

class OwnModel : public testing::Test {
 protected:
  std::string write(const std::string& nodes) { return folder_.write("model.gltf", "{" + (kBuffers + nodes) + "}"); }

  support::ScratchFolder folder_;
};

TEST_F(OwnModel, IsSeenWholeByTheAutomaticCameraWhateverItsSize) {
  for (const double size : {1e-9, 1.0, 1e9}) {
    std::ostringstream node;
    node << R"("nodes": [{"mesh": 0, "scale": [)" << size << "," << size << "," << size << "]}]";
    const auto view = open_model({.file = write(node.str())});
    ASSERT_TRUE(view) << view.error().message;
    for (const scene::EyeView& eye : view->frame.eyes) {
      for (const glm::dvec4 corner : {glm::dvec4(0, 0, 0, 1), glm::dvec4(1, 1, 0, 1)}) {
        const glm::dvec4 clip = eye.projection * eye.view * view->frame.room_from_node[0] * corner;
        EXPECT_GT(clip.w, 0.0);
        EXPECT_LT(std::abs(clip.x), clip.w) << size;
        EXPECT_LT(std::abs(clip.y), clip.w) << size;
      }
    }
  }
}

// The models of the wall have them: a beam of light is a tube 2 m wide until it is stretched.
TEST_F(OwnModel, IsSeenWithoutTheMarksThatOnlyTheWallStretches) {
  const std::string mark = R"({"mesh": 0, "scale": [100, 100, 100], "extras": {"touchafm": {"role": "mark"}}})";
  const auto alone = open_model({.file = write(R"("nodes": [{"children": [1]}, {"mesh": 0}])")});
  const auto with_mark = open_model({.file = write(R"("nodes": [{"children": [1, 2]}, {"mesh": 0}, )" + mark + "]")});
  ASSERT_TRUE(alone && with_mark);
  EXPECT_EQ(with_mark->frame.room_from_node[1], alone->frame.room_from_node[1]);
  EXPECT_EQ(with_mark->frame.visible, (std::vector<std::uint8_t>{1, 1, 0}));
  const auto nothing_else = open_model({.file = write(R"("nodes": [{"children": [1]}, )" + mark + "]")});
  ASSERT_TRUE(nothing_else) << nothing_else.error().message;
  EXPECT_EQ(nothing_else->frame.visible, (std::vector<std::uint8_t>{1, 1}));
}

constexpr double kToleranceOfFile = 1e-7;  // a camera's angle is read as a 32-bit float

TEST_F(OwnModel, IsSeenByItsOwnCameras) {
  const std::string path = write(
      R"("cameras": [{"type": "perspective", "name": "front", "perspective": {"yfov": 1.5707963267948966, "znear": 0.1}},
                     {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 2, "znear": 0, "zfar": 9}}],
         "nodes": [{"children": [1, 2, 3]}, {"mesh": 0}, {"camera": 0, "translation": [0.5, 0.5, 2]},
                   {"camera": 1, "name": "plan", "translation": [0, 0, 2]}])");
  const auto place = [&](const ModelView& view, double x, double y) {
    const glm::dvec4 clip =
        view.frame.eyes[0].projection * view.frame.eyes[0].view * view.frame.room_from_node[1] * glm::dvec4(x, y, 0, 1);
    return glm::dvec3(clip) / clip.w;
  };
  const auto front = open_model({.file = path, .camera = "front", .size_px = {400, 200}, .eyes_apart_m = 0.0});
  ASSERT_TRUE(front) << front.error().message;
  EXPECT_NEAR(place(*front, 0.5, 0.5).x, 0.0, 1e-9);
  EXPECT_NEAR(place(*front, 0.5, 1.0).y, -0.25, kToleranceOfFile)
      << "half a metre above the axis at two metres, 90 degrees";
  EXPECT_NEAR(place(*front, 1.0, 0.5).x, 0.125, kToleranceOfFile);

  const auto plan = open_model({.file = path, .camera = "plan", .size_px = {400, 200}});
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_NEAR(place(*plan, 0, 1).y, -0.5, 1e-6);
  EXPECT_NEAR(place(*plan, 1, 0).x, 0.25, 1e-6);
  EXPECT_NEAR(place(*plan, 0, 0).z, 7.0 / 9.0, 1e-6) << "reversed depth: 1 near, 0 far";
  EXPECT_EQ(plan->frame.eyes[0].view, plan->frame.eyes[1].view);

  const auto missing = open_model({.file = path, .camera = "side"});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_THAT(missing.error().message, HasSubstr(R"(it has "front", "plan", and there is auto)"));
}

TEST_F(OwnModel, NamesTheVariantsThatItHas) {
  const std::string path = write(R"("nodes": [{"mesh": 0}])");
  const auto gold = open_model({.file = path, .variant = "Gold"});
  ASSERT_TRUE(gold) << gold.error().message;
  EXPECT_EQ(gold->scene.meshes[0].primitives[0].material, 1U);
  const auto mica = open_model({.file = path, .variant = "mica"});
  ASSERT_FALSE(mica);
  EXPECT_THAT(mica.error().message, HasSubstr("it has Gold"));
}

TEST_F(OwnModel, IsDescribed) {
  std::ostringstream text;
  const std::string path =
      write(R"("nodes": [{"mesh": 0, "extras": {"touchafm": {"role": "surface"}}, "name": "a\nb"}])");
  ASSERT_TRUE(describe_model(path, DescriptionForm::Lines, text));
  for (const char* line : {"2 triangles", "variant: \"Gold\"", "understood: \"KHR_materials_variants\"",
                           "ignored: KHR_materials_sheen", "role surface: node \"a?b\""}) {
    EXPECT_THAT(text.str(), HasSubstr(line));
  }
  std::ostringstream json;
  ASSERT_TRUE(describe_model(path, DescriptionForm::Json, json));
  const auto described = nlohmann::json::parse(json.str());
  EXPECT_EQ(described["triangles"], 2);
  EXPECT_EQ(described["roles"]["surface"], "a\nb");
  EXPECT_EQ(described["variants"], nlohmann::json::array({"Gold"}));
  EXPECT_EQ(described["understood"], nlohmann::json::array({"KHR_materials_variants"}));
}

TEST(LoadingNotice, SpeaksOnceItHasWaitedAndNotBefore) {
  const auto said_after = [](scene::LoadingNotice::Wait wait) {
    std::ostringstream out;
    {
      const scene::LoadingNotice notice("lever.glb", std::move(wait), out);
    }
    return out.str();
  };
  EXPECT_EQ(said_after([](const std::stop_token&) { return true; }), "loading lever.glb ...\n");
  EXPECT_EQ(said_after([](const std::stop_token& stop) {
              while (!stop.stop_requested()) std::this_thread::yield();
              return false;
            }),
            "")
      << "loaded before the moment came";
}

TEST_F(OwnModel, BecomesAProbeByItsRoles) {
  const auto probe = load_own_models(
      write(R"("nodes": [{"name": "Lever", "mesh": 0, "extras": {"touchafm": {"role": "base"}}, "scale": [3, 1, -1],
                          "children": [1]},
                         {"name": "tip", "translation": [1, 0, 0], "children": [2]},
                         {"mesh": 0, "rotation": [0.7071067811865476, 0, 0, -0.7071067811865476], "scale": [0.1, 0.1, 0.1]}])"),
      "");
  ASSERT_TRUE(probe) << probe.error().message;
  ASSERT_EQ(probe->probe->nodes.size(), 3U);
  EXPECT_EQ(probe->probe->nodes[0].name, "cantilever");
  EXPECT_EQ(probe->probe->nodes[1].name, "tip");
  EXPECT_EQ(probe->probe->nodes[1].parent, 0U);
  EXPECT_EQ(probe->probe->nodes[2].name, "apex");
  EXPECT_NEAR(probe->probe->nodes[2].parent_from_node[3].z, -0.1, 1e-6);
  EXPECT_EQ(probe->probe->meshes[0].primitives.size(), 1U);
  EXPECT_EQ(probe->probe->meshes[1].primitives.size(), 1U);
  const auto nothing = load_own_models(write(R"("nodes": [{"mesh": 0, "name": "tip"}])"), "");
  ASSERT_FALSE(nothing);
  EXPECT_THAT(nothing.error().message, HasSubstr("needs a node for the role base and one for tip"));
}

// Mesh as left by exporters when it was modelled far from the origin.
TEST_F(OwnModel, IsNoSampleBesideTheTip) {
  for (const auto& [place, is_sample] :
       {std::pair("[0, 0, 0]", true), std::pair("[-4e-8, 0, 0]", true), std::pair("[1e-7, 0, 0]", false),
        std::pair("[0, -1e-7, 0]", false), std::pair("[1e6, 0, 0]", false)}) {
    const std::string nodes =
        R"("nodes": [{"name": "surface", "children": [1]}, {"mesh": 0, "scale": [4e-8, 4e-8, 4e-8])";
    const auto own = load_own_models("", write(nodes + ", \"translation\": " + place + "}]"));
    ASSERT_EQ(own.has_value(), is_sample) << place << (own ? "" : own.error().message);
    if (own) continue;
    EXPECT_THAT(own.error().message, HasSubstr("lies beside the sample: put it on the surface"));
  }
}

// glTF has +y up, so that a level surface of most programs is on edge in the frame of its node.
TEST_F(OwnModel, IsNoSampleOnEdge) {
  const auto turned = [&](const std::string& rotation) {
    const auto own = load_own_models("", write(R"("nodes": [{"name": "surface", "children": [1]},
        {"mesh": 0, "scale": [4e-8, 4e-8, 4e-8], "rotation": )" +
                                               rotation + "}]"));
    return own ? "felt" : own.error().message;
  };
  EXPECT_EQ(turned("[0, 0, 0, 1]"), "felt");
  EXPECT_EQ(turned("[0, 0, 0.7071067811865476, 0.7071067811865476]"), "felt");
  EXPECT_EQ(turned("[0.258819, 0, 0, 0.9659258]"), "felt") << "a slope of 30 degrees";
  EXPECT_THAT(turned("[-0.7071067811865476, 0, 0, 0.7071067811865476]"),
              HasSubstr("is on edge under the tip: +z of the node for the role surface is the outward normal, but "
                        "the surface faces along its y; turn this node, without the mesh, by -90 degrees about x"));
  EXPECT_THAT(turned("[0, 0.7071067811865476, 0, 0.7071067811865476]"), HasSubstr("by 90 degrees about y"));
}

// A scan of it would be level at the end of the scanner.
TEST_F(OwnModel, IsNoSampleFarAboveOrBelowTheTip) {
  const auto own = [&](const std::string& place, const std::string& scale) {
    const auto loaded =
        load_own_models("", write(R"("nodes": [{"name": "surface", "children": [1]}, {"mesh": 0, "scale": )" + scale +
                                  R"(, "translation": )" + place + "}]"));
    return loaded ? "felt" : loaded.error().message;
  };
  EXPECT_EQ(own("[0, 0, 3e-8]", "[4e-8, 4e-8, 4e-8]"), "felt");
  EXPECT_THAT(own("[0, 0, 1]", "[4e-8, 4e-8, 4e-8]"),
              HasSubstr("role surface lies 1 m below the sample: put it on the"));
  EXPECT_THAT(own("[0, 0, -5e-8]", "[4e-8, 4e-8, 4e-8]"), HasSubstr("role surface lies 50 nm above the sample"));
  EXPECT_THAT(own("[0, 0, 0]", "[4e-13, 4e-13, 4e-13]"),
              HasSubstr("its surface is 0.4 pm wide, less than an atom: one unit of a sample is one metre"));
}

TEST_F(OwnModel, BecomesASampleThatIsFeltAsItIsDrawn) {
  const auto own = load_own_models("", write(R"("nodes": [{"name": "surface", "children": [1]},
      {"mesh": 0, "translation": [-2e-8, -2e-8, 3e-9], "scale": [4e-8, 4e-8, 4e-8]}])"));
  ASSERT_TRUE(own) << own.error().message;
  const auto field = scene::height_field_below(*own->sample, 0);
  ASSERT_TRUE(field);
  EXPECT_FLOAT_EQ(field->height_m[field->columns * (field->rows / 2) + field->columns / 2], 3e-9F);
  scene::MaterialEntry gold, mica;
  gold.name = "gold";
  mica.name = "mica";
  EXPECT_EQ(sample_as(*own->sample, gold).meshes[0].primitives[0].material, 1U);
  EXPECT_EQ(sample_as(*own->sample, mica).meshes[0].primitives[0].material, 0U);

  const auto large = load_own_models("", write(R"("nodes": [{"name": "surface", "mesh": 0}])"));
  ASSERT_TRUE(large) << large.error().message;
  EXPECT_NEAR(large->sample->meshes[0].primitives[0].vertices.at(2).position.x, 60e-9, 1e-14);
}

// Whatever is a sample has the dark line of the assets' samples: a file's, and the plane below particles.
TEST_F(OwnModel, HasAnOutlineAsASample) {
  const auto own =
      load_own_models("", write(R"("nodes": [{"name": "surface", "mesh": 0, "scale": [4e-8, 4e-8, 4e-8]}])"));
  ASSERT_TRUE(own) << own.error().message;
  for (const scene::Scene& sample : {*own->sample, with_outline(particle_ground(40e-9))}) {
    ASSERT_EQ(sample.nodes.size(), 2U);
    EXPECT_EQ(sample.nodes[1].name, "outline");
    const scene::Bounds body = bounds_below(sample, 0), around = bounds_below(sample, 1);
    EXPECT_LT(around.low.x, body.low.x);
    EXPECT_LT(around.low.y, body.low.y);
    EXPECT_GT(around.high.x, body.high.x);
    EXPECT_GT(around.high.z, body.high.z);
    EXPECT_LT(around.high.z - body.high.z, 0.004 * (body.high.x - body.low.x)) << "a thin line";
    const scene::Primitive& line = sample.meshes[*sample.nodes[1].mesh].primitives.at(0);
    EXPECT_TRUE(sample.materials[line.material].unlit);
    const glm::vec3 middle = 0.5F * glm::vec3(body.low + body.high);
    for (std::size_t i = 0; i + 2 < line.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) { return line.vertices[line.indices[i + k]].position; };
      const glm::vec3 front = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
      EXPECT_GT(glm::dot(front * 1e16F, (middle - corner(0)) * 1e8F), 0.0F) << "seen from outside";
    }
  }
}

TEST_F(OwnModel, SaysThatItsAnimationsAreNotPlayedOnTheWall) {
  const auto said = [&](const std::string& more) {
    const std::string path = write(R"("nodes": [{"name": "surface", "mesh": 0}])" + more);
    testing::internal::CaptureStderr();
    EXPECT_TRUE(load_own_models("", path));
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(""), "");
  EXPECT_THAT(said(R"(, "animations": [{"samplers": [], "channels": []}])"), HasSubstr("is shown at rest"));
}

}  // namespace model_view_test
}  // namespace afm::exhibit
