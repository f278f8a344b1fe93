// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>

#include "render/frame.h"
#include "scene/display/wall.h"
#include "scene/graph/scene.h"

// A small scene made in code, so that the renderer's tests do not depend on model files, and its wall: the paper's
// 3.048 m x 2.286 m, seen from 2.5 m in front of its centre, which is the room's origin.
namespace afm::test {

scene::Screen paper_screen();
scene::EyeView eye_view(scene::Eye eye, const glm::dvec3& head_m = glm::dvec3(0.0, 0.0, 2.5), double ipd_m = 0.063);

// Meshes of unit size, centred on the origin except for the lever, which lies along +x from 0 to 1.
scene::Primitive quad(std::uint32_t material);  // in the xy plane, facing +z
scene::Primitive sphere(std::uint32_t material, int rings);
scene::Primitive lever(std::uint32_t material, double half_width, double half_thickness, int segments);

// Adds a node that shows a mesh of one primitive.
scene::NodeIndex add(scene::Scene& scene, std::string name, scene::Primitive primitive,
                     const glm::dmat4& room_from_node);
std::uint32_t add_material(scene::Scene& scene, scene::PbrMaterial material);

struct TestScene {
  scene::Scene scene;
  scene::NodeIndex floor = 0, lever = 0, mica = 0, gold = 0, nitride = 0, beam = 0;
};
TestScene make_test_scene();

// A frame with both eyes, the rest transforms, and no panels.
render::FrameState bare_frame(const scene::Scene& scene);

// The test scene with its lever bent and all panels filled.
render::FrameState full_frame(const TestScene& test);

// Placement that shows nothing.
inline render::PanelPlacement nowhere() { return {.right_m = glm::dvec3(0.0), .up_m = glm::dvec3(0.0)}; }

}  // namespace afm::test
