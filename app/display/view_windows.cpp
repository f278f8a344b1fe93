// SPDX-License-Identifier: Apache-2.0
#include "app/display/view_windows.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/log.h"

namespace afm::app {

core::Result<ViewWindows> ViewWindows::open(const std::vector<ViewOutput>& outputs) {
  ViewWindows windows;
  for (const ViewOutput& output : outputs) {
    auto window = render::Window::open(output.window);
    if (!window) {
      const std::string who = output.name.empty() ? "" : fmt::format("output \"{}\": ", output.name);
      return core::failure(window.error().category, who + window.error().message);
    }
    windows.windows_.push_back(std::make_unique<render::Window>(std::move(*window)));
    windows.screens_.push_back(output.screen);
    windows.names_.push_back(output.name);
    windows.rects_.push_back(output.window.rect);
  }
  windows.cursors_.resize(outputs.size());
  windows.origins_.resize(outputs.size());
  return windows;
}

ViewInput ViewWindows::poll() {
  ViewInput all;
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    render::WindowInput input = windows_[i]->poll();
    origins_[i] = input.origin_px;
    if (std::exchange(cursors_[i], input.cursor_px) != input.cursor_px || !input.events.empty()) window_ = i;
    for (render::WindowEvent& event : input.events) all.events.push_back({i, event});
    all.close_requested = all.close_requested || input.close_requested;
    if (input.monitor_change != render::WindowInput::MonitorChange::None) log_monitor_change(i, input);
    if (input.refused_place) log_refusal(i, *input.refused_place);
  }
  all.window = window_;
  all.cursor_px = cursors_[window_];
  return all;
}

void ViewWindows::log_monitor_change(std::size_t window, const render::WindowInput& input) const {
  const std::string what =
      rects_[window] ? fmt::format("output \"{}\": its monitor", names_[window]) : "monitor " + input.monitor;
  const bool lost = input.monitor_change == render::WindowInput::MonitorChange::Lost;
  core::log_line(fmt::format("{} is {}", what,
                             lost ? "lost; the window continues at a small size until the monitor returns"
                                  : "back; the window fills its place again"));
}

void ViewWindows::log_refusal(std::size_t window, const scene::PixelRect& place) const {
  const scene::PixelRect& wanted = *rects_[window];
  core::log_line(
      fmt::format("output \"{}\": the window manager keeps its window of {} x {} pixels at {}, {}, although the "
                  "wall file says {} x {} pixels at {}, {}: exclude TouchAFM from the manager's placement, or "
                  "run the wall without a manager",
                  names_[window], place.size_px.x, place.size_px.y, place.offset_px.x, place.offset_px.y,
                  wanted.size_px.x, wanted.size_px.y, wanted.offset_px.x, wanted.offset_px.y));
}

std::vector<render::Window*> ViewWindows::all() const {
  std::vector<render::Window*> all;
  all.reserve(windows_.size());
  for (const auto& window : windows_) all.push_back(window.get());
  return all;
}

std::vector<render::Window*> ViewWindows::that_show(const glm::dvec3& point_m) const {
  std::vector<render::Window*> found;
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    if (holds(screens_[i], point_m)) found.push_back(windows_[i].get());
  }
  return found;
}

bool ViewWindows::hidden() const {
  return std::all_of(windows_.begin(), windows_.end(), [](const auto& window) { return window->size_px().x == 0; });
}

void ViewWindows::toggle_full_screen() {
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    if (!rects_[i]) windows_[i]->set_full_screen(!windows_[i]->full_screen());
  }
  if (std::all_of(rects_.begin(), rects_.end(), [](const auto& rect) { return rect.has_value(); })) {
    core::log_line("the wall file fixes the positions of the windows");
  }
}

glm::dvec2 ViewWindows::on_desktop(std::size_t window, const glm::dvec2& cursor_px) const {
  return origins_[window] + cursor_px;
}

}  // namespace afm::app
