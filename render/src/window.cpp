// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <glm/common.hpp>
#include <span>
#include <utility>

#include "window_handle.h"

namespace afm::render {
namespace {

constexpr double kRefreshHz = 60.0;

constexpr auto kNoWindow = core::ErrorCategory::DeviceMissing;

// GLFW's words for its last failure on this thread.
std::string glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason given" : text;
}

Key key_of(int key) {
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) {
    return static_cast<Key>(static_cast<int>(Key::Digit1) + key - GLFW_KEY_1);
  }
  switch (key) {
    case GLFW_KEY_ESCAPE:
      return Key::Escape;
    case GLFW_KEY_SPACE:
      return Key::Space;
    case GLFW_KEY_F1:
      return Key::F1;
    case GLFW_KEY_F2:
      return Key::F2;
    case GLFW_KEY_F11:
      return Key::F11;
    case GLFW_KEY_H:
      return Key::H;
    case GLFW_KEY_A:
      return Key::A;
    case GLFW_KEY_J:
      return Key::J;
    case GLFW_KEY_B:
      return Key::B;
    case GLFW_KEY_C:
      return Key::C;
    case GLFW_KEY_G:
      return Key::G;
    case GLFW_KEY_V:
      return Key::V;
    case GLFW_KEY_LEFT_BRACKET:
      return Key::LeftBracket;
    case GLFW_KEY_RIGHT_BRACKET:
      return Key::RightBracket;
    case GLFW_KEY_M:
      return Key::M;
    case GLFW_KEY_P:
      return Key::P;
    case GLFW_KEY_R:
      return Key::R;
    case GLFW_KEY_S:
      return Key::S;
    case GLFW_KEY_T:
      return Key::T;
    default:
      return Key::Other;
  }
}

}  // namespace

std::vector<const char*> surface_extensions() {
  std::uint32_t count = 0;
  const char* const* names = glfwGetRequiredInstanceExtensions(&count);
  return {names, names + count};
}

bool can_present(const vk::raii::Instance& instance, const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
  return glfwGetPhysicalDevicePresentationSupport(*instance, *physical, family) == GLFW_TRUE;
}

core::Result<std::unique_ptr<WindowHandle>> WindowHandle::open(const WindowOptions& options) {
  if (glfwInit() != GLFW_TRUE) {
    return core::failure(kNoWindow, "cannot open a window (" + glfw_error() +
                                        "): run this on a desktop, with DISPLAY or WAYLAND_DISPLAY set");
  }
  std::unique_ptr<WindowHandle> handle(new WindowHandle());  // from here on its destructor ends GLFW
  ++open_windows_;
  if (glfwVulkanSupported() != GLFW_TRUE) {
    return core::failure(
        kNoWindow, "this display cannot show Vulkan pictures (" + glfw_error() + "): install mesa-vulkan-drivers");
  }
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);  // a wall stays full when its operator looks at another screen
  handle->window_ = glfwCreateWindow(static_cast<int>(options.width), static_cast<int>(options.height),
                                     options.title.c_str(), nullptr, nullptr);
  if (handle->window_ == nullptr) {
    return core::failure(kNoWindow, "cannot open a window of " + std::to_string(options.width) + "x" +
                                        std::to_string(options.height) + " pixels: " + glfw_error());
  }
  glfwSetWindowUserPointer(handle->window_, handle.get());
  glfwSetKeyCallback(handle->window_, on_key);
  glfwSetMouseButtonCallback(handle->window_, on_button);
  glfwSetCursorPosCallback(handle->window_, on_move);
  glfwSetScrollCallback(handle->window_, on_scroll);
  glfwGetCursorPos(handle->window_, &handle->cursor_.x, &handle->cursor_.y);
  if (options.full_screen) {
    handle->set_full_screen(true);
  }
  return handle;
}

WindowHandle::~WindowHandle() {
  if (window_ != nullptr) {
    glfwDestroyWindow(window_);
  }
  if (--open_windows_ == 0) {
    glfwTerminate();
  }
}

vk::raii::SurfaceKHR WindowHandle::create_surface(const vk::raii::Instance& instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  const VkResult result = glfwCreateWindowSurface(*instance, window_, nullptr, &surface);
  vk::resultCheck(static_cast<vk::Result>(result), "glfwCreateWindowSurface");
  return vk::raii::SurfaceKHR(instance, surface);
}

WindowInput WindowHandle::poll() {
  glfwPollEvents();
  return {.events = std::exchange(events_, {}),
          .cursor_px = picture_px(cursor_),
          .close_requested = glfwWindowShouldClose(window_) == GLFW_TRUE};
}

void WindowHandle::wait(double seconds) { glfwWaitEventsTimeout(seconds); }

