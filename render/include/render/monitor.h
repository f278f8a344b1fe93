// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "scene/display/wall.h"

namespace afm::render {

// A monitor or projector of this machine's desktop.
struct Monitor {
  std::string name;       // the window system's: "HDMI-1"
  scene::PixelRect rect;  // in the desktop, its units
  double rate_hz = 0;     // 0: it does not say
};

// Those that are switched on, the main one first. DeviceMissing: no display. On the main thread only.
core::Result<std::vector<Monitor>> list_monitors();

// The one that is called so or, if none is, the one of that number, counted from 1; null if there is neither.
const Monitor* find_monitor(const std::vector<Monitor>& monitors, const std::string& name_or_number);

// True if every corner of a rectangle of the desktop lies on one of the monitors.
bool is_shown(const scene::PixelRect& rect, const std::vector<Monitor>& monitors);

// True if a program may place its windows. Wayland only lets it choose the monitor.
bool can_place_windows();

}  // namespace afm::render
