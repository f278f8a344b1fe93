// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "device/vulkan.h"
#include "output/window_system.h"
#include "render/window.h"

namespace afm::render {

// Implementation of Window. Never moved, because GLFW keeps its address.
class WindowHandle {
 public:
  static core::Result<std::unique_ptr<WindowHandle>> open(const WindowOptions& options);
  WindowHandle(const WindowHandle&) = delete;
  WindowHandle& operator=(const WindowHandle&) = delete;
  ~WindowHandle();

  // Throws vk::SystemError if vkCreate...SurfaceKHR fails.
  vk::raii::SurfaceKHR create_surface(const vk::raii::Instance& instance) const;

  WindowInput poll();
  void wait(double seconds);
  glm::uvec2 size_px() const;
  // Position of the picture's first pixel on the monitor that shows most of it; 0,0 if the window system does not
  // reveal it.
  glm::ivec2 screen_px() const;
  bool full_screen() const { return glfwGetWindowMonitor(window_) != nullptr; }
  void set_full_screen(bool full_screen);
  double refresh_hz() const;

  // Number of the window on its X server; none elsewhere.
  std::optional<std::uint32_t> x_window() const;

 private:
  explicit WindowHandle(WindowSystem system) : system_(std::move(system)) {}
  core::Result<void> place(const WindowOptions& options);
  GLFWmonitor* monitor() const;
  glm::dvec2 pixels_per_unit() const;
  void fill(GLFWmonitor* monitor);
  WindowInput::MonitorChange follow_monitor();
  WindowInput::MonitorChange follow_rect();
  void follow_mode();
  void keep_rect();
  void become_small();
  void fill_rect();
  glm::dvec2 picture_px(const glm::dvec2& place) const;
  void add(WindowEvent event);
  static WindowHandle& of(GLFWwindow* window);
  static void on_key(GLFWwindow* window, int code, int scancode, int action, int modifiers);
  static void on_typed(GLFWwindow* window, unsigned sign);
  static void on_button(GLFWwindow* window, int button, int action, int modifiers);
  static void on_move(GLFWwindow* window, double x, double y);
  static void on_scroll(GLFWwindow* window, double x, double y);

  WindowSystem system_;
  GLFWwindow* window_ = nullptr;
  std::optional<scene::PixelRect> rect_;                        // placed rectangle, restored when a monitor is back
  unsigned monitor_changes_ = WindowSystem::monitor_changes();  // count last seen by follow_rect()
  std::optional<scene::PixelRect> refused_place_;  // place that the window manager insists on, until the next poll
  int refills_ = 0;                                // number of successive attempts to place the window
  double last_refill_s_ = 0, next_look_s_ = 0;     // times on GLFW's clock
  std::string full_on_;                            // filled monitor, filled again when it is back; empty: a window
  glm::ivec2 full_corner_{0};                      // corner of the filled monitor on the desktop
  glm::ivec2 full_size_{0};                        // size of that monitor's mode when it was filled
  bool monitor_lost_ = false;
  std::vector<WindowEvent> events_;
  struct Pressed {
    int code, scancode;
  };
  std::optional<Pressed> pressed_;  // newest event, if it is a key whose typed sign may follow
  std::map<int, Key> held_;         // keys that are down, by scancode
  glm::dvec2 cursor_{0.0};          // place after the newest event, in desktop units: GLFW only knows the current one
  int windowed_x_ = 0, windowed_y_ = 0, windowed_width_ = 0, windowed_height_ = 0;  // restored after full screen
};

}  // namespace afm::render
