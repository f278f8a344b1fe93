// SPDX-License-Identifier: Apache-2.0
// Invariant: the models are byte for byte the output of their generator
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "models.h"
#include "scene/gltf/gltf_loader.h"
#include "support/places.h"

namespace afm::scene {
namespace models_test {

namespace fs = std::filesystem;

const fs::path& models_folder() {
  static const fs::path folder = fs::path(support::source()) / "assets" / "models";
  return folder;
}

Scene load(const std::string& name) {
  core::Result<Scene> scene = load_gltf((models_folder() / (name + ".glb")).string());
  if (!scene) {
    ADD_FAILURE() << scene.error().message;
    return {};
  }
  return *scene;
}

const std::vector<std::string>& sample_names() {
  static const std::vector<std::string> names{"sample-mica", "sample-gold", "sample-si3n4"};
  return names;
}

glm::dmat4 model_from_node(const Scene& scene, NodeIndex node) {
  glm::dmat4 transform = scene.nodes[node].parent_from_node;
  for (std::optional<NodeIndex> parent = scene.nodes[node].parent; parent; parent = scene.nodes[*parent].parent) {
    transform = scene.nodes[*parent].parent_from_node * transform;
  }
  return transform;
}

const Mesh& mesh_of(const Scene& scene, const std::string& node) {
  return scene.meshes.at(*scene.nodes.at(scene.find_node(node).value()).mesh);
}

std::vector<glm::dvec3> positions_of(const Mesh& mesh) {
  std::vector<glm::dvec3> positions;
  for (const Primitive& primitive : mesh.primitives) {
    for (const Vertex& vertex : primitive.vertices) positions.emplace_back(vertex.position);
  }
  return positions;
}

// The height grid of a sample: the first primitive of its surface.
const std::vector<Vertex>& grid_of(const Scene& scene) { return mesh_of(scene, "surface").primitives.at(0).vertices; }

TEST(Models, AreWhatTheGeneratorWrites) {
  std::set<std::string> generated;
  for (const generate::Model& model : generate::all_models()) {
    const fs::path path = models_folder() / (model.name + ".glb");
    generated.insert(path.filename());
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> committed{std::istreambuf_iterator<char>(file), {}};
    const std::vector<std::uint8_t> bytes = generate::to_glb(model);
    const bool equal = std::equal(bytes.begin(), bytes.end(), committed.begin(), committed.end(),
                                  [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); });
    EXPECT_TRUE(equal) << path << " differs; run generate_models assets/models";
  }
  std::set<std::string> committed;
  for (const fs::directory_entry& entry : fs::directory_iterator(models_folder()))
    committed.insert(entry.path().filename());
  EXPECT_EQ(committed, generated);
}

TEST(Models, TakeLittleRoom) {
  std::uintmax_t total = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(models_folder())) total += entry.file_size();
  EXPECT_LT(total, 22U << 20U);  // mostly the atoms of three samples, up to the horizon, and of the tip
}

