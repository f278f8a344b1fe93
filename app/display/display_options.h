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
  std::uint32_t eye_width = 0;                  // width of an eye image; 0: derived from the windows
  std::optional<double> frame_budget_ms;        // time per frame; 0: none; empty: depending on the device
  double comfort_deg = 1;                       // largest deviation of the eyes' convergence from that for the wall
  std::string saved_folder = ".";               // receives the saved pictures
  const char* keys_hint = "F1 shows the keys";  // end of the log's line on the picture
  bool validate = false;                        // true: validation of every Vulkan call
  render::PanelContrast contrast = render::PanelContrast::Normal;
  render::Swap swap = render::Swap::Alone;  // synchronisation with the other machines of a wall
  std::string instructor;                   // place of the instructor's window, for open_window(); empty: none
};

}  // namespace afm::app
