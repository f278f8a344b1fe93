// SPDX-License-Identifier: Apache-2.0
// The curves of a force map over its sample.
#include "exhibit/scan/volume_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <memory>
#include <string>
#include <utility>

#include "curves/fitting/felt_map.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/models/topography_model.h"
#include "exhibit/models/user_models.h"
#include "exhibit/models/volume_shapes.h"
#include "exhibit/scenery/wall_layout.h"
#include "exhibit/scenery/wall_scene.h"
#include "support/phrases.h"
#include "support/places.h"

namespace afm::exhibit {
namespace volume_view_test {

using Way = curves::ForceVolume::Way;

constexpr std::size_t kSide = 8;
constexpr double kPixelM = 100e-9, kPushedM = 40e-9;
const curves::MapGrid kGrid{.columns = kSide, .rows = kSide, .width_m = kSide * kPixelM, .height_m = kSide * kPixelM};

// Springs that are stiffer from row to row, with a pull on the way up.
curves::RecordedCurve curve_at(std::size_t column, std::size_t row) {
  curves::RecordedCurve curve;
  curve.metadata.pixel = curves::MapPixel{kGrid, column, row};
  const double stiffness = 0.1 * (1.0 + static_cast<double>(row));
  const auto add = [&](double z_m, double pull_n, physics::Branch branch) {
    curve.points.push_back(
        {physics::Length(z_m), physics::Force((z_m < 0.0 ? -stiffness * z_m : 0.0) - pull_n), branch});
  };
  for (int i = 800; i > -160; --i) add(0.25e-9 * i, 0.0, physics::Branch::Approach);
  for (int i = -160; i < 800; ++i) add(0.25e-9 * i, i > -20 && i < 60 ? 2e-9 : 0.0, physics::Branch::Retract);
  return curve;
}

// A map on a flat sample, and a wall with it.
struct Shown {
  Shown() {
    curves::ForceVolume::Gatherer gatherer;
    for (std::size_t row = 0; row < kSide; ++row) {
      for (std::size_t column = 0; column < kSide; ++column) gatherer.add(curve_at(column, row));
    }
    curves::FeltMap map;
    map.grid = kGrid;
    map.laws.columns = map.laws.rows = kSide;
    map.laws.spacing_m = kPixelM;
    map.heights = {kSide, kSide, kPixelM, std::vector<float>(kSide * kSide, 0.0F)};
    map.volume = std::make_shared<const curves::ForceVolume>(gatherer.finish());
    UserModels own;
    own.topography = topography_model(map.heights);
    own.force_volume = true;
    const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
    const auto materials = library.only(std::vector<std::string>{"gold"}).value();
    const auto wall = scene::load_wall(support::source("assets/walls/powerwall.toml")).value();
    viewer_m = stage_place(wall).viewer_m;
    scene.emplace(
        WallScene::load(support::source("assets"), materials, stage_place(wall), test::english(), own).value());
    made = curves::make_sample_model(curves::ContactSetup{materials.materials.front(), {}, {}}).value();
    scene->lay_surface_on(made->parameters, 0);
    made->felt_map = std::make_shared<const curves::FeltMap>(std::move(map));
    state.material = 0;
    // a whole map in metres of the sample's frame
    const double size =
        made->parameters.topography.lateral * scene::surface_scale(made->parameters, made->scaling.release_z_m());
    per_measured = size;
  }

  render::FrameState frame() const {
    render::FrameState frame;
    scene->update(state, frame);
    return frame;
  }

  std::optional<WallScene> scene;
  const curves::SampleModel& model() const { return *made; }

