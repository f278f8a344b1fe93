// SPDX-License-Identifier: Apache-2.0
#include "forcedimension/dhd_device.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "core/log.h"
#include "drivers/release_patience.h"
#include "forcedimension/dhd_setup.h"

namespace afm::haptics {

namespace {

constexpr auto kSupervisionPeriod = std::chrono::milliseconds(5);
constexpr auto kFirstPositionPatience = std::chrono::seconds(1);
constexpr std::int64_t kSameSaturationNs = 10'000'000'000;
constexpr int kTurnOnButton = 0;  // only button of an omega, middle button of a Falcon

// Logs a refused part of the set-up that the device can do without.
void note(const DeviceSpec& spec, const std::string& what, const DhdFunctions& dhd, int result) {
  if (result >= 0) return;
  core::log_line(fmt::format("{}: {}: {}", spec.name, what, dhd::error_text(dhd, dhd.get_last_error())));
}

}  // namespace

core::Result<DeviceSpec> DhdDevice::query(const DhdFunctions& functions, const std::string& wanted) {
  const auto id = dhd::take_device(functions, wanted);
  if (!id) return tl::unexpected(id.error());
  auto spec = dhd::query_spec(functions, *id);
  functions.close(*id);
  return spec;
}

core::Result<std::unique_ptr<DhdDevice>> DhdDevice::open(const DhdFunctions& functions, const core::Clock& clock,
                                                         const std::string& wanted, Supervision supervision) {
  const auto id = dhd::take_device(functions, wanted);
  if (!id) return tl::unexpected(id.error());
  auto spec = dhd::query_spec(functions, *id);
  if (!spec) {
    functions.close(*id);
    return tl::unexpected(spec.error());
  }
  std::unique_ptr<DhdDevice> device(new DhdDevice(functions, clock, *id, std::move(*spec)));
  device->prepare();
  if (supervision == Supervision::Caller) return device;
  if (auto started = device->start(); !started) return tl::unexpected(started.error());
  return device;
}

DhdDevice::DhdDevice(const DhdFunctions& functions, const core::Clock& clock, DhdId id, DeviceSpec spec)
    : dhd_(functions),
      clock_(clock),
      id_(id),
      spec_(std::move(spec)),
      places_(spec_.workspace_min_m, spec_.workspace_max_m) {}

void DhdDevice::prepare() {
  note(spec_, "cannot carry the weight of its arm", dhd_, dhd_.set_gravity_compensation(1, id_));
  double mass_kg = 0;
  if (dhd_.get_effector_mass(&mass_kg, id_) >= 0)
    core::log_line(fmt::format("{}: gravity compensation for a handle of {:.0f} g", spec_.name, 1e3 * mass_kg));
  if (dhd_.has_gripper(id_))
    note(spec_, "closing the gripper cannot be used as Turn-On", dhd_, dhd_.emulate_button(1, id_));
  // keeps the library's own limit behind ours
  if (dhd_.set_max_force != nullptr)
    note(spec_, "the library does not limit the force", dhd_, dhd_.set_max_force(force_cap_n(spec_), id_));
  note(spec_, "the library refuses expert mode, so the device sets no watchdog", dhd_, dhd_.enable_expert_mode());
  note(spec_, "the device's own watchdog cannot be set", dhd_,
       dhd_.set_watchdog(static_cast<unsigned char>(kWatchdogNs / dhd::kWatchdogUnitNs), id_));
  dhd_.disable_expert_mode();
}

core::Result<void> DhdDevice::start() {
  threaded_ = true;
  thread_ = DriverThread([this] { serve(); });
  if (!wait_until(kFirstPositionPatience, [this] { return called_.load(); })) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot start {}: its driver did not answer within {} s; switch it off and on",
                                     spec_.name, kFirstPositionPatience.count()));
  }
  supervisor_ = std::thread([this] {
    while (!closing_.load()) {
      if (const auto line = supervise()) core::log_line(*line);
      std::this_thread::sleep_for(kSupervisionPeriod);
    }
  });
  return {};
}

DhdDevice::~DhdDevice() {
  closing_.store(true);
  if (threaded_) {
    // a thread that is caught in the library cannot switch the force off
    if (!wait_until(kReleasePatience, [this] { return released_.load(); })) cut_force();
    if (supervisor_.joinable()) supervisor_.join();
    thread_.join();
  } else {
    release();
  }
  dhd_.close(id_);
}

void DhdDevice::serve() noexcept {
  auto next = std::chrono::steady_clock::now();
  while (!closing_.load()) {
    run_cycle();
    next = std::max(next + std::chrono::nanoseconds(kPeriodNs), std::chrono::steady_clock::now());
    std::this_thread::sleep_until(next);
  }
  release();
  released_.store(true);
}

