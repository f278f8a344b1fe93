// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>

#include <algorithm>
#include <glm/common.hpp>
#include <span>
#include <utility>

#include "output/window_handle.h"
#include "output/window_keys.h"
#include "render/monitor.h"

namespace afm::render {
namespace {

constexpr double kRefreshHz = 60.0;

constexpr auto kNoWindow = core::ErrorCategory::DeviceMissing;

std::string label_of_key(int code) {
  const char* const label = glfwGetKeyName(code, 0);
  return label == nullptr ? std::string() : label;
}

}  // namespace

core::Result<std::unique_ptr<WindowHandle>> WindowHandle::open(const WindowOptions& options) {
  auto system = WindowSystem::join();
  if (!system) return tl::unexpected(system.error());
  std::unique_ptr<WindowHandle> handle(new WindowHandle(std::move(*system)));
  if (glfwVulkanSupported() != GLFW_TRUE) {
    return core::failure(
        kNoWindow, "this display does not support Vulkan (" + window_system_error() + "): install mesa-vulkan-drivers");
  }
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);  // full screen kept even while the operator uses another screen
  glfwWindowHint(GLFW_DECORATED, options.rect ? GLFW_FALSE : GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE,
                 options.rect || options.hidden ? GLFW_FALSE : GLFW_TRUE);  // hidden until it is in position
  const glm::uvec2 size = options.rect ? options.rect->size_px : glm::uvec2(options.width, options.height);
  handle->window_ =
      glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y), options.title.c_str(), nullptr, nullptr);
  if (handle->window_ == nullptr) {
    return core::failure(kNoWindow, "cannot open a window of " + std::to_string(size.x) + "x" + std::to_string(size.y) +
                                        " pixels: " + window_system_error());
  }
  glfwSetWindowUserPointer(handle->window_, handle.get());
  glfwSetKeyCallback(handle->window_, on_key);
  glfwSetCharCallback(handle->window_, on_typed);
  glfwSetMouseButtonCallback(handle->window_, on_button);
  glfwSetCursorPosCallback(handle->window_, on_move);
  glfwSetScrollCallback(handle->window_, on_scroll);
  glfwGetCursorPos(handle->window_, &handle->cursor_.x, &handle->cursor_.y);
  if (auto placed = handle->place(options); !placed) return tl::unexpected(placed.error());
  return handle;
}

WindowHandle::~WindowHandle() {
  if (window_ != nullptr) {
    glfwDestroyWindow(window_);
  }
}

vk::raii::SurfaceKHR WindowHandle::create_surface(const vk::raii::Instance& instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  const VkResult result = glfwCreateWindowSurface(*instance, window_, nullptr, &surface);
  if (result != VK_SUCCESS) {
    throw vk::SystemError(vk::make_error_code(static_cast<vk::Result>(result)), "glfwCreateWindowSurface");
  }
  return vk::raii::SurfaceKHR(instance, surface);
}

WindowInput WindowHandle::poll() {
  WindowSystem::expect_display();
  glfwPollEvents();
  WindowSystem::expect_display();
  pressed_.reset();
  int x = 0, y = 0;
  glfwGetWindowPos(window_, &x, &y);
  WindowSystem::expect_display();
  const WindowInput::MonitorChange update = follow_monitor();
  return {.events = std::exchange(events_, {}),
          .cursor_px = picture_px(cursor_),
          .origin_px = glm::dvec2(x, y) * pixels_per_unit(),
          .close_requested = glfwWindowShouldClose(window_) == GLFW_TRUE,
          .monitor_change = update,
          .monitor = update == WindowInput::MonitorChange::None ? std::string() : full_on_,
          .refused_place = std::exchange(refused_place_, std::nullopt)};
}

void WindowHandle::wait(double seconds) {
  WindowSystem::expect_display();
  glfwWaitEventsTimeout(seconds);
}

glm::uvec2 WindowHandle::size_px() const {
  if (WindowSystem::lost() || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE) {
    return {0, 0};
  }
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return {static_cast<unsigned>(std::max(width, 0)), static_cast<unsigned>(std::max(height, 0))};
}

// Pixels per desktop unit. GLFW reports positions in desktop units, which some window systems scale.
glm::dvec2 WindowHandle::pixels_per_unit() const {
  if (WindowSystem::lost()) return glm::dvec2(1.0);
  int width = 0;
  int height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return glm::dvec2(size_px()) / glm::dvec2(std::max(width, 1), std::max(height, 1));
}

glm::dvec2 WindowHandle::picture_px(const glm::dvec2& place) const { return place * pixels_per_unit(); }

glm::ivec2 WindowHandle::screen_px() const {
  GLFWmonitor* const screen = monitor();
  if (screen == nullptr) {
    return glm::ivec2(0);
  }
  int x = 0, y = 0, left = 0, top = 0;
  glfwGetWindowPos(window_, &x, &y);
  glfwGetMonitorPos(screen, &left, &top);
  return glm::ivec2(glm::round(glm::dvec2(x - left, y - top) * pixels_per_unit()));
}

double WindowHandle::refresh_hz() const {
  GLFWmonitor* const screen = monitor();
  const GLFWvidmode* const mode = screen == nullptr ? nullptr : glfwGetVideoMode(screen);
  return mode == nullptr || mode->refreshRate <= 0 ? kRefreshHz : mode->refreshRate;
}

// Number of the window on its X server. Looked up at run time, because GLFW's Wayland build lacks the function.
std::optional<std::uint32_t> WindowHandle::x_window() const {
  const auto get = reinterpret_cast<unsigned long (*)(GLFWwindow*)>(::dlsym(RTLD_DEFAULT, "glfwGetX11Window"));
  const unsigned long window = get == nullptr ? 0 : get(window_);
  return window == 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(window));
}

WindowHandle& WindowHandle::of(GLFWwindow* window) {
  return *static_cast<WindowHandle*>(glfwGetWindowUserPointer(window));
}

void WindowHandle::add(WindowEvent event) {
  event.cursor_px = picture_px(cursor_);
  events_.push_back(event);
  pressed_.reset();
}

// Handles a key event. A key goes up as the key that went down, since its sign is only known then.
void WindowHandle::on_key(GLFWwindow* window, int code, int scancode, int action, int) {
  WindowHandle& self = of(window);
  self.pressed_.reset();
  if (action == GLFW_REPEAT) {
    return;
  }
  if (action == GLFW_PRESS) {
    const Key key = self.held_[scancode] = key_of(code, 0, label_of_key);
    self.add({.kind = WindowEvent::Kind::KeyDown, .key = key});
    self.pressed_ = Pressed{.code = code, .scancode = scancode};
    return;
  }
  const auto held = self.held_.extract(scancode);
  self.add({.kind = WindowEvent::Kind::KeyUp, .key = held ? held.mapped() : key_of(code, 0, label_of_key)});
}

// Handles the sign that a key typed, which GLFW reports right after the key.
void WindowHandle::on_typed(GLFWwindow* window, unsigned sign) {
  WindowHandle& self = of(window);
  if (!self.pressed_) {
    return;
  }
  const Pressed pressed = *std::exchange(self.pressed_, std::nullopt);
  self.events_.back().key = self.held_[pressed.scancode] = key_of(pressed.code, sign, label_of_key);
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
std::string Window::letters() const { return letters_of(label_of_key); }
double Window::refresh_hz() const { return handle_->refresh_hz(); }

}  // namespace afm::render
