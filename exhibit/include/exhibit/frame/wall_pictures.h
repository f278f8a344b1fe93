// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "render/composition.h"
#include "render/renderer.h"
#include "scene/display/wall.h"

namespace afm::exhibit {

// Options of a picture of a wall that is written to a file.
struct PictureOptions {
  std::optional<scene::StereoMode> mode{};            // instead of the outputs' own
  scene::EyeOrder order = scene::EyeOrder::Straight;  // Swapped: the other way round in every output
  std::optional<double> ipd_m{};                      // instead of the viewer's
  std::optional<glm::uvec2> size_px{};  // of the whole picture, instead of what the outputs say or eye_width gives
  bool mesh_lines = false;              // show the lines of warp meshes
  std::uint32_t eye_width = 960;        // where neither a size nor an output's rectangle says
};

// One output's part of a wall's picture.
struct OutputPicture {
  std::string name;
  scene::Screen screen;
  scene::StereoMode mode = scene::StereoMode::Mono;  // as the wall file or the user says
  render::Composition composition;                   // that follows from it: of dual, this output's eye
  scene::PixelRect rect;                             // in the whole picture
};

struct WallPlan {
  glm::uvec2 size_px{0};
  std::vector<OutputPicture> outputs;
};

// The wall's outputs in one picture, as they stand on the desktop; those that fill a monitor follow at the right. A
// wall without outputs has one for each screen, side by side. WrongUsage: a size that the mode cannot have.
core::Result<WallPlan> plan_wall(const scene::Wall& wall, const PictureOptions& options);

// Two eyes before a screen. Fails as scene::off_axis_view does.
core::Result<std::array<scene::EyeView, 2>> eyes_before(const scene::Screen& screen, const scene::HeadPose& head,
                                                        double ipd_m);

// For the plan's first output, with panels as sharp as the finest output's pixels, and with as many samples as the
// device has the memory for in the largest one; fewer are logged. `panel_millimetre_m` as in render::RendererOptions.
render::RendererOptions renderer_options(render::Context& context, const WallPlan& plan, double panel_millimetre_m);

// As many samples a pixel as the device has the memory for; fewer than usual are logged.
std::uint32_t affordable_samples(render::Context& context, glm::uvec2 eye_px);

// Draws each output in turn and puts them together: one picture, or with a mode of two pictures the left eye's and the
// right eye's. `build` gives the frame for these eyes before that output.
using BuildFrame = std::function<render::FrameState(const OutputPicture&, const std::array<scene::EyeView, 2>&)>;
core::Result<std::vector<render::Image>> draw_wall(render::Renderer& renderer, const WallPlan& plan,
                                                   const scene::Viewer& viewer, const PictureOptions& options,
                                                   const BuildFrame& build);

// FILE.png, or FILE-left.png and FILE-right.png.
core::Result<void> write_wall(const std::vector<render::Image>& pictures, const std::string& path);

// WrongUsage: a picture of --size without a pixel, or with more each way than the device draws.
core::Result<void> check_picture_size(glm::uvec2 size_px, std::uint32_t largest);

}  // namespace afm::exhibit