DhdHealth DhdDevice::health(std::int64_t now_ns) const noexcept {
  if (called_.load() && now_ns - last_fresh_ns_.load() > kStallNs && health_.load() == DhdHealth::Ready)
    return DhdHealth::Stalled;
  return health_.load();
}

std::optional<std::string> DhdDevice::supervise() {
  const std::int64_t now_ns = clock_.now_ns();
  const DhdHealth now = health(now_ns);
  const bool stalled = now == DhdHealth::Stalled;
  if (stalled && !cut_) {
    cut_force();
    output_cut_.store(true);
  }
  cut_ = stalled;
  if (told_.is_news(now, now_ns)) {
    const int error = stalled ? 0 : error_.load();
    return fmt::format("{}: {}{}", spec_.name, describe(now),
                       error == 0 ? "" : fmt::format("; the driver said: {}", dhd::error_text(dhd_, error)));
  }
  if (!saturated_.exchange(false)) return std::nullopt;
  if (saturation_told_ns_ != 0 && now_ns - saturation_told_ns_ < kSameSaturationNs) return std::nullopt;
  saturation_told_ns_ = now_ns;
  return fmt::format("{}: its motors cannot give the whole force here; move towards the middle", spec_.name);
}

void DhdDevice::run_cycle() noexcept {
  const std::int64_t now_ns = clock_.now_ns();
  const std::int64_t elapsed_ns = std::clamp<std::int64_t>(now_ns - cycle_ns_, 0, CommandFade::kReleaseNs);
  cycle_ns_ = now_ns;
  // the device did not leave force mode by itself
  if (output_cut_.exchange(false)) output_ = Output::Unknown;

  follow_status(now_ns);
  read_hand(now_ns);
  switch_output(own_health(now_ns) == DhdHealth::Ready, now_ns);
  send_force(now_ns, elapsed_ns);

  const DhdHealth health = own_health(now_ns);
  // a force that was refused must not stay for another period
  if (health != DhdHealth::Ready) switch_output(false, now_ns);
  frame_.ready = health == DhdHealth::Ready ? 1 : 0;
  mailbox_.publish(frame_);
  error_.store(static_cast<int>(fault_.code_of(health)));
  health_.store(health);
  last_fresh_ns_.store(frame_.time_ns);
  called_.store(true);
}

void DhdDevice::follow_status(std::int64_t now_ns) noexcept {
  if (state_ != DhdHealth::Starting && now_ns - status_ns_ < kStatusNs) return;
  status_ns_ = now_ns;
  std::array<int, dhd::kRoomForStatus> status{};
  if (dhd_.get_status(status.data(), id_) < 0) return raise_last_error(now_ns);
  if (status[dhd::kConnected] == 0) return raise(DhdHealth::ConnectionLost, 0, now_ns);
  if (status[dhd::kFailed] != 0) raise(DhdHealth::DeviceFault, 0, now_ns);

  const bool powered = status[dhd::kPowered] != 0;
  passive_ = !powered || status[dhd::kReset] != 0;
  if (passive_) {
    state_ = powered ? DhdHealth::NeedsCalibration : DhdHealth::NoPower;
    return;
  }
  follow_force_mode(status[dhd::kForceMode] != 0, status[dhd::kForceOffCause], now_ns);
  state_ = switched_off_.value_or(DhdHealth::Ready);
}

void DhdDevice::follow_force_mode(bool in_force_mode, int cause, std::int64_t now_ns) noexcept {
  if (in_force_mode) {
    // with our output off, only the user can have switched the force on
    if (output_ == Output::Off) switched_off_.reset();
    return;
  }
  if (output_ != Output::On || now_ns - output_on_ns_ < kForceModeNs) return;
  const DhdHealth health = dhd_health_after_cause(cause);
  if (health == DhdHealth::ForceButtonOff || health == DhdHealth::DeadManReleased) {
    // the device has done it already; the library must not hear that we do not want the force either
    switched_off_ = health;
    output_ = Output::Off;
  } else {
    raise(health, 0, now_ns);
  }
}

// Reads the position; keeps the last valid one while the device reports nonsense.
void DhdDevice::read_hand(std::int64_t now_ns) noexcept {
  if (passive_) {
    // it answers, but its position means nothing
    frame_.time_ns = now_ns;
    frame_.turn_on = 0;
    return;
  }
  double x = 0, y = 0, z = 0;
  const int result = dhd_.get_position(&x, &y, &z, id_);
  if (result < 0) return raise_last_error(now_ns);
  if (result != dhd::kTimeGuard) frame_.time_ns = now_ns;
  const glm::dvec3 position_m(y, z, x);
  if (places_.accepts(position_m)) {
    frame_.position_m = position_m;
  } else {
    raise(DhdHealth::ImplausiblePosition, 0, now_ns);
  }

  const int button = dhd_.get_button(kTurnOnButton, id_);
  frame_.turn_on = button > 0 ? 1 : 0;
  if (button < 0) raise(DhdHealth::ButtonFailed, dhd_.get_last_error(), now_ns);
}

