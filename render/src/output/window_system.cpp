// SPDX-License-Identifier: Apache-2.0
#include "output/window_system.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdarg>
#include <span>
#include <string_view>
#include <utility>

#include "render/device_failure.h"
#include "render/monitor.h"

namespace afm::render {

std::string window_system_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason given" : text;
}

namespace {

#ifdef GLFW_PLATFORM  // GLFW 3.4 and later

// Prevents libwayland from printing a second line next to our error when there is no Wayland.
void silence_wayland() {
  using Log = void (*)(const char* format, std::va_list values);
  void* const wayland = ::dlopen("libwayland-client.so.0", RTLD_LAZY);  // library kept open for the setting
  if (wayland == nullptr) return;
  const auto set_log = reinterpret_cast<void (*)(Log)>(::dlsym(wayland, "wl_log_set_handler_client"));
  if (set_log != nullptr) set_log([](const char*, std::va_list) {});
}

// GLFW would prefer Wayland, which does not let a program place its windows on the projectors; X11 works there too.
bool begin_glfw() {
  glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
  if (glfwInit() == GLFW_TRUE) return true;
  silence_wayland();
  glfwInitHint(GLFW_PLATFORM, GLFW_ANY_PLATFORM);
  return glfwInit() == GLFW_TRUE;
}

#else

bool begin_glfw() { return glfwInit() == GLFW_TRUE; }

#endif

}  // namespace

core::Result<WindowSystem> WindowSystem::join() {
  if (!begin_glfw()) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         "cannot open a window (" + window_system_error() +
                             "): run this on a desktop, with DISPLAY or WAYLAND_DISPLAY set");
  }
  if (++shares_ == 1) {
    outlive_the_display();
    glfwSetMonitorCallback([](GLFWmonitor*, int) { ++monitor_changes_; });
  }
  return WindowSystem();
}

WindowSystem::WindowSystem(WindowSystem&& other) noexcept : joined_(std::exchange(other.joined_, false)) {}

WindowSystem& WindowSystem::operator=(WindowSystem&& other) noexcept {
  std::swap(joined_, other.joined_);
  return *this;
}

WindowSystem::~WindowSystem() {
  if (joined_ && --shares_ == 0) glfwTerminate();
}

void WindowSystem::expect_display() {
  if (lost_) throw DeviceFailure("the display and its window were lost: check the X server and start again");
}

// Keeps the process alive when the X connection breaks: Xlib ends it unless two handlers return, a global one and one
// for our connection (libX11 1.7 and later). The functions are looked up in the library that GLFW has loaded, because
// GLFW's Wayland build has none of them, and GLFW 3.4 loads libX11 itself.
void WindowSystem::outlive_the_display() {
  using OnError = int (*)(void* display);
  using OnExit = void (*)(void* display, void* data);
  void* const x11 = ::dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);  // never closed: the setting remains
  const auto get_display = reinterpret_cast<void* (*)()>(::dlsym(RTLD_DEFAULT, "glfwGetX11Display"));
  if (x11 == nullptr || get_display == nullptr) return;
  void* const display = get_display();
  const auto set_on_error = reinterpret_cast<OnError (*)(OnError)>(::dlsym(x11, "XSetIOErrorHandler"));
  const auto set_on_exit = reinterpret_cast<void (*)(void*, OnExit, void*)>(::dlsym(x11, "XSetIOErrorExitHandler"));
  if (display == nullptr || set_on_error == nullptr || set_on_exit == nullptr) return;
  lost_ = false;
  set_on_error([](void*) {
    lost_ = true;
    return 0;
  });
  set_on_exit(display, [](void*, void*) {}, nullptr);
}

core::Result<std::vector<Monitor>> list_monitors() {
  const auto system = WindowSystem::join();
  if (!system) return tl::unexpected(system.error());
  int count = 0;
  GLFWmonitor** const all = glfwGetMonitors(&count);
  std::vector<Monitor> monitors;
  for (GLFWmonitor* one : std::span(all, static_cast<std::size_t>(count))) {
    Monitor monitor{.name = glfwGetMonitorName(one), .rect = {}};
    glfwGetMonitorPos(one, &monitor.rect.offset_px.x, &monitor.rect.offset_px.y);
    if (const GLFWvidmode* mode = glfwGetVideoMode(one)) {
      monitor.rect.size_px = {static_cast<unsigned>(mode->width), static_cast<unsigned>(mode->height)};
      monitor.rate_hz = mode->refreshRate;
    }
    monitors.push_back(std::move(monitor));
  }
  return monitors;
}

const Monitor* find_monitor(const std::vector<Monitor>& monitors, const std::string& name_or_number) {
  for (const Monitor& monitor : monitors) {
    if (monitor.name == name_or_number) return &monitor;
  }
  std::size_t number = 0;
  const char* const end = name_or_number.data() + name_or_number.size();
  const auto read = std::from_chars(name_or_number.data(), end, number);
  const bool counted = read.ec == std::errc() && read.ptr == end && number >= 1 && number <= monitors.size();
  return counted ? &monitors[number - 1] : nullptr;
}

bool is_shown(const scene::PixelRect& rect, const std::vector<Monitor>& monitors) {
  const glm::ivec2 first = rect.offset_px, last = first + glm::ivec2(rect.size_px) - 1;
  const std::array corners{first, glm::ivec2(last.x, first.y), glm::ivec2(first.x, last.y), last};
  return std::all_of(corners.begin(), corners.end(), [&](const glm::ivec2& corner) {
    return std::any_of(monitors.begin(), monitors.end(), [&](const Monitor& monitor) {
      const glm::ivec2 inside = corner - monitor.rect.offset_px, size(monitor.rect.size_px);
      return inside.x >= 0 && inside.y >= 0 && inside.x < size.x && inside.y < size.y;
    });
  });
}

bool can_place_windows() {
#ifdef GLFW_PLATFORM_WAYLAND
  return glfwGetPlatform() != GLFW_PLATFORM_WAYLAND;
#else  // GLFW 3.3 supports one window system
  return std::string_view(glfwGetVersionString()).find("Wayland") == std::string_view::npos;
#endif
}

}  // namespace afm::render
