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

// Options of a wall's picture in a file.
struct PictureOptions {
  std::optional<scene::StereoMode> mode{};            // replaces the outputs' modes
  scene::EyeOrder order = scene::EyeOrder::Straight;  // Swapped: exchanges the eyes of every output
  std::optional<double> ipd_m{};                      // replaces the viewer's eye distance
  std::optional<glm::uvec2> size_px{};  // size of the whole picture; replaces the outputs' sizes and eye_width
  bool mesh_lines = false;              // shows the lines of warp meshes
  std::uint32_t eye_width = 960;        // used if neither a size nor an output's rectangle is given
  std::string gpu{};                    // graphics device for drawing, as named in render::ContextOptions
};

// One output's part of a wall's picture.
struct OutputPicture {
  std::string name;
  scene::Screen screen;
  scene::StereoMode mode = scene::StereoMode::Mono;  // mode given in the wall file or by the user
  render::Composition composition;                   // layout for that mode; in mode dual, only this output's eye
  scene::PixelRect rect;                             // place in the whole picture
};

struct WallPlan {
  glm::uvec2 size_px{0};
  std::vector<OutputPicture> outputs;
};

// Arranges the wall's outputs in one picture, as on the desktop, with those that fill a monitor on the right. A wall
// without outputs gets one for each screen, side by side. WrongUsage if the mode cannot have the size.
core::Result<WallPlan> plan_wall(const scene::Wall& wall, const PictureOptions& options);

// Two eyes in front of a screen. Fails as scene::off_axis_view does.
core::Result<std::array<scene::EyeView, 2>> eyes_before(const scene::Screen& screen, const scene::HeadPose& head,
                                                        double ipd_m);

// Options for the plan's first output. Panels are as sharp as the finest output's pixels. The number of samples is the
// largest for which the device has the memory, given the largest output; a reduced number is logged.
// `panel_millimetre_m` as in render::RendererOptions.
render::RendererOptions renderer_options(render::Context& context, const WallPlan& plan, double panel_millimetre_m);

// Largest number of samples per pixel for which the device has the memory. Logs a reduced number.
std::uint32_t affordable_samples(render::Context& context, glm::uvec2 eye_px);

// Draws each output in turn and joins them in one picture, or in one for each eye if the mode has two. `build` returns
// the frame for these eyes in front of that output.
using BuildFrame = std::function<render::FrameState(const OutputPicture&, const std::array<scene::EyeView, 2>&)>;
core::Result<std::vector<render::Image>> draw_wall(render::Renderer& renderer, const WallPlan& plan,
                                                   const scene::Viewer& viewer, const PictureOptions& options,
                                                   const BuildFrame& build);

// Writes FILE.png, or FILE-left.png and FILE-right.png.
core::Result<void> write_wall(const std::vector<render::Image>& pictures, const std::string& path);

// WrongUsage if --size has no pixel, or in either direction more than the device can draw.
core::Result<void> check_picture_size(glm::uvec2 size_px, std::uint32_t largest);

}  // namespace afm::exhibit