void DhdDevice::switch_output(bool on, std::int64_t now_ns) noexcept {
  // leaving reset mode would end a calibration that the user is about to make
  if (passive_) output_ = Output::Unknown;
  const Output wanted = on ? Output::On : Output::Off;
  if (passive_ || output_ == wanted) return;
  if (!on) {
    if (output_ == Output::On) dhd_.set_force(0, 0, 0, 0, 0, 0, 0, id_);
    output_ = cut_force() ? Output::Off : Output::Unknown;
    return;
  }
  if (dhd_.enable_force(1, id_) < 0) return raise_last_error(now_ns);
  output_ = Output::On;
  output_on_ns_ = now_ns;
}

void DhdDevice::send_force(std::int64_t now_ns, std::int64_t elapsed_ns) noexcept {
  const glm::dvec3 force_n = mailbox_.wanted_n(now_ns, elapsed_ns);
  // what the user switches on again at the device is the last force that was set; and a Falcon finds its zero only
  // while it is sent forces (the SDK's example of two devices)
  if (switched_off_ || state_ == DhdHealth::NeedsCalibration) dhd_.set_force(0, 0, 0, 0, 0, 0, 0, id_);
  if (output_ != Output::On) return;
  const int result = dhd_.set_force(force_n.z, force_n.x, force_n.y, 0, 0, 0, 0, id_);
  if (result < 0) return raise_last_error(now_ns);
  if (result == dhd::kMotorSaturated) saturated_.store(true);
}

void DhdDevice::raise(DhdHealth fault, int error, std::int64_t now_ns) noexcept {
  fault_.raise(fault, dhd_recovery_ns(fault), static_cast<std::uint32_t>(error), now_ns);
}

void DhdDevice::raise_last_error(std::int64_t now_ns) noexcept {
  const int error = dhd_.get_last_error();
  raise(dhd_health_after(error), error, now_ns);
}

DhdHealth DhdDevice::own_health(std::int64_t now_ns) const noexcept {
  const bool stalled = state_ == DhdHealth::Ready && now_ns - frame_.time_ns > kStallNs;
  return fault_.health(stalled ? DhdHealth::Stalled : state_, now_ns);
}

void DhdDevice::release() noexcept {
  if (passive_) return;
  dhd_.set_force(0, 0, 0, 0, 0, 0, 0, id_);
  cut_force();
}

bool DhdDevice::cut_force() noexcept {
  const bool off = dhd_.enable_force(0, id_) >= 0;
  const bool braked = dhd_.set_brakes(1, id_) >= 0;
  return off || braked;
}

namespace {

// Loads the library, or returns nothing; logs the attempts.
std::optional<DhdFunctions> find_dhd(const Environment& environment, ProbeLog& log) {
  const DhdSearch search = load_dhd(environment(kFdLibraryVariable));
  log_attempts("forcedimension library", search.attempts, log);
  return search.functions;
}

}  // namespace

core::Result<std::unique_ptr<HapticDevice>> open_force_dimension(const DeviceRequest& request, ProbeLog& log) {
  const auto functions = find_dhd(request.environment, log);
  if (!functions) return no_library("forcedimension device", log, kFdLibraryVariable);
  auto device = DhdDevice::open(*functions, request.clock, request.environment(kFdDeviceVariable));
  if (!device) {
    log.missing(device.error().message);
    return tl::unexpected(device.error());
  }
  log.found((*device)->spec().name);
  return std::unique_ptr<HapticDevice>(std::move(*device));
}

void probe_force_dimension(const Environment& environment, ProbeLog& log) {
  const auto functions = find_dhd(environment, log);
  if (!functions) return;
  const auto spec = DhdDevice::query(*functions, environment(kFdDeviceVariable));
  if (!spec) return log.missing(spec.error().message);
  const glm::dvec3 workspace_mm = 1e3 * (spec->workspace_max_m - spec->workspace_min_m);
  log.found(fmt::format("{}: {:.2g} N peak, {:.0f} x {:.0f} x {:.0f} mm", spec->name, spec->max_force_n, workspace_mm.x,
                        workspace_mm.y, workspace_mm.z));
}

}  // namespace afm::haptics
