// SPDX-License-Identifier: Apache-2.0
#include "devices/gamepad_device.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "core/log.h"
#include "devices/gamepad_port.h"
#include "devices/sdl_library.h"

namespace afm::haptics {

namespace {

constexpr auto kPollPause = std::chrono::milliseconds(4);
constexpr double kDeadZone = 0.12;  // deflection below which a stick counts as released
constexpr double kFastestPlacedMPerS = 0.30;
constexpr std::int64_t kRepeatNs = 30'000'000;  // refresh interval of a lasting rumble
constexpr double kAudible = 0.02;               // smallest audible change of the hum
constexpr double kRestM = 0.060;                // initial position of the simulated hand
constexpr double kLowestM = -0.030, kHighestM = 0.075, kSidewaysM = 0.060, kDepthM = 0.030;

core::Result<int> start(const SdlFunctions& sdl) {
  // the process has no focused window, and Ctrl-C belongs to the servo
  sdl.set_hint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
  sdl.set_hint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  if (sdl.init(SDL_INIT_GAMECONTROLLER | SDL_INIT_HAPTIC) != 0) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         fmt::format("SDL2 cannot search for gamepads: {}", sdl.error()));
  }
  return sdl.count();
}

// Initialises SDL once per port, because each port shuts SDL down once when it is destroyed.
core::Result<std::vector<std::unique_ptr<GamepadPort>>> open_all(const SdlFunctions& sdl) {
  const auto count = start(sdl);
  if (!count) return tl::unexpected(count.error());
  std::vector<std::unique_ptr<GamepadPort>> ports;
  for (int i = 0; i < *count; ++i) {
    sdl.init(SDL_INIT_GAMECONTROLLER | SDL_INIT_HAPTIC);
    if (auto port = GamepadPort::open(sdl, i)) ports.push_back(std::move(*port));
  }
  sdl.quit(SDL_INIT_GAMECONTROLLER | SDL_INIT_HAPTIC);
  return ports;
}

double beyond_dead_zone(double stick) {
  const double share = std::max(0.0, std::abs(stick) - kDeadZone) / (1.0 - kDeadZone);
  return std::copysign(share * share, stick);  // finer control near the middle
}

glm::dvec3 within_reach(const glm::dvec3& aim_m) {
  return {std::clamp(aim_m.x, -kSidewaysM, kSidewaysM), std::clamp(aim_m.y, kLowestM, kHighestM),
          std::clamp(aim_m.z, -kDepthM, kDepthM)};
}

}  // namespace

core::Result<std::vector<GamepadDevice::Facts>> GamepadDevice::list(const SdlFunctions& sdl) {
  const auto ports = open_all(sdl);
  if (!ports) return tl::unexpected(ports.error());
  std::vector<Facts> facts;
  for (const auto& port : *ports) facts.push_back(port->facts());
  return facts;
}

core::Result<std::unique_ptr<GamepadDevice>> GamepadDevice::open(const SdlFunctions& sdl, const core::Clock& clock,
                                                                 Wanted wanted) {
  auto ports = open_all(sdl);
  if (!ports) return tl::unexpected(ports.error());
  auto best = std::find_if(ports->begin(), ports->end(), [](const auto& port) { return port->facts().force_feedback; });
  if (best == ports->end() && wanted == Wanted::Any) best = ports->begin();
  if (best == ports->end()) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         ports->empty() ? kNone
                                        : fmt::format("{} has no force feedback; --haptics gamepad uses it anyway",
                                                      ports->front()->facts().name));
  }
  std::unique_ptr<GamepadDevice> device(new GamepadDevice(clock, std::move(*best)));
  device->frames_.store({.time_ns = clock.now_ns(), .sticks = {}, .turn_on = 0, .attached = 1});
  device->thread_ = DriverThread([raw = device.get()] { raw->run(); });
  return device;
}

GamepadDevice::GamepadDevice(const core::Clock& clock, std::unique_ptr<GamepadPort> port)
    : clock_(clock),
      port_(std::move(port)),
      spec_(omni_like(port_->facts().name)),
      hand_(glm::dvec3(0.0, kRestM, 0.0)),
      rumble_(force_cap_n(spec_)),
      aim_m_(0.0, kRestM, 0.0) {}

GamepadDevice::~GamepadDevice() {
  closing_.store(true);
  thread_.join();
}

DeviceSample GamepadDevice::read(std::int64_t now_ns) noexcept {
  if (const auto frame = frames_.try_load()) seen_ = *frame;
  move_aim(now_ns);
  tick_ns_ = now_ns;
  hand_.follow({.target_m = {aim_m_.x, aim_m_.y, aim_m_.z},
                .duration_s = 0.0,
                .revision = ++script_,
                .turn_on_pressed = seen_.turn_on});
  DeviceSample sample = hand_.read(now_ns);
  sample.healthy = seen_.attached != 0 && now_ns - seen_.time_ns <= kStallNs;
  sample.finished_script = 0;  // the gamepad runs no scripts
  return sample;
}

