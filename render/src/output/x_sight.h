// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xcb/xcb.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "render/window_sight.h"

namespace afm::render {

// Connection to the X server of DISPLAY that asks whether windows are visible. One thread.
class XSight {
 public:
  // Null if there is no such server.
  static std::unique_ptr<XSight> connect(const std::vector<std::uint32_t>& windows);

  // Sight of the best visible window, after several round trips. Seen if the connection is lost, which the windows
  // notice themselves.
  Sight look();

  // Waits until the server reports a change, or `wake_fd` becomes readable, for at most `milliseconds`.
  void wait(int wake_fd, int milliseconds) const;

 private:
  struct Watched {
    std::uint32_t id = 0;
    bool covered = false;  // true: covered, according to the newest event
  };
  struct Atoms {
    std::uint32_t state, hidden, desktop, current_desktop, wm_check, compositor;
  };
  struct Disconnect {
    void operator()(xcb_connection_t* connection) const { xcb_disconnect(connection); }
  };

  XSight() = default;
  bool find_screen(int number);
  void find_extensions();
  std::uint32_t atom(const char* name) const;
  void take_events();
  bool blanked() const;
  bool window_manager_composites() const;
  std::vector<std::uint32_t> values(std::uint32_t window, std::uint32_t property) const;
  bool hidden(std::uint32_t window) const;
  void find_monitors();
  bool on_monitor(std::uint32_t window) const;
  Sight look_at(const Watched& window) const;

  std::unique_ptr<xcb_connection_t, Disconnect> connection_;
  std::uint32_t root_ = 0;
  Atoms atoms_{};
  bool has_dpms_ = false, has_saver_ = false, has_monitors_ = false;
  bool had_monitors_ = false;  // true: at least one monitor at any time so far
  std::vector<xcb_rectangle_t> monitors_;
  std::vector<Watched> windows_;
};

}  // namespace afm::render
