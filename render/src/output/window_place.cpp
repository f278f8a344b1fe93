// SPDX-License-Identifier: Apache-2.0
// Position of a window on its desktop, and the means of keeping it there.
#include <algorithm>
#include <span>
#include <utility>

#include "output/window_handle.h"
#include "render/monitor.h"

namespace afm::render {
namespace {

constexpr double kLeftOver = 0.75;      // fraction of each side of another monitor, used when a window's own has gone
constexpr double kRefillS = 0.1;        // between two attempts to place a window: a manager answers within that
constexpr int kMostRefills = 20;        // limit on successive attempts; then the manager has refused
constexpr double kKeptS = 2.0;          // time in place after which a move is a new one
constexpr double kLookForModeS = 0.25;  // interval between two queries of a monitor's mode, which ask the X server

glm::ivec2 corner_of(GLFWmonitor* monitor) {
  glm::ivec2 corner(0);
  glfwGetMonitorPos(monitor, &corner.x, &corner.y);
  return corner;
}

// Monitor of this name; of several, the one at that corner; null if there is none.
GLFWmonitor* monitor_named(const std::string& name, const std::optional<glm::ivec2>& corner) {
  int count = 0;
  GLFWmonitor** const monitors = glfwGetMonitors(&count);
  GLFWmonitor* found = nullptr;
  for (GLFWmonitor* candidate : std::span(monitors, static_cast<std::size_t>(count))) {
    if (name != glfwGetMonitorName(candidate)) continue;
    if (corner == corner_of(candidate)) return candidate;
    if (found == nullptr) found = candidate;
  }
  return found;
}

}  // namespace

core::Result<void> WindowHandle::place(const WindowOptions& options) {
  if (options.rect) {
    if (!can_place_windows()) {
      return core::failure(core::ErrorCategory::DeviceMissing,
                           "a Wayland desktop does not let programs place their windows: name a monitor instead of a "
                           "rectangle, or log in to an X11 session");
    }
    rect_ = options.rect;
    glfwSetWindowPos(window_, rect_->offset_px.x, rect_->offset_px.y);  // some managers keep what is set before mapping
    fill_rect();
    glfwShowWindow(window_);
    return {};
  }
  if (options.monitor.empty()) {
    if (options.full_screen) set_full_screen(true);
    return {};
  }
  GLFWmonitor* const wanted = monitor_named(options.monitor, options.monitor_corner);
  if (wanted == nullptr)
    return core::failure(core::ErrorCategory::DeviceMissing, "there is no monitor \"" + options.monitor + "\" here");
  fill(wanted);
  return {};
}

WindowInput::MonitorChange WindowHandle::follow_monitor() {
  if (rect_) return follow_rect();
  if (full_on_.empty()) return WindowInput::MonitorChange::None;
  if (full_screen()) {
    follow_mode();
    return WindowInput::MonitorChange::None;
  }
  if (!monitor_lost_) {
    monitor_lost_ = true;
    become_small();
    return WindowInput::MonitorChange::Lost;
  }
  GLFWmonitor* const back = monitor_named(full_on_, full_corner_);
  if (back == nullptr) return WindowInput::MonitorChange::None;
  fill(back);
  return WindowInput::MonitorChange::Back;
}

// Fits a full window to a monitor that has changed its mode, which nobody else does without a window manager.
void WindowHandle::follow_mode() {
  const double now_s = glfwGetTime();
  if (now_s < next_look_s_) return;
  next_look_s_ = now_s + kLookForModeS;
  GLFWmonitor* const on = glfwGetWindowMonitor(window_);
  const GLFWvidmode* const mode = glfwGetVideoMode(on);
  if (mode == nullptr || glm::ivec2(mode->width, mode->height) == full_size_) return;
  full_size_ = {mode->width, mode->height};
  glfwSetWindowMonitor(window_, on, 0, 0, mode->width, mode->height, mode->refreshRate);
}

// A window manager may place a window anew when it is mapped, when the manager starts, or for a user.
void WindowHandle::keep_rect() {
  const double now_s = glfwGetTime();
  if (now_s < next_look_s_ || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE || WindowSystem::lost()) return;
  next_look_s_ = now_s + kRefillS;
  scene::PixelRect place;
  glm::ivec2 size(0);
  glfwGetWindowPos(window_, &place.offset_px.x, &place.offset_px.y);
  glfwGetWindowSize(window_, &size.x, &size.y);
  if (WindowSystem::lost()) return;
  place.size_px = size;
  if (place.offset_px == rect_->offset_px && place.size_px == rect_->size_px) {
    if (now_s - last_refill_s_ > kKeptS) refills_ = 0;
    return;
  }
  if (refills_ > kMostRefills) return;
  if (++refills_ > kMostRefills) {
    refused_place_ = place;
    return;
  }
  last_refill_s_ = now_s;
  fill_rect();
}

// Querying monitor positions is slow, so this does it only when one came or went, or the window waits for one.
WindowInput::MonitorChange WindowHandle::follow_rect() {
  const unsigned changes = WindowSystem::monitor_changes();
  const bool changed = std::exchange(monitor_changes_, changes) != changes;
  if (!changed && !monitor_lost_) {
    keep_rect();
    return WindowInput::MonitorChange::None;
  }
  const auto monitors = list_monitors();
  const bool lost = !monitors || !is_shown(*rect_, *monitors);
  if (std::exchange(monitor_lost_, lost) == lost) return WindowInput::MonitorChange::None;
  if (lost) {
    become_small();
    return WindowInput::MonitorChange::Lost;
  }
  fill_rect();
  return WindowInput::MonitorChange::Back;
}

// Moves the window onto a remaining monitor, wherever it was when its own monitor went.
void WindowHandle::become_small() {
  GLFWmonitor* const left = glfwGetPrimaryMonitor();
  const GLFWvidmode* const mode = left == nullptr ? nullptr : glfwGetVideoMode(left);
  if (mode == nullptr) return;
  const glm::ivec2 whole(mode->width, mode->height), size(kLeftOver * glm::dvec2(whole));
  glm::ivec2 corner(0);
  glfwGetMonitorPos(left, &corner.x, &corner.y);
  corner += (whole - size) / 2;
  glfwSetWindowMonitor(window_, nullptr, corner.x, corner.y, size.x, size.y, 0);
}

void WindowHandle::fill_rect() {
  const glm::ivec2 size(rect_->size_px);
  glfwSetWindowMonitor(window_, nullptr, rect_->offset_px.x, rect_->offset_px.y, size.x, size.y, 0);
}

// Monitor that shows the largest part of the window.
GLFWmonitor* WindowHandle::monitor() const {
  if (WindowSystem::lost()) return nullptr;
  if (GLFWmonitor* current = glfwGetWindowMonitor(window_)) {
    return current;
  }
  int x = 0, y = 0, width = 0, height = 0, count = 0;
  glfwGetWindowPos(window_, &x, &y);
  glfwGetWindowSize(window_, &width, &height);
  GLFWmonitor* best = glfwGetPrimaryMonitor();
  int best_area = 0;
  GLFWmonitor** const monitors = glfwGetMonitors(&count);
  for (GLFWmonitor* candidate : std::span(monitors, static_cast<std::size_t>(count))) {
    const GLFWvidmode* mode = glfwGetVideoMode(candidate);
    if (mode == nullptr) {
      continue;
    }
    int left = 0, top = 0;
    glfwGetMonitorPos(candidate, &left, &top);
    const int shared_width = std::min(x + width, left + mode->width) - std::max(x, left);
    const int shared_height = std::min(y + height, top + mode->height) - std::max(y, top);
    const int area = std::max(shared_width, 0) * std::max(shared_height, 0);
    if (area > best_area) {
      best = candidate;
      best_area = area;
    }
  }
  return best;
}

void WindowHandle::fill(GLFWmonitor* monitor) {
  const GLFWvidmode* const mode = glfwGetVideoMode(monitor);
  if (mode == nullptr) {
    return;
  }
  glfwGetWindowPos(window_, &windowed_x_, &windowed_y_);
  glfwGetWindowSize(window_, &windowed_width_, &windowed_height_);
  full_on_ = glfwGetMonitorName(monitor);
  full_corner_ = corner_of(monitor);
  full_size_ = {mode->width, mode->height};
  monitor_lost_ = false;
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void WindowHandle::set_full_screen(bool wanted) {
  if (wanted == full_screen() || rect_ || WindowSystem::lost()) {
    return;
  }
  if (!wanted) {
    full_on_.clear();
    glfwSetWindowMonitor(window_, nullptr, windowed_x_, windowed_y_, windowed_width_, windowed_height_, 0);
  } else if (GLFWmonitor* const screen = monitor()) {
    fill(screen);
  }
}

}  // namespace afm::render
