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
  double scroll = 0;  // steps of the wheel, positive away from the person
  glm::dvec2 cursor_px{0.0};
};

struct WindowInput {
  std::vector<WindowEvent> events;  // since the last poll, in their order
  glm::dvec2 cursor_px{0.0};
  glm::dvec2 origin_px{0.0};     // where the picture's top left corner lies on the desktop; 0,0 where it is unknown
  bool close_requested = false;  // the window's own close button

  // Change of the monitor that the window fills, or of those under its rectangle. Without its monitor, the window
  // continues at a small size on another.
  enum class MonitorChange { None, Lost, Back } monitor_change = MonitorChange::None;
  std::string monitor;  // that the change is of; empty: under the rectangle
};

struct WindowOptions {
  std::string title;
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
  bool full_screen = false;
  std::string monitor{};                   // to fill, as list_monitors() names it; empty: none in particular
  std::optional<scene::PixelRect> rect{};  // of the desktop, without a frame, instead of width and height
};

class WindowHandle;

// A window on this machine's display, without anything in it: see Presenter. On the main thread only. Must outlive the
// Context that was opened to present to it.
class Window {
 public:
  // DeviceMissing: no display, no monitor of that name, or a window system without Vulkan or without places.
  static core::Result<Window> open(const WindowOptions& options);

  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  // Events since the last call. Does not wait. Throws DeviceFailure if the display has gone.
  WindowInput poll();

  // Waits until something happens, but no longer than `seconds`: for a window that nobody sees.
  void wait(double seconds);

  // Of the picture, in pixels; 0 x 0 while minimised.
  glm::uvec2 size_px() const;

  bool full_screen() const;
  void set_full_screen(bool full_screen);  // on the monitor that shows most of it; not if it has its place by a rect

  // Of the monitor; 60 where it does not say.
  double refresh_hz() const;

  WindowHandle& handle() { return *handle_; }

 private:
  explicit Window(std::unique_ptr<WindowHandle> handle);
  std::unique_ptr<WindowHandle> handle_;
};

}  // namespace afm::render