// Features that change faster than the mesh of the ground had saw teeth before the viewer, who is at negative y.
TEST(Models, GroundsOfTheJourneyChangeSlowlyEnoughForTheirMesh) {
  constexpr double kFrom = 60e-9, kTo = 4.5e-3, kBefore = 0.75, kMost = 0.55;  // fractions of the ground's colours
  for (const char* name : {"ground-mica", "ground-gold", "ground-si3n4"}) {
    const Scene scene = load(name);
    std::vector<double> changes;
    double low = 1.0, high = 0.0;
    for (const Node& node : scene.nodes) {
      if (!node.mesh || !node.name.starts_with("ring")) continue;
      for (const Primitive& primitive : scene.meshes[*node.mesh].primitives) {
        const auto is_seen = [&](const Vertex& vertex) {
          const glm::dvec3 place(vertex.position);
          const double r = std::hypot(place.x, place.y);
          return r > kFrom && r < kTo && place.y < -kBefore * r;
        };
        for (std::size_t i = 0; i < primitive.indices.size(); ++i) {
          const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
          const Vertex &a = primitive.vertices[primitive.indices[i]], &b = primitive.vertices[primitive.indices[next]];
          if (!is_seen(a) || !is_seen(b)) continue;
          const double shade = static_cast<double>(a.color.r);
          low = std::min(low, shade);
          high = std::max(high, shade);
          changes.push_back(std::abs(shade - static_cast<double>(b.color.r)));
        }
      }
    }
    ASSERT_GT(changes.size(), 10'000U) << name;
    const auto most = changes.end() - static_cast<std::ptrdiff_t>(changes.size() / 100);
    std::nth_element(changes.begin(), most, changes.end());
    EXPECT_LT(*most, kMost * (high - low)) << name << ": in one edge of a triangle in a hundred";
  }
}

TEST(Models, HaveUnitNormalsOnTheOutsideOfEveryTriangle) {
  std::size_t triangles = 0;
  for (const generate::Model& model : generate::all_models()) {
    const Scene scene = load(model.name);
    for (const Mesh& mesh : scene.meshes) {
      SCOPED_TRACE(model.name + "/" + mesh.name);
      std::size_t wrong_length = 0, inside_out = 0;
      for (const Primitive& primitive : mesh.primitives) {
        for (const Vertex& vertex : primitive.vertices)
          wrong_length += std::abs(glm::length(vertex.normal) - 1) > 1e-5F;
        for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
          glm::dvec3 corner[3], normal(0);
          for (std::size_t k = 0; k < 3; ++k) {
            const Vertex& vertex = primitive.vertices[primitive.indices[i + k]];
            corner[k] = vertex.position;
            normal += glm::dvec3(vertex.normal);
          }
          inside_out += glm::dot(glm::cross(corner[1] - corner[0], corner[2] - corner[0]), normal) <= 0;
          ++triangles;
        }
      }
      EXPECT_EQ(wrong_length, 0U);
      EXPECT_EQ(inside_out, 0U);
    }
  }
  EXPECT_GT(triangles, 50'000U) << "looked at too little";
}

TEST(Models, HaveTheNodesThatTheProgramLooksFor) {
  const std::map<std::string, std::vector<std::string>> expected{
      {"probe", {"probe", "chip", "cantilever", "tip", "apex"}},
      {"sample-mica", {"sample", "surface"}},
      {"sample-gold", {"sample", "surface"}},
      {"sample-si3n4", {"sample", "surface"}},
      {"stage", {"stage"}},
      {"room", {"floor"}},
      {"swatch-mica", {"swatch", "label", "shade"}},
      {"swatch-gold", {"swatch", "label", "shade"}},
      {"swatch-si3n4", {"swatch", "label", "shade"}},
      {"optics", {"laser", "photodiode", "quadrant-a", "quadrant-b", "quadrant-c", "quadrant-d", "beam", "spot"}},
      {"wand", {"wand", "ray"}},
      {"marks", {"line", "push", "push-head", "pull", "pull-head"}},
      {"journey", {"bench", "instrument", "holder", "chip", "lever", "tip", "apex", "tip-atoms"}},
      {"companions", {"hair", "red-cell", "virus", "dna"}},
      {"ground-mica", {"ring-0", "atoms"}},
      {"ground-gold", {"ring-0", "atoms"}},
      {"ground-si3n4", {"ring-0", "atoms"}},
      {"analogy", {"plate", "magnet", "spring", "hand"}}};
  ASSERT_EQ(generate::all_models().size(), expected.size());
  for (const auto& [name, nodes] : expected) {
    const Scene scene = load(name);
    for (const std::string& node : nodes) EXPECT_TRUE(scene.find_node(node)) << name << ": " << node;
  }
}

TEST(Models, StandUprightInGltfsFrame) {
  for (const auto& [name, node] : {std::pair{"probe", "cantilever"}, {"sample-mica", "surface"}, {"stage", "stage"}}) {
    const Scene scene = load(name);
    const glm::dmat4 transform = model_from_node(scene, scene.find_node(node).value());
    EXPECT_EQ(glm::dvec3(transform * glm::dvec4(0, 0, 1, 0)), glm::dvec3(0, 1, 0)) << name;
    EXPECT_EQ(glm::dvec3(transform * glm::dvec4(1, 0, 0, 0)), glm::dvec3(1, 0, 0)) << name;
  }
}

TEST(Cantilever, IsClampedAtZeroAndBendsInManySteps) {
  const Scene scene = load("probe");
  double shortest = 1, longest = -1;
  std::set<double> stations;
  for (const glm::dvec3& p : positions_of(mesh_of(scene, "cantilever"))) {
    shortest = std::min(shortest, p.x);
    longest = std::max(longest, p.x);
    stations.insert(p.x);
    EXPECT_GE(p.z, 0.0);
  }
  EXPECT_NEAR(shortest, 0.0, 1e-6);
  EXPECT_NEAR(longest, 200e-6, 1e-9);
  EXPECT_GE(stations.size(), 48U);
}

TEST(Tip, EndsInABallOfFiftyNanometres) {
  const Scene scene = load("probe");
  const double apex = scene.nodes[scene.find_node("apex").value()].parent_from_node[3].z;
  const glm::dvec3 center(0, 0, apex + 50e-9);
  double lowest = 0;
  std::size_t on_the_ball = 0;
  for (const glm::dvec3& p : positions_of(mesh_of(scene, "tip"))) {
    lowest = std::min(lowest, p.z);
    // the tip does not reach into the ball, whose lowest part belongs to the tip
    EXPECT_GE(glm::length(p - center), 50e-9 * (1 - 1e-4));
    if (p.z < apex + 15e-9) {
      EXPECT_NEAR(glm::length(p - center), 50e-9, 50e-9 * 1e-4);
      ++on_the_ball;
    }
  }
  EXPECT_NEAR(lowest, apex, 1e-12);
  EXPECT_GT(on_the_ball, 200U) << "too coarse to look round when shown at 10 000 times its size";
}

TEST(Samples, StandAtZeroWhereTheTipLands) {
  for (const std::string& name : sample_names()) {
    const Scene scene = load(name);
    const std::vector<Vertex>& grid = grid_of(scene);
    const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(grid.size()))));
    ASSERT_EQ(side * side, grid.size());
    const Vertex& middle = grid[(side / 2) * side + side / 2];
    EXPECT_EQ(middle.position, glm::vec3(0)) << name;
    EXPECT_GT(middle.normal.z, 0.999F) << name;
  }
}

