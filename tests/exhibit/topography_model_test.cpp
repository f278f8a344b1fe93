// SPDX-License-Identifier: Apache-2.0
// Invariant: a measured surface is felt as it is drawn
#include "exhibit/models/topography_model.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <utility>

#include "exhibit/models/user_models.h"
#include "support/image_files.h"
#include "support/paper_wall.h"
#include "support/scratch_folder.h"

namespace afm::exhibit {
namespace topography_model_test {

// Hills on 48 x 32 points, 3 um x 2 um.
class MeasuredSample : public test::PaperWall {
 protected:
  support::ScratchFolder folder_;
  std::string file_ = write();
  UserModels own_ = load_own_models("", file_).value();
  WallScene measured_ = WallScene::load(assets_, materials_, stage_place(wall_), test::english(), own_).value();

  std::string write() const {
    std::vector<float> heights;
    for (int i = 0; i < 48 * 32; ++i) {
      heights.push_back(static_cast<float>(40e-9 * std::sin(0.3 * (i % 48)) * std::cos(0.4 * (i / 48))));
    }
    std::ofstream(folder_.file("hills.glb"), std::ios::binary)
        << test::gsf_file("XRes = 48\nYRes = 32\nXReal = 3e-6\nYReal = 2e-6\nXYUnits = m\nZUnits = m\n", heights);
    return folder_.file("hills.glb");  // misleading name; the first bytes are right
  }

  scene::NodeIndex surface(std::size_t material) const {
    return measured_.scene().find_node("sample-" + materials_.materials[material].name + "/surface").value();
  }
};

TEST_F(MeasuredSample, IsFeltFromTheVerticesThatAreDrawn) {
  const scene::Topography& felt = measured_.topography();
  ASSERT_EQ(felt.columns * felt.rows, 48U * 32U);
  for (std::size_t material = 0; material < materials_.materials.size(); ++material) {
    const scene::Node& node = measured_.scene().nodes[surface(material)];
    const auto& drawn = measured_.scene().meshes[*node.mesh].primitives.front().vertices;
    ASSERT_EQ(drawn.size(), felt.height_m.size());
    const scene::FeltHeights shown(felt, measured_.topography_scale(material));
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      ASSERT_EQ(felt.height_m[i], drawn[i].position.z);
      const glm::dvec3 place(node.parent_from_node * glm::dvec4(glm::dvec3(drawn[i].position), 1.0));
      const double column = static_cast<double>(i % felt.columns), row = static_cast<double>(i / felt.columns);
      ASSERT_NEAR(place.x, (column - 0.5 * (felt.columns - 1)) * shown.spacing_m,
                  1e-6 * shown.spacing_m * felt.columns);
      ASSERT_NEAR(place.y, (row - 0.5 * (felt.rows - 1)) * shown.spacing_m, 1e-6 * shown.spacing_m * felt.columns);
      ASSERT_NEAR(place.z, shown.height_factor * static_cast<double>(felt.height_m[i]), 1e-20);
    }
    scene::SharedContact parameters;
    measured_.lay_surface_on(parameters, material);
    EXPECT_EQ(parameters.height_field, scene::kTopography);
    EXPECT_EQ(parameters.topography.lateral, measured_.topography_scale(material).lateral);
  }
  EXPECT_TRUE(measured_.height_fields().empty());
}

TEST_F(MeasuredSample, HasTheApexOverTheDrawnVertex) {
  const scene::Topography& felt = measured_.topography();
  const scene::FeltHeights shown(felt, measured_.topography_scale(0));
  for (std::size_t i = 5; i < felt.height_m.size(); i += 97) {
    const double x = (static_cast<double>(i % felt.columns) - 0.5 * (felt.columns - 1)) * shown.spacing_m;
    const double y = (static_cast<double>(i / felt.columns) - 0.5 * (felt.rows - 1)) * shown.spacing_m;
    const double z = shown.height_factor * static_cast<double>(felt.height_m[i]);
    render::FrameState frame;
    measured_.update({.material = 0, .tip = {.z_m = 0, .deflection_m = 0}, .surface = {{x, y}, z}}, frame);
    const auto& drawn = measured_.scene().meshes[*measured_.scene().nodes[surface(0)].mesh].primitives.front().vertices;
    const glm::dvec3 vertex(frame.room_from_node[surface(0)] * glm::dvec4(glm::dvec3(drawn[i].position), 1.0));
    const glm::dvec3 apex(frame.room_from_node[measured_.scene().find_node("probe/apex").value()][3]);
    EXPECT_NEAR(glm::length(apex - vertex), 0.0, 1e-6);
  }
}

TEST_F(MeasuredSample, IsOneMeshAsWideAsTheMaterialsOwn) {
  EXPECT_EQ(measured_.scene().nodes[surface(0)].mesh, measured_.scene().nodes[surface(2)].mesh);
  for (std::size_t material = 0; material < materials_.materials.size(); ++material) {
    const double shown_m =
        measured_.topography_scale(material).lateral * 3e-6 / measured_.drawn_scale(material).sample_m_per_m;
    EXPECT_NEAR(shown_m, 1.13, 0.05) << "metres of the paper's wall";
  }
}

TEST_F(MeasuredSample, HasADarkOutlineOffItsFaces) {
  const scene::Scene& scene = measured_.scene();
  const scene::Mesh& mesh = scene.meshes[scene.nodes[surface(0)].mesh.value()];
  ASSERT_EQ(mesh.primitives.size(), 3U);
  const scene::Primitive& top = mesh.primitives[0];
  const scene::Primitive& outline = mesh.primitives[2];
  EXPECT_TRUE(scene.materials[outline.material].unlit);
  const glm::vec3 half = glm::abs(top.vertices.front().position);
  for (const scene::Vertex& vertex : outline.vertices) {
    const glm::vec3 beyond = glm::abs(vertex.position) - half;
    EXPECT_NEAR(std::max(beyond.x, beyond.y), 0.0028F * 2.0F * half.x, 1e-10F);
    EXPECT_LT(vertex.color.g, 0.01F);
  }
  for (std::size_t i = 0; i + 2 < outline.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return outline.vertices[outline.indices[i + k]].position; };
    const glm::vec3 front = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    EXPECT_GT(glm::dot(front, outline.vertices[outline.indices[i]].normal), 0.0F) << "seen from outside";
  }
}

