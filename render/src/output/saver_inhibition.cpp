// SPDX-License-Identifier: Apache-2.0
#include "render/saver_inhibition.h"

#include <systemd/sd-bus.h>
#include <xcb/screensaver.h>
#include <xcb/xcb.h>

#include <cstdint>
#include <cstdlib>

#include "core/system_error.h"

namespace afm::render {

namespace {

constexpr std::uint64_t kBusTimeoutUs = 1'000'000;
constexpr const char* kService = "org.freedesktop.ScreenSaver";
constexpr const char* kObject = "/org/freedesktop/ScreenSaver";
constexpr std::uint8_t kSaverMajor = 1, kSaverMinor = 1;  // first version with a suspension

// Suspends the screen saver; the suspension ends with the connection.
SaverInhibition::Way suspend_saver(xcb_connection_t* x) {
  if (xcb_connection_has_error(x) != 0) return {.said = "no X server"};
  const xcb_query_extension_reply_t* const extension = xcb_get_extension_data(x, &xcb_screensaver_id);
  if (extension == nullptr || extension->present == 0) return {.said = "the X server lacks MIT-SCREEN-SAVER"};
  xcb_screensaver_query_version_reply_t* const version =
      xcb_screensaver_query_version_reply(x, xcb_screensaver_query_version(x, kSaverMajor, kSaverMinor), nullptr);
  const bool new_enough = version != nullptr &&
                          (version->server_major_version > kSaverMajor || version->server_minor_version >= kSaverMinor);
  std::free(version);
  if (!new_enough) return {.said = "the X server's MIT-SCREEN-SAVER is older than 1.1"};
  const xcb_void_cookie_t asked = xcb_screensaver_suspend_checked(x, 1);
  xcb_generic_error_t* const error = xcb_request_check(x, asked);
  const bool refused = error != nullptr;
  std::free(error);
  if (refused) return {.said = "the X server refused"};
  // a screen saver that is active already stays active
  xcb_force_screen_saver(x, XCB_SCREEN_SAVER_RESET);
  xcb_flush(x);
  return {.works = true, .said = "suspended, with DPMS"};
}

}  // namespace

struct SaverInhibition::Connections {
  Connections() : x(xcb_connect(nullptr, nullptr)) {}
  Connections(const Connections&) = delete;
  Connections& operator=(const Connections&) = delete;
  ~Connections() {
    sd_bus_flush_close_unref(bus);
    xcb_disconnect(x);
  }

  // The inhibition ends with the connection.
  Way inhibit() {
    if (sd_bus_open_user(&bus) < 0) {
      bus = nullptr;
      return {.said = "no session bus"};
    }
    sd_bus_set_method_call_timeout(bus, kBusTimeoutUs);
    sd_bus_error error{};
    const int called = sd_bus_call_method(bus, kService, kObject, kService, "Inhibit", &error, nullptr, "ss",
                                          "TouchAFM", "the wall is in use");
    const std::string reason = error.message != nullptr ? error.message : core::system_error(-called);
    sd_bus_error_free(&error);
    if (called < 0) return {.said = reason};
    return {.works = true, .said = "inhibited"};
  }

  xcb_connection_t* x;
  sd_bus* bus = nullptr;
};

SaverInhibition::SaverInhibition() : connections_(std::make_unique<Connections>()) {
  x_server_ = suspend_saver(connections_->x);
  session_ = connections_->inhibit();
}

SaverInhibition::~SaverInhibition() = default;

}  // namespace afm::render