TEST(Samples, AreTouchedByTheBallInTheirMiddleFirst) {
  constexpr double kRadius = 50e-9;
  for (const std::string& name : sample_names()) {
    const Scene scene = load(name);
    for (const Vertex& vertex : grid_of(scene)) {
      const glm::dvec3 p(vertex.position);
      const double off_axis = std::hypot(p.x, p.y);
      if (off_axis > kRadius) continue;
      const double ball = kRadius - std::sqrt(kRadius * kRadius - off_axis * off_axis);
      EXPECT_LE(p.z, ball + 1e-13) << name << " at " << p.x * 1e9 << ", " << p.y * 1e9 << " nm";
    }
  }
}

TEST(Samples, HaveTheSizesOfTheirMaterials) {
  const std::map<std::string, double> sides{{"sample-mica", 40e-9}, {"sample-gold", 288e-9}, {"sample-si3n4", 48e-9}};
  for (const auto& [name, side] : sides) {
    const Scene scene = load(name);
    const std::vector<Vertex>& grid = grid_of(scene);
    EXPECT_NEAR(static_cast<double>(grid.back().position.x) - static_cast<double>(grid.front().position.x), side,
                side * 1e-5)
        << name;
    EXPECT_NEAR(static_cast<double>(grid.back().position.y) - static_cast<double>(grid.front().position.y), side,
                side * 1e-5)
        << name;
  }
}

// Dark, seen from inside only, and outside of the slab: as wide as 2 to 4 thousandths of its side.
TEST(Samples, HaveAnOutlineAroundTheirEdges) {
  for (const std::string& name : sample_names()) {
    const Scene scene = load(name);
    const Primitive& outline = mesh_of(scene, "sample").primitives.at(0);
    const PbrMaterial& material = scene.materials.at(outline.material);
    EXPECT_TRUE(material.unlit && !material.double_sided) << name;
    EXPECT_LT(material.base_color.g, 0.01F) << name;
    const std::vector<Vertex>& grid = grid_of(scene);
    const auto side = static_cast<double>(grid.back().position.x) - static_cast<double>(grid.front().position.x);
    double highest_of_grid = -1, highest = -1;
    for (const Vertex& vertex : grid)
      highest_of_grid = std::max(highest_of_grid, static_cast<double>(vertex.position.z));
    for (const Vertex& vertex : outline.vertices) {
      const glm::dvec3 place(vertex.position);
      const double out = std::max(std::abs(place.x), std::abs(place.y)) - 0.5 * side;
      EXPECT_GT(out, 0.002 * side) << name;
      EXPECT_LT(out, 0.004 * side) << name;
      EXPECT_LT(glm::dot(glm::dvec2(place), glm::dvec2(glm::dvec3(vertex.normal))), 0.0) << name << ": wound outwards";
      highest = std::max(highest, place.z);
    }
    EXPECT_LT(highest, highest_of_grid + 0.004 * side) << name;
    EXPECT_GT(highest, -0.02 * side) << name;
  }
}

TEST(Swatches, HaveAnOutlineOfHalfToThreeMillimetres) {
  for (const char* name : {"swatch-mica", "swatch-gold", "swatch-si3n4"}) {
    const Scene scene = load(name);
    const Primitive& solid = mesh_of(scene, "swatch").primitives.at(0);
    const Primitive& outline = mesh_of(scene, "swatch").primitives.at(2);
    const auto reach = [](const Primitive& of, glm::dvec3 direction) {
      double farthest = -1;
      for (const Vertex& vertex : of.vertices)
        farthest = std::max(farthest, glm::dot(glm::dvec3(vertex.position), direction));
      return farthest;
    };
    for (const glm::dvec3& direction : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0)}) {
      const double beyond_m = reach(outline, direction) - reach(solid, direction);
      EXPECT_GT(beyond_m, 0.0005) << name;
      EXPECT_LT(beyond_m, 0.003) << name;
    }
    EXPECT_TRUE(scene.materials.at(outline.material).unlit) << name;
  }
}