  std::optional<curves::SampleModel> made;
  WallState state;
  double per_measured = 1;
  glm::dvec3 viewer_m{0.0};
};

const render::MeshShape& shape(const render::FrameState& frame, const WallScene& scene, const char* name) {
  const auto node = scene.scene().find_node(name).value();
  return *std::find_if(frame.shapes.begin(), frame.shapes.end(),
                       [&](const render::MeshShape& each) { return each.node == node; });
}

// Coverage and hue of the slice over its middle at a share of its height.
glm::vec4 middle(const render::FrameState& frame, const WallScene& scene, double height) {
  const auto row = static_cast<std::size_t>(height * (kSliceRows - 1));
  return shape(frame, scene, "slice/slice").vertices[row * kSliceColumns + kSliceColumns / 2].color;
}

TEST(VolumeView, CutsTheForcesOfTheTipsLineOnTheWayOfTheTip) {
  Shown shown;
  VolumeView view(*shown.scene);
  const auto slice = [&](double y, Way way) {
    shown.state.surface.xy_m = {0.0, shown.per_measured * y * kGrid.height_m};
    render::FrameState frame = shown.frame();
    view.add_slice(shown.model(), shown.state, way, frame);
    return frame;
  };
  const render::FrameState soft = slice(-0.44, Way::Approach), stiff = slice(0.44, Way::Approach),
                           up = slice(0.44, Way::Retract);
  EXPECT_EQ(soft.shapes.size(), 2U) << "with the scale of its colours";
  EXPECT_GT(middle(stiff, *shown.scene, 0.1).a, middle(soft, *shown.scene, 0.1).a) << "the stiffer line pushes harder";
  EXPECT_GT(middle(stiff, *shown.scene, 0.1).r, middle(stiff, *shown.scene, 0.1).b) << "a push";
  EXPECT_LT(middle(stiff, *shown.scene, 0.8).a, 0.4F) << "nothing acts before the contact";
  EXPECT_LT(middle(up, *shown.scene, 0.75).r, middle(up, *shown.scene, 0.75).b) << "a pull";
  // the slice follows the tip
  const auto node = shown.scene->scene().find_node("slice/slice").value();
  const glm::dvec3 moved(stiff.room_from_node[node][3] - soft.room_from_node[node][3]);
  const double way = 0.88 * kGrid.height_m * shown.per_measured / shown.scene->drawn_scale(0).sample_m_per_m;
  EXPECT_NEAR(glm::length(moved), way, 0.02 * way);
}

TEST(VolumeView, WritesItsForcesAndItsHeight) {
  Shown shown;
  VolumeView view(*shown.scene);
  render::FrameState frame = shown.frame();
  const std::size_t labels = frame.labels.size();
  view.add_slice(shown.model(), shown.state, Way::Approach, frame);
  ASSERT_EQ(frame.labels.size(), labels + 4);
  EXPECT_EQ(frame.labels[labels].text, "\u22122 nN");
  EXPECT_EQ(frame.labels[labels + 1].text, "0");
  EXPECT_TRUE(frame.labels[labels + 2].text.ends_with(" nN")) << frame.labels[labels + 2].text;
  EXPECT_TRUE(frame.labels[labels + 3].text.ends_with(" nm high")) << frame.labels[labels + 3].text;
  for (const render::MeshShape& each : frame.shapes) {
    for (const scene::Vertex& vertex : each.vertices) {
      ASSERT_GE(vertex.position.z, 0.0F);
      ASSERT_LE(vertex.position.z, 1.0F);
    }
  }
  shown.state.centerpiece = Centerpiece::Journey;
  render::FrameState journey = shown.frame();
  view.add_slice(shown.model(), shown.state, Way::Approach, journey);
  EXPECT_TRUE(journey.shapes.empty()) << "no sample there";
}

// Part of the wall's plane that a rectangle seems to cover, for an eye; layout units.
struct Seen {
  glm::dvec2 low{1e9}, high{-1e9};
  bool overlaps(const Seen& other) const {
    return glm::all(glm::lessThan(low, other.high)) && glm::all(glm::lessThan(other.low, high));
  }
};
Seen seen(const glm::dvec3& corner_m, const glm::dvec3& right_m, const glm::dvec3& up_m, const glm::dvec3& eye_m,
          const WallScene& scene) {
  const glm::dmat4 layout_from_room = glm::inverse(scene.places().room_from_layout());
  const glm::dvec3 eye(layout_from_room * glm::dvec4(eye_m, 1.0));
  Seen seen;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      const glm::dvec3 point(layout_from_room * glm::dvec4(corner_m + x * right_m + y * up_m, 1.0));
      const glm::dvec2 there(eye + eye.z / (eye.z - point.z) * (point - eye));
      seen.low = glm::min(seen.low, there);
      seen.high = glm::max(seen.high, there);
    }
  }
  return seen;
}

