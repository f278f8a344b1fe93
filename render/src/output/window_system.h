// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace afm::render {

// Share of GLFW, which is global: initialised with the first share and terminated with the last. Main thread only.
class WindowSystem {
 public:
  // DeviceMissing: no display.
  static core::Result<WindowSystem> join();
  WindowSystem(WindowSystem&& other) noexcept;
  WindowSystem& operator=(WindowSystem&& other) noexcept;
  ~WindowSystem();

  // True if the display has gone. Without this handler, Xlib would end the process. Ask the window system nothing then:
  // libX11 1.8.12 crashes at the third request after the loss.
  static bool lost() { return lost_; }

  // Throws DeviceFailure if it has gone.
  static void expect_display();

  // Number of monitor connections and disconnections so far.
  static unsigned monitor_changes() { return monitor_changes_; }

 private:
  WindowSystem() = default;
  static void outlive_the_display();

  inline static int shares_ = 0;
  inline static bool lost_ = false;
  inline static unsigned monitor_changes_ = 0;
  bool joined_ = true;
};

// GLFW's message for its last failure on this thread.
std::string window_system_error();

}  // namespace afm::render
