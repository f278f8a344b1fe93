// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
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
  std::uint32_t eye_width = 0;                  // 0: from the windows
  std::optional<double> frame_budget_ms;        // 0: none; empty: fitting the device
  double comfort_deg = 1;                       // largest change of the eyes' convergence from that for the wall
  std::string saved_folder = ".";               // receives the saved pictures
  const char* keys_hint = "F1 shows the keys";  // end of the log's line on the picture
  bool validate = false;                        // check every Vulkan call
  render::PanelContrast contrast = render::PanelContrast::Normal;
  render::Swap swap = render::Swap::Alone;  // synchronisation with the other machines of a wall
  std::string instructor;                   // place of the instructor's window, for open_window(); empty: there is none
};

}  // namespace afm::app