glm::uvec2 WindowHandle::size_px() const {
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE) {
    return {0, 0};
  }
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return {static_cast<unsigned>(std::max(width, 0)), static_cast<unsigned>(std::max(height, 0))};
}

// The cursor comes in the units of the desktop, which some window systems scale.
glm::dvec2 WindowHandle::picture_px(const glm::dvec2& place) const {
  int width = 0;
  int height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return place * glm::dvec2(size_px()) / glm::dvec2(std::max(width, 1), std::max(height, 1));
}

// The monitor that shows the largest part of the window.
GLFWmonitor* WindowHandle::monitor() const {
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

void WindowHandle::set_full_screen(bool wanted) {
  GLFWmonitor* const screen = monitor();
  const GLFWvidmode* const mode = screen == nullptr ? nullptr : glfwGetVideoMode(screen);
  if (wanted == full_screen() || mode == nullptr) {
    return;
  }
  if (wanted) {
    glfwGetWindowPos(window_, &windowed_x_, &windowed_y_);
    glfwGetWindowSize(window_, &windowed_width_, &windowed_height_);
    glfwSetWindowMonitor(window_, screen, 0, 0, mode->width, mode->height, mode->refreshRate);
  } else {
    glfwSetWindowMonitor(window_, nullptr, windowed_x_, windowed_y_, windowed_width_, windowed_height_, 0);
  }
}

glm::ivec2 WindowHandle::screen_px() const {
  GLFWmonitor* const screen = monitor();
  int x = 0, y = 0, left = 0, top = 0, width = 0, height = 0;
  glfwGetWindowPos(window_, &x, &y);
  glfwGetWindowSize(window_, &width, &height);
  if (screen == nullptr || width <= 0 || height <= 0) {
    return glm::ivec2(0);
  }
  glfwGetMonitorPos(screen, &left, &top);
  // places are in the desktop's units, which are not always pixels
  const glm::dvec2 pixels_per_unit = glm::dvec2(size_px()) / glm::dvec2(width, height);
  return glm::ivec2(glm::round(glm::dvec2(x - left, y - top) * pixels_per_unit));
}

double WindowHandle::refresh_hz() const {
  GLFWmonitor* const screen = monitor();
  const GLFWvidmode* const mode = screen == nullptr ? nullptr : glfwGetVideoMode(screen);
  return mode == nullptr || mode->refreshRate <= 0 ? kRefreshHz : mode->refreshRate;
}

WindowHandle& WindowHandle::of(GLFWwindow* window) {
  return *static_cast<WindowHandle*>(glfwGetWindowUserPointer(window));
}

void WindowHandle::add(WindowEvent event) {
  event.cursor_px = picture_px(cursor_);
  events_.push_back(event);
}

void WindowHandle::on_key(GLFWwindow* window, int key, int, int action, int) {
  if (action == GLFW_REPEAT) {
    return;
  }
  of(window).add(
      {.kind = action == GLFW_PRESS ? WindowEvent::Kind::KeyDown : WindowEvent::Kind::KeyUp, .key = key_of(key)});
}

void WindowHandle::on_button(GLFWwindow* window, int button, int action, int) {
  if (button > GLFW_MOUSE_BUTTON_MIDDLE) {
    return;
  }
  of(window).add({.kind = action == GLFW_PRESS ? WindowEvent::Kind::ButtonDown : WindowEvent::Kind::ButtonUp,
                  .button = button == GLFW_MOUSE_BUTTON_LEFT    ? MouseButton::Left
                            : button == GLFW_MOUSE_BUTTON_RIGHT ? MouseButton::Right
                                                                : MouseButton::Middle});
}

void WindowHandle::on_move(GLFWwindow* window, double x, double y) { of(window).cursor_ = {x, y}; }

void WindowHandle::on_scroll(GLFWwindow* window, double, double y) {
  of(window).add({.kind = WindowEvent::Kind::Scroll, .scroll = y});
}

Window::Window(std::unique_ptr<WindowHandle> handle) : handle_(std::move(handle)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

core::Result<Window> Window::open(const WindowOptions& options) {
  auto handle = WindowHandle::open(options);
  if (!handle) {
    return tl::unexpected(handle.error());
  }
  return Window(std::move(*handle));
}

WindowInput Window::poll() { return handle_->poll(); }
void Window::wait(double seconds) { handle_->wait(seconds); }
glm::uvec2 Window::size_px() const { return handle_->size_px(); }
bool Window::full_screen() const { return handle_->full_screen(); }
void Window::set_full_screen(bool full_screen) { handle_->set_full_screen(full_screen); }
double Window::refresh_hz() const { return handle_->refresh_hz(); }

}  // namespace afm::render
