// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "render/key.h"
#include "scene/display/wall.h"

namespace afm::render {

enum class MouseButton { Left, Middle, Right };

// An input event and the position of the cursor, in pixels from the top left corner of the window's picture.
struct WindowEvent {
  enum class Kind { KeyDown, KeyUp, ButtonDown, ButtonUp, Scroll } kind = Kind::KeyDown;
  Key key = Key::Other;
  MouseButton button = MouseButton::Left;
  double scroll = 0;  // wheel steps, positive away from the user
  glm::dvec2 cursor_px{0.0};
};

struct WindowInput {
  std::vector<WindowEvent> events;  // events since the last poll, in order
  glm::dvec2 cursor_px{0.0};
  glm::dvec2 origin_px{0.0};     // top left corner of the picture on the desktop; 0,0 if unknown
  bool close_requested = false;  // true: the window's own close button was pressed

  // Loss or return of the monitor that the window fills, or of those under its rectangle. Without its monitor, the
  // window continues at a small size on another.
  enum class MonitorChange { None, Lost, Back } monitor_change = MonitorChange::None;
  std::string monitor;  // name of the monitor in `monitor_change`; empty: one under the rectangle

  // Place at which a window manager keeps the window instead of its rectangle; reported once.
  std::optional<scene::PixelRect> refused_place{};
};

struct WindowOptions {
  std::string title;
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
  bool full_screen = false;
  bool hidden = false;
  std::string monitor{};                       // name of the monitor to fill, as in list_monitors(); empty: any
  std::optional<glm::ivec2> monitor_corner{};  // corner that distinguishes monitors of the same name, in desktop units
  std::optional<scene::PixelRect> rect{};      // rectangle on the desktop, without a frame; replaces width and height
};

class WindowHandle;

// Opens the display, and asks an invisible window on it for its picture formats. DeviceMissing as Window::open and
// Presenter::create, with the reason why `view` would have no window. Main thread only.
core::Result<void> check_display();

// Empty window on this machine's display; Presenter draws into it. Main thread only. Must outlive the Context opened to
// present to it.
class Window {
 public:
  // DeviceMissing: no display, no monitor of that name, or a window system without Vulkan or without window positions.
  static core::Result<Window> open(const WindowOptions& options);

  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  // Events since the last call. Does not wait. Throws DeviceFailure if the display has gone.
  WindowInput poll();

  // Waits until something happens, for at most `seconds`; used while nobody sees the window.
  void wait(double seconds);

  // Size of the picture in pixels; 0 x 0 while minimised.
  glm::uvec2 size_px() const;

  bool full_screen() const;
  void set_full_screen(bool full_screen);  // fills the monitor that shows most of it; no effect with a `rect`

  // Labels of the keys A to Z in the layout in use, 26 characters of UTF-8: the letter or, if the layout lacks it,
  // the label of its key. Empty if it lacks none.
  std::string letters() const;

  // Refresh rate of the monitor; 60 if unknown.
  double refresh_hz() const;

  WindowHandle& handle() { return *handle_; }

 private:
  explicit Window(std::unique_ptr<WindowHandle> handle);
  std::unique_ptr<WindowHandle> handle_;
};

}  // namespace afm::render
