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

// A scene in motion for measuring how fast it is drawn: the frames are made before the clock starts, and begin again
// after the last.
struct RenderSubject {
  std::string name;
  scene::Scene scene;
  render::RendererOptions drawing{};  // the size of the eyes, and of the panels
  bool eyes_move = true;
  std::vector<render::FrameState> frames{};
};

// What happens before the demo's wall while gold is felt: the tip goes down and up, the lever bends, the curve grows,
// the panels are painted again for every frame; the head also moves; or nothing does, with the tip on the sample.
enum class WallMotion { Tip, TipAndHead, None };

// As high as the wall's proportions make `eye_width_px`.
core::Result<RenderSubject> wall_subject(const exhibit::Stage& stage, std::uint32_t eye_width_px, WallMotion motion);

// A glTF file before a viewer that sways: 30 degrees of height show its whole box, the wall cuts the box in the middle,
// and the eyes are 3 % of the distance to it apart.
core::Result<RenderSubject> gltf_subject(const std::string& path, glm::uvec2 eye_px);

// A square of `quads` x `quads` hills of one material; and `side`^3 small boxes, each a separate node. Seen like a
// file.
RenderSubject hills_subject(std::uint32_t quads, glm::uvec2 eye_px);
RenderSubject boxes_subject(std::uint32_t side, glm::uvec2 eye_px);

}  // namespace afm::app
