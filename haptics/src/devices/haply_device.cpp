// SPDX-License-Identifier: Apache-2.0
#include "devices/haply_device.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <exception>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/log.h"
#include "core/printable.h"
#include "devices/haply_link.h"
#include "devices/haply_message.h"
#include "devices/waiting_states.h"
#include "drivers/release_patience.h"

namespace afm::haptics {

namespace {

constexpr auto kFirstPlacePatience = std::chrono::seconds(2);
constexpr auto kReceivePatience = std::chrono::milliseconds(2);
constexpr auto kPartPatience = std::chrono::milliseconds(200);  // twice the time the link needs to send and disconnect
constexpr std::int64_t kComplaintNs = 1'000'000'000;            // interval of log lines about an unsteady service

// The service reports no limits. Force: what careful drivers give a hand (Isaac Lab clips at 2 N). Stiffness: that of a
// Touch. Workspace: the part of the reach in front of the arm that every Inverse3 has, around the position (0, -0.12,
// 0.15) in its documentation. Minverses are smaller and weaker, and of an arm of another type nothing is known: half
// the force, which is not from a source, and the same workspace, outside of which the governor lets go.
DeviceSpec arm_spec(const HaplyName& arm) {
  struct Type {
    std::string_view family;
    std::string_view name;
    double share;  // share of an Inverse3's force that this arm gets
  };
  constexpr Type kTypes[] = {
      {"inverse3", "Inverse3", 1.0}, {"inverse3x", "Inverse3x", 1.0}, {"minverse", "Minverse", 0.5}};
  const auto found =
      std::find_if(std::begin(kTypes), std::end(kTypes), [&](const Type& type) { return type.family == arm.family; });
  const double share = found == std::end(kTypes) ? 0.5 : found->share;
  const std::string_view name = found == std::end(kTypes) ? std::string_view(arm.family) : found->name;
  return {.name = core::printable_line(fmt::format("Haply {} {}", name, arm.id)),
          .max_force_n = 2.2 * share,
          .max_continuous_force_n = 0.9 * share,
          .max_stiffness_n_per_m = 400.0,
          .force_lasts_s = core::seconds(CommandFade::kStaleNs),
          .max_vibration_n = found == std::end(kTypes) ? 0.0 : kMostVibrationN * share,
          .measures = true,
          .workspace_min_m = {-0.08, 0.08, 0.04},
          .workspace_max_m = {0.08, 0.20, 0.20},
          .contact_point_m = {0.0, 0.12, 0.12}};
}

}  // namespace

core::Result<std::unique_ptr<HaplyDevice>> HaplyDevice::open(const core::Clock& clock, std::uint16_t port,
                                                             OfferReleasePath offer, const std::string& wanted) {
  auto link = std::make_unique<HaplyLink>();
  if (auto connected = link->connect(port); !connected) return tl::unexpected(connected.error());
  std::unique_ptr<HaplyDevice> device(new HaplyDevice(clock, port, std::move(link), std::move(offer), wanted));
  if (!wait_until(kFirstPlacePatience, [&] { return device->known_.load(); })) {
    return core::failure(
        core::ErrorCategory::DeviceMissing,
        fmt::format(
            "the haply inverse service at port {} reported no {} within {} s: plug the device in and calibrate it",
            port, wanted.empty() ? "inverse3" : "device " + core::printable_line(wanted), kFirstPlacePatience.count()));
  }
  device->spec_ = arm_spec(device->first_);
  return device;
}

core::Result<HaplyInventory> HaplyDevice::query(std::uint16_t port) {
  HaplyLink link;
  if (auto connected = link.connect(port); !connected) return tl::unexpected(connected.error());
  const auto message = link.receive(kFirstPlacePatience);
  return message ? parse_haply_inventory(*message) : HaplyInventory{};
}

HaplyDevice::HaplyDevice(const core::Clock& clock, std::uint16_t port, std::unique_ptr<HaplyLink> link,
                         OfferReleasePath offer, const std::string& wanted)
    : clock_(clock), port_(port), link_(std::move(link)), offer_(std::move(offer)), wanted_(wanted), thread_([this] {
        serve();
      }) {}

HaplyDevice::~HaplyDevice() {
  closing_.store(true);
  // exchanges end by themselves; only a connection attempt needs interrupting
  wait_until(kPartPatience, [this] { return !exchanging_.load(); });
  link_->interrupt();
  thread_.join();
}

DeviceSample HaplyDevice::read(std::int64_t now_ns) noexcept {
  if (const auto frame = frames_.try_load()) frame_ = *frame;
  return {.position_m = frame_.position_m,
          .turn_on = frame_.button != 0,
          .healthy = frame_.time_ns != 0 && now_ns - frame_.time_ns <= kStallNs};
}

void HaplyDevice::write(const ForceCommand& command) noexcept {
  commands_.store({.time_ns = clock_.now_ns(), .force_n = command.force_n()});
}

void HaplyDevice::serve() noexcept {
  bool connected = true, told = false;
  while (!closing_.load()) {
    try {
      if (connected || link_->connect(port_)) {
        connected = false;
        if (told) core::log_line("haptics: the haply inverse service answers again");
        told = false;
        exchanging_.store(true);
        exchange();
      }
    } catch (const std::exception& error) {
      core::log_line(fmt::format("haptics: cannot communicate with the haply inverse service: {}", error.what()));
    }
    part();
    if (closing_.load()) return;
    if (!told) core::log_line("haptics: the haply inverse service does not answer: no force reaches the hand");
    told = true;
    const auto end = std::chrono::steady_clock::now() + std::chrono::nanoseconds(kRetryNs);
    while (!closing_.load() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(kReceivePatience);
  }
}

// Runs until the connection ends. The service sends first; after that, each of its states answers a force. A silent
// service holds the last force, so zero is sent without being asked for.
void HaplyDevice::exchange() {
  arm_ = {};
  force_ns_ = heard_ns_ = clock_.now_ns();
  fade_.lose();
  bool silent = false;
  bool owed = false;  // true: the service waits for a force
  bool first_message = true;
  WaitingStates waiting(wanted_);
  while (!link_->ended() && !closing_.load()) {
    const auto end = std::chrono::steady_clock::now() + kReceivePatience;
    const auto [asked, newest] = waiting.take(
        [&](bool first) {
          auto message = link_->receive(first ? kReceivePatience : std::chrono::microseconds(0));
          if (message && std::exchange(first_message, false)) list(*message);
          return message;
        },
        [&] { return std::chrono::steady_clock::now() >= end; });
    if (newest) {
      if (arm_ != newest->device) {
        arm_ = newest->device;
        wanted_ = arm_.id;
        waiting.keep_to(wanted_);
        offer_release();
        if (!known_.load()) first_ = typed(arm_);
      }
      heard_ns_ = clock_.now_ns();
      frames_.store({.time_ns = heard_ns_, .position_m = newest->position_m, .button = newest->button ? 1U : 0U});
      known_.store(true);
    }
    const std::int64_t now_ns = clock_.now_ns();
    const glm::dvec3 force_n = force_for(now_ns);
    const bool was_silent = std::exchange(silent, now_ns - heard_ns_ > kStallNs);
    owed = owed || asked;
    if (owed ? !arm_.id.empty() : silent && !released_.load()) {
      tell(force_n);
      owed = false;
    }
    if (silent && !was_silent && now_ns - complained_ns_ > kComplaintNs) {
      complained_ns_ = now_ns;
      core::log_line(
          fmt::format("haptics: the haply inverse service has reported no position for {} ms: no force until it does",
                      kStallNs / 1'000'000));
    }
  }
}

// Sends zero force, because the service may still hold the last one, however the connection ended.
void HaplyDevice::part() noexcept {
  const auto attempt = [](const auto& step) {
    try {
      step();
    } catch (const std::exception& error) {
      core::log_line(error.what());
    }
  };
  attempt([&] {
    if (!released_.load()) tell(glm::dvec3(0.0));
  });
  attempt([&] { link_->leave(); });
  exchanging_.store(false);
  if (released_.exchange(true)) return;
  core::log_line("haptics: cannot send zero force to the haply inverse service: it may still apply the last force");
}

// The first message of a connection lists all devices. Who has several must know which one the force is for.
void HaplyDevice::list(const std::string& message) {
  inventory_ = parse_haply_inventory(message);
  if (inventory_.arms.size() < 2 && inventory_.unknown.empty()) return;
  const std::string text = text_of(inventory_);
  if (std::exchange(listed_, text) == text) return;
  core::log_line(fmt::format("haptics: the haply inverse service has {}; {}", text,
                             wanted_.empty() ? fmt::format("{} chooses another than the first", kHaplyDeviceVariable)
                                             : fmt::format("only {} is used", core::printable_line(wanted_))));
}

// The name with the type reported by the device itself.
HaplyName HaplyDevice::typed(const HaplyName& arm) const {
  const auto& arms = inventory_.arms;
  const auto found = std::find_if(arms.begin(), arms.end(), [&](const HaplyName& named) { return named.id == arm.id; });
  return found == arms.end() ? arm : *found;
}

void HaplyDevice::offer_release() const {
  if (offer_) offer_({link_->descriptor(), text_frame(haply_force_message(arm_, glm::dvec3(0.0)))});
}

void HaplyDevice::tell(const glm::dvec3& force_n) {
  const bool none = force_n == glm::dvec3(0.0);
  if (!none) released_.store(false);
  if (link_->send(haply_force_message(arm_, force_n)) && none) released_.store(true);
}

glm::dvec3 HaplyDevice::force_for(std::int64_t now_ns) {
  if (const auto command = commands_.try_load()) command_ = *command;
  const std::int64_t elapsed_ns = std::max<std::int64_t>(0, now_ns - force_ns_);
  force_ns_ = now_ns;
  const glm::dvec3 wanted_n = fade_.weighed_n(command_, now_ns, elapsed_ns);
  // no force without a known position
  if (!closing_.load() && now_ns - heard_ns_ <= kStallNs) return wanted_n;
  fade_.lose();
  return glm::dvec3(0.0);
}

namespace {

std::uint16_t service_port(const Environment& environment) {
  const std::string text = environment(kHaplyPortVariable);
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error == std::errc() && end == text.data() + text.size() && port > 0) return port;
  if (!text.empty()) {
    core::log_line(
        fmt::format("{}: \"{}\" is not a port from 1 to 65535: using {}", kHaplyPortVariable, text, kHaplyServicePort));
  }
  return kHaplyServicePort;
}

}  // namespace

core::Result<std::unique_ptr<HapticDevice>> open_haply(const DeviceRequest& request, ProbeLog& log) {
  auto device = HaplyDevice::open(request.clock, service_port(request.environment), request.offer,
                                  request.environment(kHaplyDeviceVariable));
  if (!device) {
    log.missing(device.error().message);
    return tl::unexpected(device.error());
  }
  log.found((*device)->spec().name);
  return std::unique_ptr<HapticDevice>(std::move(*device));
}

void probe_haply(const Environment& environment, ProbeLog& log) {
  const std::uint16_t port = service_port(environment);
  const auto answer = HaplyDevice::query(port);
  if (!answer) return log.missing(answer.error().message);
  if (answer->arms.empty()) {
    return log.missing(fmt::format("its service answers at port {}, and has {}; plug the device in and calibrate it",
                                   port, text_of(*answer)));
  }
  log.found(fmt::format("{}: its service answers at port {}", text_of(*answer), port));
}

}  // namespace afm::haptics