TEST_F(MeasuredSample, HasABarWithItsReliefBesideIt) {
  const auto texts = [&](const WallState& state) {
    render::FrameState frame;
    measured_.update(state, frame);
    std::vector<std::string> found;
    for (const render::Label& label : frame.labels) found.push_back(label.text);
    return found;
  };
  EXPECT_THAT(texts({.material = 0}), testing::Contains(testing::HasSubstr(" nm")));
  ASSERT_NE(own_.topography->exaggeration, 1.0);
  const std::string times = fmt::format("heights \u00d7{:g}", own_.topography->exaggeration);
  EXPECT_THAT(texts({.material = 0}), testing::Contains(testing::HasSubstr(times)));
  EXPECT_THAT(texts({}), testing::Not(testing::Contains(testing::HasSubstr("heights \u00d7"))));
}

TEST(OwnSample, SaysWhatWasNotMeasuredAndIsFilled) {
  const support::ScratchFolder folder;
  std::vector<float> heights(12 * 8, 1e-9F);
  heights[17] = 4e-9F;
  const std::string file = folder.file("holes.gsf");
  const auto summary = [&] {
    std::ofstream(file, std::ios::binary)
        << test::gsf_file("XRes = 12\nYRes = 8\nXReal = 3e-6\nYReal = 2e-6\nXYUnits = m\nZUnits = m\n", heights);
    return load_own_models("", file).value().topography.value().summary;
  };
  EXPECT_THAT(summary(), testing::Not(testing::HasSubstr("not measured")));
  for (const std::size_t i : {30U, 31U, 55U}) heights[i] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(summary(), testing::HasSubstr("; 3 points that were not measured are filled from around them; heights"));
}

TEST(OwnSample, IsRefusedWithWhatWouldBeRead) {
  const support::ScratchFolder folder;
  for (const char* bytes : {"", "hello", "II*", "\\*EC file", "\\*Force file list"}) {
    const std::string file = folder.file("sample.spm");
    std::ofstream(file) << bytes;
    const auto own = load_own_models("", file);
    ASSERT_FALSE(own) << bytes;
    EXPECT_EQ(own.error().category, core::ErrorCategory::BadInputFile);
    EXPECT_THAT(own.error().message, testing::HasSubstr("neither a glTF model nor an image")) << bytes;
    EXPECT_THAT(own.error().message, testing::HasSubstr("Nanoscope .spm or .001")) << bytes;
    const bool named = own.error().message.find("it is a curve, which has no surface") != std::string::npos;
    EXPECT_EQ(named, std::string_view(bytes).starts_with("\\*Force")) << bytes;
  }
  const auto model = load_own_models("", folder.write("cube.stl", "solid cube\n facet normal 0 0 1\n"));
  EXPECT_THAT(model.error().message,
              testing::EndsWith("it is an STL file, not glTF; export glTF 2.0 (.glb) from the program that made it"));
  ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
  for (const auto& [file, kind] : {std::pair(folder.file("pipe"), "a pipe"), std::pair(folder.path(), "a folder")}) {
    const auto own = load_own_models("", file);
    ASSERT_FALSE(own) << kind;
    EXPECT_THAT(own.error().message, testing::HasSubstr(std::string("it is ") + kind + ", not a file"));
    EXPECT_THAT(own.error().message, testing::HasSubstr("Nanoscope .spm or .001")) << kind;
  }
  std::ofstream(folder.file("sample.gltf")) << "{";
  EXPECT_THAT(load_own_models("", folder.file("sample.gltf")).error().message, testing::HasSubstr("JSON is invalid"));
}

TEST(ExaggerationOfHeights, KeepsTrueProportionsWhereTheyCanBeFelt) {
  EXPECT_EQ(exaggeration_of(1e-6, 10e-6), 1.0);
  EXPECT_EQ(exaggeration_of(2e-6, 10e-6), 0.5);
  EXPECT_EQ(exaggeration_of(0.3e-9, 200e-9), 50.0);
  EXPECT_EQ(exaggeration_of(0.0, 200e-9), 1.0);
  for (const double relief_m : {1e-11, 3e-10, 4e-9, 7e-8, 2e-6, 5e-5}) {
    const double shown = 1.65 * relief_m / 10e-6 * exaggeration_of(relief_m, 10e-6);
    EXPECT_GE(shown, 0.05);
    EXPECT_LE(shown, 0.25);
  }
}

}  // namespace topography_model_test
}  // namespace afm::exhibit
