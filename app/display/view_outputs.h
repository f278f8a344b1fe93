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
  std::string name;  // as the wall file says; empty: a window that no wall file places
  scene::Screen screen;
  scene::StereoMode mode = scene::StereoMode::Mono;  // at first
  std::optional<scene::Eye> eye;                     // whose picture it is in mode dual
  scene::EyeOrder order = scene::EyeOrder::Straight;
  glm::dmat3 picture_from_output{1.0};
  std::shared_ptr<const scene::WarpMesh> warp{};  // as in render::Composition
  std::shared_ptr<const scene::Blend> blend{};
  render::PictureFit fit = render::PictureFit::Proportions;
  render::WindowOptions window;

  // In another mode, if there is one, and with the eyes exchanged once more, or not.
  render::Composition composition(std::optional<scene::StereoMode> other_mode, scene::EyeOrder other_order) const;
};

// --size, --monitor and --fullscreen: one window, whatever outputs the wall file has.
struct WindowOptions {
  std::optional<glm::uvec2> size_px;
  std::string monitor;  // name or number; empty: none in particular
  bool full_screen = false;
};

// Name of the monitor of that name or number. DeviceMissing, listing them, if there is none; `who` begins the message:
// "--monitor".
core::Result<std::string> monitor_name(const std::string& who, const std::string& wanted,
                                       const std::vector<render::Monitor>& monitors);

// Expected size of the window, as far as it is known before the window opens.
glm::uvec2 expected_size(const WindowOptions& window, const std::vector<render::Monitor>& monitors);

// The wall file's outputs, each in its place; or one window of the whole stage, in mode dual one for each eye.
// `monitors` are those of this desktop. DeviceMissing, naming output and monitors: a monitor is not there, or an
// output lies, with a corner at least, on none of them. WrongUsage: mode dual where an output shows no eye, more
// windows than there can be. `stage` is what one window shows, as Stage::screen.
core::Result<std::vector<ViewOutput>> plan_view(const scene::Wall& wall, const scene::Screen& stage,
                                                const exhibit::PictureOptions& options, const WindowOptions& window,
                                                const std::vector<render::Monitor>& monitors);

// The largest eye images whose picture fits into the output's window, at the proportions of its screen or of its
// window.
glm::uvec2 eye_size_for(const exhibit::Stage& stage, const ViewOutput& output, scene::StereoMode mode,
                        glm::uvec2 window_px);

}  // namespace afm::app