TEST(VolumeView, LeavesTheRulersNumberReadable) {
  Shown shown;
  VolumeView view(*shown.scene);
  const auto bar = shown.scene->scene().find_node("force-bar/bar").value();
  int would_be = 0;
  for (const double y : {-0.49, -0.25, 0.0, 0.25, 0.49}) {
    shown.state.surface.xy_m = {0.0, shown.per_measured * y * kGrid.height_m};
    render::FrameState frame = shown.frame();
    const auto number = std::find_if(frame.labels.begin(), frame.labels.end(),
                                     [](const render::Label& label) { return label.text.ends_with(" nm"); });
    ASSERT_NE(number, frame.labels.end());
    const auto place = number - frame.labels.begin();
    const render::PanelPlacement usual = number->placement;
    view.add_slice(shown.model(), shown.state, Way::Approach, frame);
    const render::PanelPlacement& text = frame.labels[static_cast<std::size_t>(place)].placement;
    const glm::dmat4& strip = frame.room_from_node[bar];
    for (const double eye_x : {-0.0315, 0.0315}) {
      const glm::dvec3 eye_m = shown.viewer_m + glm::dvec3(eye_x, 0.0, 0.0);
      const Seen covered =
          seen(glm::dvec3(strip[3]), kForceBarWidth * glm::dvec3(strip[0]), glm::dvec3(strip[2]), eye_m, *shown.scene);
      if (covered.overlaps(seen(usual.lower_left_m, usual.right_m, usual.up_m, eye_m, *shown.scene))) ++would_be;
      EXPECT_FALSE(covered.overlaps(seen(text.lower_left_m, text.right_m, text.up_m, eye_m, *shown.scene)))
          << "the scale of forces, with the tip at " << y;
      for (std::size_t i = 0; i < frame.labels.size(); ++i) {
        if (i == static_cast<std::size_t>(place)) continue;
        const render::PanelPlacement& other = frame.labels[i].placement;
        EXPECT_FALSE(seen(other.lower_left_m, other.right_m, other.up_m, eye_m, *shown.scene)
                         .overlaps(seen(text.lower_left_m, text.right_m, text.up_m, eye_m, *shown.scene)))
            << frame.labels[i].text << ", with the tip at " << y;
      }
    }
  }
  EXPECT_GT(would_be, 0) << "the usual place is free: then the number need not move";
}

TEST(VolumeView, RaisesTheSurfaceOfAForceHigherWhereTheSampleIsStiffer) {
  Shown shown;
  VolumeView view(*shown.scene);
  render::FrameState frame = shown.frame();
  // half of the lines reach it
  view.add_surface(shown.model(), shown.state, 18e-9, frame);
  const auto& vertices = shape(frame, *shown.scene, "equal-force/surface").vertices;
  const auto at = [&](double up) {
    return vertices[static_cast<std::size_t>(up * (kSurfaceSide - 1)) * kSurfaceSide + kSurfaceSide / 2];
  };
  EXPECT_EQ(at(0.2).color.a, 0.0F) << "no curve reaches it there";
  EXPECT_GT(at(0.6).color.a, 0.3F);
  EXPECT_GT(at(0.95).position.z, 1.2F * at(0.6).position.z);
  EXPECT_EQ(frame.labels.back().text, "18 nN");
  for (const scene::Vertex& vertex : vertices) {
    ASSERT_NEAR(static_cast<double>(glm::length(vertex.normal)), 1.0, 1e-5);
    ASSERT_GE(vertex.position.z, 0.0F);
    ASSERT_LE(vertex.position.z, 1.0F);
  }
  // a pull is that of the retract, everywhere
  render::FrameState pulled = shown.frame();
  view.add_surface(shown.model(), shown.state, -1e-9, pulled);
  const auto& held = shape(pulled, *shown.scene, "equal-force/surface").vertices;
  EXPECT_TRUE(std::all_of(held.begin(), held.end(), [](const scene::Vertex& vertex) { return vertex.color.a > 0.3F; }));
  EXPECT_EQ(pulled.labels.back().text, "\u22121 nN");
}

}  // namespace volume_view_test
}  // namespace afm::exhibit
