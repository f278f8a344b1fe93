// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "app/display/view_outputs.h"
#include "exhibit/frame/wall_pictures.h"
#include "render/presenter.h"
#include "render/renderer.h"

namespace afm::app {

// Options of the live view's windows and of the picture in them.
struct DisplayOptions {
  exhibit::PictureOptions picture;
  WindowOptions window;
  std::uint32_t eye_width = 0;     // 0: the windows'
  double frame_budget_ms = 0;      // 0: none
  double comfort_deg = 1;          // how much more or less the eyes may turn in than for the wall
  std::string saved_folder = ".";  // for the pictures that are saved
  bool validate = false;           // every Vulkan call
  render::PanelContrast contrast = render::PanelContrast::Normal;
  render::Swap swap = render::Swap::Alone;  // with the other machines of a wall
  std::string instructor;  // where the instructor's window is, as open_window() takes it; empty: there is none
};

}  // namespace afm::app
