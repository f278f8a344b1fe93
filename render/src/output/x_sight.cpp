// SPDX-License-Identifier: Apache-2.0
#include "output/x_sight.h"

#include <poll.h>
#include <xcb/dpms.h>
#include <xcb/randr.h>
#include <xcb/screensaver.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

namespace afm::render {

namespace {

constexpr std::uint32_t kMostValues = 64;             // length limit of a property
constexpr std::uint32_t kEveryDesktop = 0xFFFFFFFFU;  // value of _NET_WM_DESKTOP
constexpr std::uint8_t kSaverOn = 1;                  // state in MIT-SCREEN-SAVER

struct Free {
  void operator()(void* reply) const { std::free(reply); }
};
template <class Reply>
using Answer = std::unique_ptr<Reply, Free>;

// Answer to a request; null after an error, such as a window that has gone.
template <class Reply, class Cookie>
Answer<Reply> answer(xcb_connection_t* connection, Reply* (*reply)(xcb_connection_t*, Cookie, xcb_generic_error_t**),
                     Cookie cookie) {
  xcb_generic_error_t* error = nullptr;
  Answer<Reply> answer(reply(connection, cookie, &error));
  std::free(error);
  return answer;
}

}  // namespace

std::unique_ptr<XSight> XSight::connect(const std::vector<std::uint32_t>& windows) {
  int screen = 0;
  std::unique_ptr<XSight> sight(new XSight());
  sight->connection_.reset(xcb_connect(nullptr, &screen));
  xcb_connection_t* const connection = sight->connection_.get();
  if (xcb_connection_has_error(connection) != 0 || !sight->find_screen(screen)) return nullptr;
  sight->atoms_ = {.state = sight->atom("_NET_WM_STATE"),
                   .hidden = sight->atom("_NET_WM_STATE_HIDDEN"),
                   .desktop = sight->atom("_NET_WM_DESKTOP"),
                   .current_desktop = sight->atom("_NET_CURRENT_DESKTOP"),
                   .wm_check = sight->atom("_NET_SUPPORTING_WM_CHECK"),
                   .compositor = sight->atom(("_NET_WM_CM_S" + std::to_string(screen)).c_str())};
  sight->find_extensions();
  for (const std::uint32_t window : windows) {
    const std::uint32_t events =
        XCB_EVENT_MASK_VISIBILITY_CHANGE | XCB_EVENT_MASK_STRUCTURE_NOTIFY | XCB_EVENT_MASK_PROPERTY_CHANGE;
    xcb_change_window_attributes(connection, window, XCB_CW_EVENT_MASK, &events);
    sight->windows_.push_back({.id = window});
  }
  const std::uint32_t of_root = XCB_EVENT_MASK_PROPERTY_CHANGE;
  xcb_change_window_attributes(connection, sight->root_, XCB_CW_EVENT_MASK, &of_root);
  xcb_flush(connection);
  return sight;
}

bool XSight::find_screen(int number) {
  for (auto screens = xcb_setup_roots_iterator(xcb_get_setup(connection_.get())); screens.rem > 0;
       xcb_screen_next(&screens)) {
    if (number-- == 0) root_ = screens.data->root;
  }
  return root_ != 0;
}

// Finds the extensions. An extension's requests must only be sent to a server that has it: others close the connection.
void XSight::find_extensions() {
  xcb_connection_t* const connection = connection_.get();
  const auto has = [connection](xcb_extension_t& extension) {
    const xcb_query_extension_reply_t* const data = xcb_get_extension_data(connection, &extension);
    return data != nullptr && data->present != 0;
  };
  has_dpms_ = has(xcb_dpms_id);
  has_saver_ = has(xcb_screensaver_id);
  if (has_saver_) xcb_screensaver_select_input(connection, root_, XCB_SCREENSAVER_EVENT_NOTIFY_MASK);
  if (!has(xcb_randr_id)) return;
  constexpr std::uint32_t kMajor = 1, kMinor = 5;  // first version with monitors
  const auto version =
      answer(connection, xcb_randr_query_version_reply, xcb_randr_query_version(connection, kMajor, kMinor));
  has_monitors_ = version && (version->major_version > kMajor || version->minor_version >= kMinor);
  if (has_monitors_) xcb_randr_select_input(connection, root_, XCB_RANDR_NOTIFY_MASK_SCREEN_CHANGE);
}

std::uint32_t XSight::atom(const char* name) const {
  const auto length = static_cast<std::uint16_t>(std::string_view(name).size());
  const auto found = answer(connection_.get(), xcb_intern_atom_reply,
                            xcb_intern_atom(connection_.get(), std::uint8_t{0}, length, name));
  return found ? found->atom : 0;
}

void XSight::wait(int wake_fd, int milliseconds) const {
  std::array<pollfd, 2> files{{{.fd = xcb_get_file_descriptor(connection_.get()), .events = POLLIN, .revents = 0},
                               {.fd = wake_fd, .events = POLLIN, .revents = 0}}};
  const bool lost = xcb_connection_has_error(connection_.get()) != 0;
  ::poll(lost ? &files[1] : files.data(), lost ? 1 : files.size(), milliseconds);
}

void XSight::take_events() {
  constexpr std::uint8_t kSentMask = 0x7F;
  while (const Answer<xcb_generic_event_t> event{xcb_poll_for_event(connection_.get())}) {
    if ((event->response_type & kSentMask) != XCB_VISIBILITY_NOTIFY) continue;
    const auto& visibility = reinterpret_cast<const xcb_visibility_notify_event_t&>(*event);
    for (Watched& window : windows_) {
      if (window.id == visibility.window) window.covered = visibility.state == XCB_VISIBILITY_FULLY_OBSCURED;
    }
  }
}

bool XSight::blanked() const {
  xcb_connection_t* const connection = connection_.get();
  if (has_dpms_) {
    const auto dpms = answer(connection, xcb_dpms_info_reply, xcb_dpms_info(connection));
    if (dpms && dpms->state != 0 && dpms->power_level != XCB_DPMS_DPMS_MODE_ON) return true;
  }
  if (!has_saver_) return false;
  const auto saver =
      answer(connection, xcb_screensaver_query_info_reply, xcb_screensaver_query_info(connection, root_));
  return saver && saver->state == kSaverOn;
}

// Values of a 32-bit property; empty if it is missing.
std::vector<std::uint32_t> XSight::values(std::uint32_t window, std::uint32_t property) const {
  const auto found = answer(connection_.get(), xcb_get_property_reply,
                            xcb_get_property(connection_.get(), std::uint8_t{0}, window, property,
                                             XCB_GET_PROPERTY_TYPE_ANY, 0, kMostValues));
  if (!found || found->format != 32) return {};
  const std::span values(static_cast<const std::uint32_t*>(xcb_get_property_value(found.get())), found->value_len);
  return {values.begin(), values.end()};
}

// Only such a window manager keeps windows of other workspaces mapped. Others unmap them, and may show a workspace on
// each monitor, of which only one is the current one.
bool XSight::window_manager_composites() const {
  const std::vector<std::uint32_t> manager = values(root_, atoms_.wm_check);
  const auto compositor = answer(connection_.get(), xcb_get_selection_owner_reply,
                                 xcb_get_selection_owner(connection_.get(), atoms_.compositor));
  if (manager.size() != 1 || !compositor || compositor->owner == XCB_NONE) return false;
  const std::uint32_t of_client = ~xcb_get_setup(connection_.get())->resource_id_mask;
  return (manager.front() & of_client) == (compositor->owner & of_client);
}

bool XSight::hidden(std::uint32_t window) const {
  const auto attributes =
      answer(connection_.get(), xcb_get_window_attributes_reply, xcb_get_window_attributes(connection_.get(), window));
  if (attributes && attributes->map_state != XCB_MAP_STATE_VIEWABLE) return true;
  const std::vector<std::uint32_t> states = values(window, atoms_.state);
  if (std::find(states.begin(), states.end(), atoms_.hidden) != states.end()) return true;
  const std::vector<std::uint32_t> own = values(window, atoms_.desktop),
                                   current = values(root_, atoms_.current_desktop);
  if (own.size() != 1 || current.size() != 1 || own == current || own.front() == kEveryDesktop) return false;
  return window_manager_composites();
}

// Finds the monitors that are switched on and connected.
void XSight::find_monitors() {
  xcb_connection_t* const connection = connection_.get();
  const auto all =
      answer(connection, xcb_randr_get_monitors_reply, xcb_randr_get_monitors(connection, root_, std::uint8_t{1}));
  monitors_.clear();
  if (!all) return;
  for (auto monitor = xcb_randr_get_monitors_monitors_iterator(all.get()); monitor.rem > 0;
       xcb_randr_monitor_info_next(&monitor)) {
    const std::span outputs(xcb_randr_monitor_info_outputs(monitor.data),
                            static_cast<std::size_t>(xcb_randr_monitor_info_outputs_length(monitor.data)));
    const bool gone = !outputs.empty() && std::all_of(outputs.begin(), outputs.end(), [&](std::uint32_t output) {
      const auto info = answer(connection, xcb_randr_get_output_info_reply,
                               xcb_randr_get_output_info(connection, output, XCB_CURRENT_TIME));
      return info && info->connection == XCB_RANDR_CONNECTION_DISCONNECTED;
    });
    const xcb_randr_monitor_info_t& at = *monitor.data;
    if (!gone && at.width > 0 && at.height > 0) monitors_.push_back({at.x, at.y, at.width, at.height});
  }
  had_monitors_ = had_monitors_ || !monitors_.empty();
}

// True for a part of the window at least; and on servers without monitors, which are looked at from elsewhere.
bool XSight::on_monitor(std::uint32_t window) const {
  if (!had_monitors_) return true;
  xcb_connection_t* const connection = connection_.get();
  const auto size = answer(connection, xcb_get_geometry_reply, xcb_get_geometry(connection, window));
  const auto corner = answer(connection, xcb_translate_coordinates_reply,
                             xcb_translate_coordinates(connection, window, root_, std::int16_t{0}, std::int16_t{0}));
  if (!size || !corner) return true;
  const auto overlap = [](int a, int a_size, int b, int b_size) { return a < b + b_size && b < a + a_size; };
  return std::any_of(monitors_.begin(), monitors_.end(), [&](const xcb_rectangle_t& monitor) {
    return overlap(corner->dst_x, size->width, monitor.x, monitor.width) &&
           overlap(corner->dst_y, size->height, monitor.y, monitor.height);
  });
}

Sight XSight::look_at(const Watched& window) const {
  if (hidden(window.id)) return Sight::Hidden;
  if (has_monitors_ && !on_monitor(window.id)) return Sight::OffMonitors;
  return window.covered ? Sight::Covered : Sight::Seen;
}

Sight XSight::look() {
  if (xcb_connection_has_error(connection_.get()) != 0) return Sight::Seen;
  const bool blank = blanked();
  if (has_monitors_) find_monitors();
  take_events();  // after an answer, which comes behind the events before it
  if (blank) return Sight::Blanked;
  Sight best = Sight::Seen;
  for (const Watched& window : windows_) {
    best = look_at(window);
    if (best == Sight::Seen) break;
  }
  return xcb_connection_has_error(connection_.get()) == 0 ? best : Sight::Seen;
}

}  // namespace afm::render
