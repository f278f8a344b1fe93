// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/display/view_outputs.h"
#include "render/window.h"

namespace afm::app {

struct ViewEvent {
  std::size_t window = 0;
  render::WindowEvent event;
};

// Input from all windows since the last call.
struct ViewInput {
  std::vector<ViewEvent> events;
  std::size_t window = 0;  // window under the cursor most recently
  glm::dvec2 cursor_px{0.0};
  bool close_requested = false;
};

// The windows of the live view, which share one person's input. Main thread only.
class ViewWindows {
 public:
  // Fails as render::Window::open does; the error names the output.
  static core::Result<ViewWindows> open(const std::vector<ViewOutput>& outputs);

  // Returns at once. Logs lost and returning monitors.
  ViewInput poll();

  std::size_t count() const { return windows_.size(); }
  render::Window& at(std::size_t window) const { return *windows_[window]; }
  std::vector<render::Window*> all() const;
  bool hidden() const;  // all of them are invisible

  // Windows whose screen contains a point of the room.
  std::vector<render::Window*> that_show(const glm::dvec3& point_m) const;

  // Switches all windows that have no rectangle in the wall file.
  void toggle_full_screen();

  // Converts a point in a window to desktop coordinates, for a drag from one window into another.
  glm::dvec2 on_desktop(std::size_t window, const glm::dvec2& cursor_px) const;

 private:
  void log_monitor_change(std::size_t window, const render::WindowInput& input) const;
  void log_refusal(std::size_t window, const scene::PixelRect& place) const;

  std::vector<std::unique_ptr<render::Window>> windows_;
  std::vector<scene::Screen> screens_;
  std::vector<std::string> names_;                      // names of the outputs in the wall file
  std::vector<std::optional<scene::PixelRect>> rects_;  // rectangles of the outputs; empty: none in the wall file
  std::vector<glm::dvec2> cursors_;                     // cursor in each window
  std::vector<glm::dvec2> origins_;                     // position of each window on the desktop
  std::size_t window_ = 0;
};

}  // namespace afm::app
