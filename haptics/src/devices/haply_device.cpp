// SPDX-License-Identifier: Apache-2.0
#include "devices/haply_device.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <exception>
#include <optional>
#include <system_error>
#include <utility>

#include "core/log.h"
#include "devices/haply_link.h"
#include "devices/haply_message.h"
#include "drivers/release_patience.h"
#include "devices/waiting_states.h"

namespace afm::haptics {

namespace {

constexpr auto kFirstPlacePatience = std::chrono::seconds(2);
constexpr auto kReceivePatience = std::chrono::milliseconds(2);
constexpr auto kPartPatience = std::chrono::milliseconds(200);  // twice the time the link needs to send and disconnect
constexpr std::int64_t kComplaintNs = 1'000'000'000;            // between two lines about an unsteady service

// The service reports no limits. Force: what careful drivers give a hand (Isaac Lab clips at 2 N). Stiffness: that of a
// Touch. Workspace: the part of the reach in front of the arm that every Inverse3 has, around the position (0, -0.12,
// 0.15) in its documentation.
DeviceSpec inverse3() {
  return {.name = "Haply Inverse3",
          .max_force_n = 2.2,
          .max_continuous_force_n = 0.9,
          .max_stiffness_n_per_m = 400.0,
          .force_lasts_s = core::seconds(HaplyDevice::kStaleNs),
          .measures = true,
          .workspace_min_m = {-0.08, 0.08, 0.04},
          .workspace_max_m = {0.08, 0.20, 0.20},
          .contact_point_m = {0.0, 0.12, 0.12}};
}

}  // namespace

core::Result<std::unique_ptr<HaplyDevice>> HaplyDevice::open(const core::Clock& clock, std::uint16_t port,
                                                             OfferReleasePath offer) {
  auto link = std::make_unique<HaplyLink>();
  if (auto connected = link->connect(port); !connected) return tl::unexpected(connected.error());
  std::unique_ptr<HaplyDevice> device(new HaplyDevice(clock, port, std::move(link), std::move(offer)));
  if (!wait_until(kFirstPlacePatience, [&] { return device->frames_.try_load().has_value(); })) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         fmt::format("the haply inverse service at port {} reported no inverse3 within {} s: plug the "
                                     "device in and calibrate it",
                                     port, kFirstPlacePatience.count()));
  }
  return device;
}

core::Result<void> HaplyDevice::query(std::uint16_t port) { return HaplyLink().connect(port); }

HaplyDevice::HaplyDevice(const core::Clock& clock, std::uint16_t port, std::unique_ptr<HaplyLink> link,
                         OfferReleasePath offer)
    : clock_(clock), port_(port), spec_(inverse3()), link_(std::move(link)), offer_(std::move(offer)), thread_([this] {
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
  device_id_.clear();
  force_ns_ = heard_ns_ = clock_.now_ns();
  trust_ns_ = 0;
  bool silent = false;
  bool owed = false;  // the service waits for a force
  WaitingStates waiting;
  while (!link_->ended() && !closing_.load()) {
    const auto end = std::chrono::steady_clock::now() + kReceivePatience;
    const auto [asked, newest] = waiting.take(
        [&](bool first) { return link_->receive(first ? kReceivePatience : std::chrono::microseconds(0)); },
        [&] { return std::chrono::steady_clock::now() >= end; });
    if (newest) {
      if (std::exchange(device_id_, newest->device_id) != newest->device_id) offer_release();
      heard_ns_ = clock_.now_ns();
      frames_.store({.time_ns = heard_ns_, .position_m = newest->position_m, .button = newest->button ? 1U : 0U});
    }
    const std::int64_t now_ns = clock_.now_ns();
    const glm::dvec3 force_n = force_for(now_ns);
    const bool was_silent = std::exchange(silent, now_ns - heard_ns_ > kStallNs);
    owed = owed || asked;
    if (owed ? !device_id_.empty() : silent && !released_.load()) {
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

void HaplyDevice::offer_release() const {
  if (offer_) offer_({link_->descriptor(), text_frame(haply_force_message(device_id_, glm::dvec3(0.0)))});
}

void HaplyDevice::tell(const glm::dvec3& force_n) {
  const bool none = force_n == glm::dvec3(0.0);
  if (!none) released_.store(false);
  if (link_->send(haply_force_message(device_id_, force_n)) && none) released_.store(true);
}

glm::dvec3 HaplyDevice::force_for(std::int64_t now_ns) {
  if (const auto command = commands_.try_load()) command_ = *command;
  const std::int64_t elapsed_ns = std::max<std::int64_t>(0, now_ns - force_ns_);
  force_ns_ = now_ns;
  const bool stale = now_ns - command_.time_ns > kStaleNs;
  // in whole nanoseconds, so that the fade ends at exactly zero
  trust_ns_ =
      std::clamp<std::int64_t>(trust_ns_ + (stale ? -elapsed_ns * (kReturnNs / kReleaseNs) : elapsed_ns), 0, kReturnNs);
  // no force without a known position
  if (closing_.load() || now_ns - heard_ns_ > kStallNs) trust_ns_ = 0;
  return static_cast<double>(trust_ns_) / static_cast<double>(kReturnNs) * command_.force_n;
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
  auto device = HaplyDevice::open(request.clock, service_port(request.environment), request.offer);
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
  log.found(fmt::format("its service answers at port {}", port));
}

}  // namespace afm::haptics
