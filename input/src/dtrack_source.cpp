// SPDX-License-Identifier: Apache-2.0
#include "input/dtrack_source.h"
#include "core/system_error.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <utility>

namespace afm::input {

namespace {

constexpr int kPatienceMs = 10;
constexpr int kMostPacketsAPoll = 256;
constexpr std::size_t kLongestPacket = 65'536;
constexpr std::int64_t kSilenceNs = 250'000'000;
constexpr std::uint32_t kMostLost = 10'000;  // more than any tracker sends before it counts as silent

// Joins the group on every network of this machine, since the tracker's is often not the one of the default route.
bool join_everywhere(int socket, in_addr group) {
  bool joined = false;
  struct if_nameindex* const interfaces = ::if_nameindex();
  for (const struct if_nameindex* one = interfaces; one != nullptr && one->if_index != 0; ++one) {
    const ip_mreqn membership{
        .imr_multiaddr = group, .imr_address = {}, .imr_ifindex = static_cast<int>(one->if_index)};
    joined |= ::setsockopt(socket, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) == 0;
  }
  if (interfaces != nullptr) ::if_freenameindex(interfaces);
  return joined;
}

core::Result<void> bind_to(int socket, const DtrackSettings& settings) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(settings.port);
  if (::inet_pton(AF_INET, settings.address.c_str(), &place.sin_addr) != 1) {
    return core::failure(
        core::ErrorCategory::WrongUsage,
        fmt::format("the tracker's address \"{}\" is not an IPv4 address of this machine, such as 127.0.0.1, or a "
                    "multicast group, such as 224.0.1.0",
                    settings.address));
  }
  const bool is_group = IN_MULTICAST(ntohl(place.sin_addr.s_addr));
  const int several = 1;
  if (is_group) ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &several, sizeof several);
  const bool bound = ::bind(socket, reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0;
  if (bound && is_group && !join_everywhere(socket, place.sin_addr)) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         fmt::format("cannot join the tracker's multicast group {} on any network ({}): check the "
                                     "network cable, or let the tracker send to an address of this machine",
                                     settings.address, core::system_error(errno)));
  }
  if (bound) return {};
  return core::failure(core::ErrorCategory::DeviceMissing,
                       fmt::format("cannot listen for a tracker at {}:{} ({}): give an address of this machine, and "
                                   "close other programs that listen there",
                                   settings.address, settings.port, core::system_error(errno)));
}

std::uint32_t wand_buttons(std::uint32_t flystick) {
  constexpr std::array kMeanings{WandButton::Select, WandButton::Grab, WandButton::Scale, WandButton::Home};
  std::uint32_t buttons = 0;
  for (std::size_t i = 0; i < kMeanings.size(); ++i) {
    if (((flystick >> i) & 1U) != 0) buttons |= bit(kMeanings[i]);
  }
  return buttons;
}

}  // namespace

DtrackBody in_room(const DtrackBody& body, const DtrackSettings& settings) {
  DtrackBody moved = body;
  moved.position_m = settings.tracker_origin_m + settings.room_from_tracker * body.position_m;
  moved.tracker_from_body = settings.room_from_tracker * body.tracker_from_body;
  return moved;
}

core::Result<std::unique_ptr<DtrackSource>> DtrackSource::open(const DtrackSettings& settings,
                                                               const core::Clock& clock) {
  core::FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket.is_open()) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot create a socket for the tracker ({})", core::system_error(errno)));
  }
  if (auto bound = bind_to(socket.get(), settings); !bound) return tl::unexpected(bound.error());
  sockaddr_in place{};
  socklen_t size = sizeof place;
  if (::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&place), &size) != 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot query the tracker's port ({})", core::system_error(errno)));
  }
  return std::unique_ptr<DtrackSource>(new DtrackSource(settings, clock, std::move(socket), ntohs(place.sin_port)));
}

DtrackSource::DtrackSource(const DtrackSettings& settings, const core::Clock& clock, core::FileDescriptor socket,
                           std::uint16_t port)
    : settings_(settings), clock_(clock), socket_(std::move(socket)), port_(port) {}

bool DtrackSource::receive(int patience_ms) {
  pollfd waiting{.fd = socket_.get(), .events = POLLIN, .revents = 0};
  if (::poll(&waiting, 1, patience_ms) <= 0) return false;
  std::array<char, kLongestPacket> packet;
  const ssize_t size = ::recv(socket_.get(), packet.data(), packet.size(), 0);
  if (size < 0) return false;
  DtrackFaults refused;
  const auto frame = parse_dtrack({packet.data(), static_cast<std::size_t>(size)}, &refused);
  if (!frame) {
    ++now_.bad_packets;
    now_.faults = refused;
  } else if (!is_silent() && static_cast<std::int32_t>(frame->frame - now_.frame.frame) <= 0) {
    ++now_.old_packets;  // late frame, unless the numbers wrap around
  } else {
    if (!is_silent()) count_lost(frame->frame - now_.frame.frame);
    now_.frame = *frame;
    now_.left_out += frame->faults.count;
    if (frame->faults.count > 0) now_.faults = frame->faults;
    now_.time_ns = clock_.now_ns();
    ++now_.good_packets;
  }
  return true;
}

// A longer step is that of a tracker that was restarted, or of two that send to one port.
void DtrackSource::count_lost(std::uint32_t step) {
  if (step > kMostLost) return;
  if (frame_step_ == 0 || step < frame_step_) frame_step_ = step;
  now_.lost_frames += step / frame_step_ - 1;
}

bool DtrackSource::is_silent() const { return now_.good_packets == 0 || clock_.now_ns() - now_.time_ns > kSilenceNs; }

WandState DtrackSource::poll() {
  bool heard = false;
  for (int i = 0; i < kMostPacketsAPoll && receive(i == 0 ? kPatienceMs : 0); ++i) heard = true;
  if (heard) update_.store(now_);

  WandState wand;
  wand.time_ns = now_.time_ns;
  const DtrackFlystick* const stick = now_.frame.flystick(settings_.flystick);
  if (is_silent() || stick == nullptr) return wand;
  const DtrackBody body = in_room(stick->body, settings_);
  wand.connected = true;
  wand.orientation_valid = wand.position_valid = body.tracked;
  wand.position_m = body.position_m;
  wand.room_from_wand = body.tracker_from_body;
  wand.buttons = wand_buttons(stick->buttons);
  wand.push = {stick->joystick[0], 0.0, -stick->joystick[1]};
  return wand;
}

}  // namespace afm::input
