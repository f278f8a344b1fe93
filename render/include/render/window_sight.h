// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/clock.h"
#include "render/window.h"

namespace afm::render {

// Visibility of a window, from the window system's point of view.
enum class Sight { Seen, Hidden, Covered, Blanked, OffMonitors };

// Explanation such as "the window is minimised, or on another workspace".
const char* text_of(Sight sight);

// Visibility of windows on an X server: whether at least one is mapped, on the current workspace, on a monitor that is
// switched on, not wholly covered, and the screen is not blanked by its saver or by DPMS. A thread with a separate
// connection asks 25 times a second and follows the server's events; any thread may read the newest answer. Elsewhere,
// as on Wayland, which does not report it, windows count as seen. The clock must outlive it.
class WindowSight {
 public:
  WindowSight(std::span<Window* const> windows, const core::Clock& clock);
  WindowSight(const WindowSight&) = delete;
  WindowSight& operator=(const WindowSight&) = delete;
  ~WindowSight();

  // Visibility of the best visible window.
  Sight newest() const;

  // Time since which no window has been visible; none while one is.
  std::optional<std::int64_t> unseen_since_ns() const;

 private:
  struct Watch;
  std::unique_ptr<Watch> watch_;  // null if the window system does not report visibility
};

}  // namespace afm::render