void GamepadDevice::move_aim(std::int64_t now_ns) noexcept {
  if (now_ns - seen_.time_ns > kCoastNs || tick_ns_ == 0) return;
  const double seconds = 1e-9 * static_cast<double>(std::clamp<std::int64_t>(now_ns - tick_ns_, 0, kCoastNs));
  for (int axis = 0; axis < 3; ++axis) {
    const double stick = seen_.sticks[static_cast<std::size_t>(axis)];
    if (port_->facts().force_feedback) {
      const double wanted_m = (axis == 1 ? 0.5 * (kLowestM + kHighestM) : 0.0) + kReachM * stick;
      const double reach_m = kFastestPlacedMPerS * seconds;
      aim_m_[axis] = std::clamp(wanted_m, aim_m_[axis] - reach_m, aim_m_[axis] + reach_m);
    } else {
      aim_m_[axis] += kFastestMPerS * beyond_dead_zone(stick) * seconds;
    }
  }
  aim_m_ = within_reach(aim_m_);
}

void GamepadDevice::write(const ForceCommand& command) noexcept {
  hand_.write(command);
  const glm::dvec3& force_n = command.force_n();
  const double length_n = std::hypot(force_n.x, force_n.y, force_n.z);
  feelings_.store(
      {.time_ns = tick_ns_, .force_n = {force_n.x, force_n.y, force_n.z}, .rumble = rumble_.step(length_n, tick_ns_)});
}

void GamepadDevice::run() {
  bool attached = true;
  while (!closing_.load()) {
    if (attached && !port_->update()) {
      attached = false;
      core::log_line(fmt::format("{}: unplugged; plug it in, then start again", spec_.name));
    }
    const std::int64_t now_ns = clock_.now_ns();
    Frame frame{.time_ns = now_ns, .sticks = {}, .turn_on = 0, .attached = attached ? 1U : 0U};
    if (attached) {
      frame.sticks = port_->sticks();
      frame.turn_on = port_->turn_on() ? 1 : 0;
    }
    frames_.store(frame);

    if (attached) show(feelings_.try_load().value_or(Feeling{}), now_ns);
    std::this_thread::sleep_for(kPollPause);
  }
}

void GamepadDevice::show(const Feeling& feeling, std::int64_t now_ns) {
  const bool fresh = now_ns - feeling.time_ns <= kStaleNs;
  if (port_->facts().force_feedback) {
    const auto& [x, y, z] = feeling.force_n;
    port_->push(fresh ? glm::dvec3(x, y, z) / force_cap_n(spec_) : glm::dvec3(0.0));
  }
  if (!port_->facts().rumble) return;
  const Rumble rumble = fresh ? feeling.rumble : Rumble{};
  const bool silent = rumble.heavy == 0.0 && rumble.light == 0.0;
  const bool changed =
      rumble.heavy != told_.heavy || std::abs(rumble.light - told_.light) > kAudible || (silent && told_.light > 0.0);
  if (!changed && (silent || now_ns - logged_ns_ <= kRepeatNs)) return;
  port_->rumble(rumble);
  told_ = rumble;
  logged_ns_ = now_ns;
}

core::Result<std::unique_ptr<HapticDevice>> open_gamepad(const DeviceRequest& request, ProbeLog& log) {
  const auto refused = [&](const core::Error& error) {
    log.missing(error.message);
    return core::failure(error.category, "no gamepad: " + error.message);
  };
  const auto sdl = load_sdl();
  if (!sdl) return refused(sdl.error());
  using Wanted = GamepadDevice::Wanted;
  auto device = GamepadDevice::open(*sdl, request.clock,
                                    request.choice == DeviceChoice::ByName ? Wanted::Any : Wanted::ForceFeedback);
  if (!device) return refused(device.error());
  log.found((*device)->spec().name);
  return std::unique_ptr<HapticDevice>(std::move(*device));
}

void probe_gamepads(const Environment& /*environment*/, ProbeLog& log) {
  const auto sdl = load_sdl();
  const auto found = sdl ? GamepadDevice::list(*sdl) : tl::unexpected(sdl.error());
  if (!found) return log.missing(found.error().message);
  if (found->empty()) log.missing(GamepadDevice::kNone);
  for (const GamepadDevice::Facts& pad : *found) {
    const char* shows = pad.force_feedback ? "force feedback"
                        : pad.rumble       ? "rumble"
                                           : "moves the hand, renders no force";
    log.found(fmt::format("{}: {}", pad.name, shows));
  }
}

}  // namespace afm::haptics
