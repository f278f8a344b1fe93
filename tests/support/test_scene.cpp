// SPDX-License-Identifier: Apache-2.0
#include "support/test_scene.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "core/check.h"

namespace afm::test {
namespace {

constexpr double kNear = 0.05;

void add_face(scene::Primitive& primitive, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
              const glm::vec3& d) {
  const glm::vec3 normal = glm::normalize(glm::cross(b - a, d - a));
  const auto first = static_cast<std::uint32_t>(primitive.vertices.size());
  for (const auto& corner : {a, b, c, d}) {
    primitive.vertices.push_back({.position = corner, .normal = normal});
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
    primitive.indices.push_back(first + i);
  }
}

glm::dmat4 placed(const glm::dvec3& at, double size) {
  return glm::scale(glm::translate(glm::dmat4(1.0), at), glm::dvec3(size));
}

// The paper's mica curve in rough strokes, enough to check how the panel draws one.
render::PlotCurve sample_curve(double adhesion_nn, double z_off_nm, const glm::vec3& color, const std::string& label) {
  render::PlotCurve curve;
  curve.label = label;
  curve.color = color;
  for (int i = 0; i <= 4000; ++i) {
    const double z = 20.0 - 25.0 * i / 4000.0;
    const double attraction = -0.24 * std::pow(2.4 / std::max(z, 2.4), 3.0);
    curve.approach.push_back({z, z > 2.4 ? attraction : -0.1 * z * adhesion_nn / 1.4});
  }
  for (int i = 0; i <= 4000; ++i) {
    const double z = -5.0 + 25.0 * i / 4000.0;
    curve.retract.push_back({z, z < z_off_nm ? -adhesion_nn * z / z_off_nm : 0.0});
  }
  return curve;
}

}  // namespace

scene::Screen paper_screen() {
  return {.name = "wall",
          .lower_left = {-1.524, -1.143, 0.0},
          .lower_right = {1.524, -1.143, 0.0},
          .upper_left = {-1.524, 1.143, 0.0}};
}

scene::EyeView eye_view(scene::Eye eye, const glm::dvec3& head_m, double ipd_m) {
  const scene::HeadPose head{.position_m = head_m};
  const auto view = scene::off_axis_view(paper_screen(), scene::eye_position(head, eye, ipd_m),
                                         scene::DepthConvention::VulkanReversedInfinite, kNear, 1.0);
  AFM_CHECK(view.has_value());
  return *view;
}

scene::Primitive quad(std::uint32_t material) {
  scene::Primitive primitive;
  primitive.material = material;
  add_face(primitive, {-0.5F, -0.5F, 0.0F}, {0.5F, -0.5F, 0.0F}, {0.5F, 0.5F, 0.0F}, {-0.5F, 0.5F, 0.0F});
  return primitive;
}

scene::Primitive sphere(std::uint32_t material, int rings) {
  scene::Primitive primitive;
  primitive.material = material;
  const int sectors = 2 * rings;
  for (int ring = 0; ring <= rings; ++ring) {
    const float polar = glm::pi<float>() * static_cast<float>(ring) / static_cast<float>(rings);
    for (int sector = 0; sector <= sectors; ++sector) {
      const float azimuth = glm::two_pi<float>() * static_cast<float>(sector) / static_cast<float>(sectors);
      const glm::vec3 normal(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                             -std::sin(polar) * std::sin(azimuth));
      primitive.vertices.push_back({.position = 0.5F * normal, .normal = normal});
    }
  }
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      const auto a = static_cast<std::uint32_t>(ring * (sectors + 1) + sector);
      const auto below = a + static_cast<std::uint32_t>(sectors) + 1;
      for (const std::uint32_t i : {a, below, below + 1, a, below + 1, a + 1}) {
        primitive.indices.push_back(i);
      }
    }
  }
  return primitive;
}

