// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "core/result.h"
#include "render/frame.h"
#include "render/renderer.h"
#include "scene/graph/scene.h"

namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

// A moving scene for measuring how fast it is drawn. Frames are built before the clock starts and repeat after the
// last.
struct RenderSubject {
  std::string name;
  scene::Scene scene;
  render::RendererOptions drawing{};  // sizes of the eye images and panels
  bool eyes_move = true;
  std::uint32_t things = 0;  // number of nodes or copies in a scene of a growing series; 0: not in a series
  std::vector<render::FrameState> frames{};
};

constexpr int kSubjectFrames = 24;

// Motion on the demo's wall while gold is felt. Tip: the tip goes down and up, the lever bends, the curve grows and
// every frame repaints the panels. TipAndHead: the head moves too. None: the tip rests on the sample.
enum class WallMotion { Tip, TipAndHead, None };

// The eye's height follows from `eye_width_px` and the wall's proportions.
core::Result<RenderSubject> wall_subject(const exhibit::Stage& stage, std::uint32_t eye_width_px, WallMotion motion);

// A glTF file in front of a swaying viewer: its box fills 30 degrees of height, the wall cuts the box in the middle,
// and the distance between the eyes is 3 % of the distance to it.
core::Result<RenderSubject> gltf_subject(const std::string& path, glm::uvec2 eye_px, int frames = kSubjectFrames);

// A square of `quads` x `quads` hills of one material, and `count` small boxes in a cube, each a separate node. Viewed
// like a glTF file.
RenderSubject hills_subject(std::uint32_t quads, glm::uvec2 eye_px);
RenderSubject boxes_subject(std::uint32_t count, glm::uvec2 eye_px);

// Same boxes in a series of growing scenes: as separate nodes, or as copies of the mesh of one node.
RenderSubject growing_subject(std::uint32_t count, glm::uvec2 eye_px);
RenderSubject copies_subject(std::uint32_t count, glm::uvec2 eye_px);

}  // namespace afm::app
