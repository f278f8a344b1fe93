// SPDX-License-Identifier: Apache-2.0
#include "app/options/menu_notice.h"

#include <systemd/sd-bus.h>

#include <cstdint>
#include <cstdlib>

#include "core/log.h"
#include "core/system_error.h"

namespace afm::app {
namespace {

constexpr std::uint64_t kBusTimeoutUs = 1'000'000;
constexpr const char* kService = "org.freedesktop.Notifications";
constexpr const char* kObject = "/org/freedesktop/Notifications";

// Text without mark-up, which the body of a notification may hold (Desktop Notifications Specification 1.2, section 4).
std::string without_markup(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace

void tell_the_desktop(const std::string& message) {
  if (::secure_getenv(kFromMenu) == nullptr) return;
  sd_bus* bus = nullptr;
  int called = sd_bus_open_user(&bus);
  if (called >= 0) {
    sd_bus_set_method_call_timeout(bus, kBusTimeoutUs);
    constexpr unsigned kReplacesNone = 0;
    constexpr int kNoActions = 0, kNoHints = 0, kUntilItIsClosed = 0;
    called = sd_bus_call_method(bus, kService, kObject, kService, "Notify", nullptr, nullptr, "susssasa{sv}i",
                                "TouchAFM", kReplacesNone, "touchafm", "TouchAFM has ended with an error",
                                without_markup(message).c_str(), kNoActions, kNoHints, kUntilItIsClosed);
  }
  if (called < 0) core::log_line(std::string("the desktop cannot show this error: ") + core::system_error(-called));
  sd_bus_flush_close_unref(bus);
}

}  // namespace afm::app