scene::Primitive lever(std::uint32_t material, double half_width, double half_thickness, int segments) {
  scene::Primitive primitive;
  primitive.material = material;
  const auto y = static_cast<float>(half_width);
  const auto z = static_cast<float>(half_thickness);
  for (int i = 0; i < segments; ++i) {
    const float a = static_cast<float>(i) / static_cast<float>(segments);
    const float b = static_cast<float>(i + 1) / static_cast<float>(segments);
    add_face(primitive, {a, -y, z}, {b, -y, z}, {b, y, z}, {a, y, z});
    add_face(primitive, {a, y, -z}, {b, y, -z}, {b, -y, -z}, {a, -y, -z});
    add_face(primitive, {a, -y, -z}, {b, -y, -z}, {b, -y, z}, {a, -y, z});
    add_face(primitive, {a, y, z}, {b, y, z}, {b, y, -z}, {a, y, -z});
  }
  add_face(primitive, {1.0F, -y, -z}, {1.0F, y, -z}, {1.0F, y, z}, {1.0F, -y, z});
  return primitive;
}

scene::NodeIndex add(scene::Scene& scene, std::string name, scene::Primitive primitive,
                     const glm::dmat4& room_from_node) {
  scene.meshes.push_back({.name = name, .primitives = {std::move(primitive)}});
  scene.nodes.push_back({.name = std::move(name),
                         .parent = std::nullopt,
                         .mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1),
                         .parent_from_node = room_from_node});
  return static_cast<scene::NodeIndex>(scene.nodes.size() - 1);
}

std::uint32_t add_material(scene::Scene& scene, scene::PbrMaterial material) {
  scene.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

TestScene make_test_scene() {
  TestScene test;
  auto& scene = test.scene;
  const auto slate = add_material(
      scene, {.name = "slate", .base_color = {0.16F, 0.18F, 0.21F, 1.0F}, .metallic = 0.0F, .roughness = 0.55F});
  const auto silicon = add_material(
      scene, {.name = "silicon", .base_color = {0.55F, 0.58F, 0.64F, 1.0F}, .metallic = 1.0F, .roughness = 0.32F});
  const auto mica = add_material(
      scene, {.name = "mica", .base_color = {0.72F, 0.66F, 0.55F, 1.0F}, .metallic = 0.0F, .roughness = 0.25F});
  const auto gold = add_material(
      scene, {.name = "gold", .base_color = {1.0F, 0.76F, 0.33F, 1.0F}, .metallic = 1.0F, .roughness = 0.28F});
  const auto nitride = add_material(
      scene, {.name = "nitride", .base_color = {0.24F, 0.30F, 0.42F, 1.0F}, .metallic = 0.0F, .roughness = 0.40F});
  const auto laser = add_material(scene, {.name = "laser",
                                          .base_color = {1.0F, 0.10F, 0.06F, 0.45F},
                                          .metallic = 0.0F,
                                          .double_sided = true,
                                          .blended = true,
                                          .unlit = true});

  const glm::dmat4 flat = glm::rotate(glm::dmat4(1.0), glm::radians(-75.0), glm::dvec3(1.0, 0.0, 0.0));
  test.floor =
      add(scene, "floor", quad(slate),
          glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -0.62, -0.2)) * glm::scale(flat, glm::dvec3(1.9, 1.3, 1.0)));

  // along the wall from the left, thickness and bend downwards in the node's +z; in the lever's micrometres
  const glm::dmat4 lever_frame = glm::translate(glm::dmat4(1.0), glm::dvec3(-0.55, 0.25, -0.15)) *
                                 glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
  test.lever = add(scene, "lever", lever(silicon, 0.12, 0.015, 40), lever_frame);
  test.mica = add(scene, "mica", sphere(mica, 48), placed({-0.45, -0.42, 0.05}, 0.26));
  test.gold = add(scene, "gold", sphere(gold, 48), placed({0.0, -0.42, 0.05}, 0.26));
  test.nitride = add(scene, "nitride", sphere(nitride, 48), placed({0.45, -0.42, 0.05}, 0.26));
  test.beam = add(scene, "beam", lever(laser, 0.008, 0.008, 1),
                  glm::translate(glm::dmat4(1.0), glm::dvec3(0.42, 0.25, -0.15)) *
                      glm::rotate(glm::dmat4(1.0), glm::radians(70.0), glm::dvec3(0.0, 0.0, 1.0)) *
                      glm::scale(glm::dmat4(1.0), glm::dvec3(0.75, 1.0, 1.0)));
  return test;
}

