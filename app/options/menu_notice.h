// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace afm::app {

// Set by the entry in a desktop's menu (assets/desktop/touchafm.desktop): nobody sees what is written to stderr.
inline constexpr const char* kFromMenu = "TOUCHAFM_FROM_MENU";

// Shows why the program ends, by org.freedesktop.Notifications, if it was started from a menu; a desktop without that
// service is noted on stderr. Waits for a second at most. Main thread, as the last thing.
void tell_the_desktop(const std::string& message);

}  // namespace afm::app
