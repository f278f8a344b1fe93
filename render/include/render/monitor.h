// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "scene/display/wall.h"

namespace afm::render {

// Monitor or projector of this machine's desktop.
struct Monitor {
  std::string name;       // name in the window system, such as "HDMI-1"
  scene::PixelRect rect;  // position on the desktop, in desktop units
  double rate_hz = 0;     // refresh rate; 0: unknown
};

// Monitors that are switched on, the main one first. DeviceMissing: no display. Main thread only.
core::Result<std::vector<Monitor>> list_monitors();

// Finds the monitor with this name or, failing that, with this number, counted from 1; null if there is none.
const Monitor* find_monitor(const std::vector<Monitor>& monitors, const std::string& name_or_number);

// True if every corner of a desktop rectangle lies on one of the monitors.
bool is_shown(const scene::PixelRect& rect, const std::vector<Monitor>& monitors);

// True if a program may place its windows. Wayland only lets it choose the monitor.
bool can_place_windows();

}  // namespace afm::render