TEST(Swatches, AreSoLowThatTheFrontOfTheSampleIsSeenAboveThem) {
  for (const char* name : {"swatch-mica", "swatch-gold", "swatch-si3n4"}) {
    const Scene scene = load(name);
    for (const glm::dvec3& place : positions_of(mesh_of(scene, "swatch"))) ASSERT_LT(place.y, 0.13) << name;
  }
}

TEST(PaleLines, HaveADarkRimThatCastsNoShadow) {
  const Scene scene = load("marks");
  const std::vector<Primitive>& parts = scene.meshes[*scene.nodes[scene.find_node("line").value()].mesh].primitives;
  ASSERT_EQ(parts.size(), 2U);
  const PbrMaterial& rim = scene.materials.at(parts[1].material);
  EXPECT_TRUE(rim.blended) << "would cast a shadow";
  EXPECT_FALSE(rim.unlit) << "would be in front of the line in the journey";
  EXPECT_LT(rim.base_color.r, 0.01F);
  EXPECT_GT(parts[1].vertices.front().position.x, 1.5F * parts[0].vertices.front().position.x);
}

// The tip's end is a ball of 50 nm with clusters that lie within it, as wide as a part of their distance from the apex.
TEST(JourneyApex, HasClustersThatFaceOut) {
  const Scene scene = load("journey");
  for (const Primitive& primitive : mesh_of(scene, "apex").primitives) {
    double lowest = 1;
    for (const Vertex& vertex : primitive.vertices) lowest = std::min(lowest, static_cast<double>(vertex.position.z));
    const glm::dvec3 center(0, 0, lowest + 50e-9);
    std::map<int, double> deepest;  // by distance from the lowest place, in steps of 10 nm
    for (const Vertex& vertex : primitive.vertices) {
      const glm::dvec3 place(vertex.position);
      const double depth = 50e-9 - glm::distance(place, center);
      ASSERT_GT(depth, -1e-13);
      double& most = deepest[static_cast<int>(glm::distance(place, {0, 0, lowest}) / 10e-9)];
      most = std::max(most, depth);
    }
    EXPECT_GT(deepest[1], 0.3e-9);
    EXPECT_GT(deepest[2], deepest[1]);
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
      glm::dvec3 corner[3];
      for (std::size_t k = 0; k < 3; ++k) corner[k] = primitive.vertices[primitive.indices[i + k]].position;
      const glm::dvec3 front = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
      ASSERT_GT(glm::dot(glm::normalize(front), glm::normalize(corner[0] - center)), -0.2) << "wound inwards";
    }
  }
}

TEST(Mica, IsFlatBetweenStepsOfOneNanometre) {
  const Scene scene = load("sample-mica");
  std::map<long, std::size_t> terraces;
  std::size_t flat = 0;
  for (const Vertex& vertex : grid_of(scene)) {
    const double layers = static_cast<double>(vertex.position.z) / 1e-9;
    const long nearest = std::lround(layers);
    if (std::abs(layers - static_cast<double>(nearest)) < 1e-3) {
      ++flat;
      ++terraces[nearest];
    }
  }
  EXPECT_GT(static_cast<double>(flat), 0.8 * static_cast<double>(grid_of(scene).size()));
  EXPECT_EQ(terraces.size(), 5U) << "four steps";
  for (const auto& [layer, count] : terraces) EXPECT_GT(count, 300U) << "terrace " << layer;
}

TEST(SiliconNitride, IsRoughByAFewTenthsOfANanometre) {
  const Scene scene = load("sample-si3n4");
  double mean = 0, squares = 0;
  const std::vector<Vertex>& grid = grid_of(scene);
  const auto count = static_cast<double>(grid.size());
  for (const Vertex& vertex : grid) mean += static_cast<double>(vertex.position.z) / count;
  for (const Vertex& vertex : grid) squares += std::pow(static_cast<double>(vertex.position.z) - mean, 2) / count;
  EXPECT_GT(std::sqrt(squares), 0.3e-9);
  EXPECT_LT(std::sqrt(squares), 0.5e-9);
}

TEST(Gold, IsGrainedByAFewNanometres) {
  const Scene scene = load("sample-gold");
  double low = 0, high = 0;
  for (const Vertex& vertex : grid_of(scene)) {
    low = std::min(low, static_cast<double>(vertex.position.z));
    high = std::max(high, static_cast<double>(vertex.position.z));
  }
  EXPECT_GT(high - low, 3e-9);
  EXPECT_LT(high - low, 9e-9);
  const std::uint32_t material = mesh_of(scene, "surface").primitives.at(0).material;
  EXPECT_EQ(scene.materials.at(material).metallic, 1.0F);
}

}  // namespace models_test
}  // namespace afm::scene