render::FrameState bare_frame(const scene::Scene& scene) {
  render::FrameState frame;
  frame.eyes = {eye_view(scene::Eye::Left), eye_view(scene::Eye::Right)};
  for (const auto& node : scene.nodes) {
    frame.room_from_node.push_back(node.parent ? frame.room_from_node[*node.parent] * node.parent_from_node
                                               : node.parent_from_node);
  }
  frame.key_light = {.direction_to_light = {-0.55F, 0.80F, 0.65F},
                     .radiance = glm::vec3(2.4F, 2.3F, 2.15F),
                     .shadow_center_m = {0.0F, -0.2F, -0.2F},
                     .shadow_radius_m = 1.6F};
  frame.panels.force.placement = nowhere();
  frame.panels.data.placement = nowhere();
  frame.panels.banner.placement = nowhere();
  return frame;
}

render::FrameState full_frame(const TestScene& test) {
  render::FrameState frame = bare_frame(test.scene);
  frame.bends = {{.node = test.lever, .length = 1.0F, .end_deflection = -0.12F}};
  frame.highlighted = {test.gold};

  frame.panels.force.content = {.title = "Force on the tip",
                                .words = {.approach = "approach", .retract = "retract"},
                                .place_min_nm = -5,
                                .place_max_nm = 20,
                                .force_min_nn = -1.6,
                                .force_max_nn = 0.6,
                                .curves = {sample_curve(0.6, 6.0, {0.337F, 0.706F, 0.914F}, "silicon nitride"),
                                           sample_curve(1.4, 14.0, {0.902F, 0.624F, 0.0F}, "mica")},
                                .markers = {{render::PlotMarker::Kind::VerticalLine, 2.398, "Z_jtc 2.40 nm"},
                                            {render::PlotMarker::Kind::VerticalLine, 14.0, "Z_joc 14.0 nm"},
                                            {render::PlotMarker::Kind::HorizontalLine, -0.24, "F_attr 0.24 nN"},
                                            {render::PlotMarker::Kind::HorizontalLine, -1.4, "F_ad 1.40 nN"}},
                                .cursor = render::PlotPoint{9.0, -0.9},
                                .stage = "e \u2192 f   retract, held by adhesion",
                                .live = "\u22120.90 nN",
                                .figures = {}};
  frame.panels.force.content.curves[0].faded = true;
  frame.panels.force.content.curves[1].filled = true;
  frame.panels.force.placement = {.lower_left_m = {-1.484, -0.40, 0.0}, .right_m = {0.95, 0, 0}, .up_m = {0, 0.75, 0}};
  frame.panels.data.content = {
      .title = "Mica (muscovite)",
      .subtitle = "atomically flat, steps of 1 nm",
      .rows = {{"Hamaker constant A", "24.5 zJ", "Liu and Peng, Table 1"},
               {"tip radius R", "50 nm", "Liu and Peng, section 4"},
               {"spring constant k_c", "0.1 N/m", "Liu and Peng, section 4"},
               {"surface energy \u03b3", "4.46 mJ/m\u00b2", "from F_ad = 2\u03c0R\u03b3, eq. (3.7)"},
               {"reduced modulus E*", "\u221e", "rigid sample: k_s \u226b k_c"},
               {"F_attr, F_ad", "0.240, 1.400 nN", "eqs. (3.10) and (3.7)"}}};
  frame.panels.data.placement = {.lower_left_m = {0.534, -0.40, 0.0}, .right_m = {0.95, 0, 0}, .up_m = {0, 0.75, 0}};
  frame.panels.banner.content = {.guidance = "Lift the pen slowly until the tip lets go",
                                 .state_word = "force on",
                                 .state_shape = render::StateShape::Circle,
                                 .state_color = {0.0F, 0.75F, 0.55F},
                                 .scale = "1 m = 33 nm   \u00b7   lever 1 : 9 000   \u00b7   deflection \u00d7 3 300",
                                 .warning = "not real-time"};
  frame.panels.banner.placement = {.lower_left_m = {-1.484, 0.90, 0.0}, .right_m = {2.968, 0, 0}, .up_m = {0, 0.20, 0}};
  const char* const names[]{"mica", "gold", "silicon nitride"};
  for (int i = 0; i < 3; ++i) {
    frame.labels.push_back(
        {.text = names[i],
         .highlighted = i == 1,
         .placement = {.lower_left_m = {-0.62 + 0.45 * i, -0.74, 0.2}, .right_m = {0.34, 0, 0}, .up_m = {0, 0.09, 0}}});
  }
  return frame;
}

}  // namespace afm::test
