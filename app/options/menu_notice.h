// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace afm::app {

// Environment variable set by the menu entry (assets/desktop/touchafm.desktop): stderr is then invisible.
inline constexpr const char* kFromMenu = "TOUCHAFM_FROM_MENU";

// Shows the reason for the program's end through org.freedesktop.Notifications, if it was started from a menu; notes on
// stderr if the desktop lacks that service. Waits for a second at most. Main thread, as the last action.
void tell_the_desktop(const std::string& message);

}  // namespace afm::app
