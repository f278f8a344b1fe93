// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "exhibit/frame/wall_pictures.h"
#include "render/monitor.h"
#include "render/presenter.h"
#include "render/window.h"

namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

// One window of the live view: its part of the wall and its place on the desktop.
struct ViewOutput {
  std::string name;  // name in the wall file; empty: window without a place in a wall file
  scene::Screen screen;
  scene::StereoMode mode = scene::StereoMode::Mono;  // initial mode
  std::optional<scene::Eye> eye;                     // eye shown in mode dual
  scene::EyeOrder order = scene::EyeOrder::Straight;
  glm::dmat3 picture_from_output{1.0};
  std::shared_ptr<const scene::WarpMesh> warp{};  // mesh and blending as in render::Composition
  std::shared_ptr<const scene::Blend> blend{};
  render::PictureFit fit = render::PictureFit::Proportions;
  render::WindowOptions window;

  // Composition in another mode, if given, with the eyes optionally exchanged once more.
  render::Composition composition(std::optional<scene::StereoMode> other_mode, scene::EyeOrder other_order) const;
};

// True for a point on the screen or on its edge; tiles that meet at it both hold it.
bool holds(const scene::Screen& screen, const glm::dvec3& point_m);

// Values of --size, --monitor and --fullscreen: one window, whatever outputs the wall file has.
struct WindowOptions {
  std::optional<glm::uvec2> size_px;
  std::string monitor;  // name or number of a monitor; empty: any
  bool full_screen = false;
};

// Makes the window fill a monitor, given by its name or number; monitors of one make share a name, so only the numbers
// tell them apart. DeviceMissing, listing the monitors, if there is none. `who` begins the message: "--monitor".
core::Result<void> fill_monitor(const std::string& who, const std::string& wanted,
                                const std::vector<render::Monitor>& monitors, render::WindowOptions& window);

// Size of the window as expected before it opens.
glm::uvec2 expected_size(const WindowOptions& window, const std::vector<render::Monitor>& monitors);

// Plans a window for each of the wall file's outputs, or one window for the whole stage, or in mode dual one for each
// eye. `monitors` are those of this desktop; `stage` is the screen of a single window, as Stage::screen.
// DeviceMissing, naming output and monitors, if a monitor does not exist or a corner of an output is on none of them.
// WrongUsage if an output in mode dual has no eye, or if there are too many windows.
core::Result<std::vector<ViewOutput>> plan_view(const scene::Wall& wall, const scene::Screen& stage,
                                                const exhibit::PictureOptions& options, const WindowOptions& window,
                                                const std::vector<render::Monitor>& monitors);

// Size of the largest eye images whose picture fits into the output's window, with the proportions of its screen or
// window.
glm::uvec2 eye_size_for(const exhibit::Stage& stage, const ViewOutput& output, scene::StereoMode mode,
                        glm::uvec2 window_px);

}  // namespace afm::app
