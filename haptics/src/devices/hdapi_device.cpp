// SPDX-License-Identifier: Apache-2.0
#include "devices/hdapi_device.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <glm/geometric.hpp>
#include <utility>

#include "core/log.h"
#include "devices/hdapi_numbers.h"
#include "devices/hdapi_setup.h"
#include "drivers/release_patience.h"

namespace afm::haptics {

namespace {

constexpr std::int64_t kSchedulerPeriodNs = 1'000'000;
constexpr auto kSupervisionPause = std::chrono::milliseconds(5);
constexpr auto kFirstFramePatience = std::chrono::seconds(1);
constexpr int kMostErrorsInAFrame = 8;

}  // namespace

core::Result<DeviceSpec> HdapiDevice::query(const HdapiFunctions& functions, const std::string& name) {
  const auto handle = hdapi::take_device(functions, name);
  if (!handle) return tl::unexpected(handle.error());
  auto spec = hdapi::query_spec(functions);
  functions.disable_device(*handle);
  return spec;
}

core::Result<std::unique_ptr<HdapiDevice>> HdapiDevice::open(const HdapiFunctions& functions, const core::Clock& clock,
                                                             const std::string& name, Supervision supervision) {
  const auto handle = hdapi::take_device(functions, name);
  if (!handle) return tl::unexpected(handle.error());
  auto spec = hdapi::query_spec(functions);
  if (!spec) {
    functions.disable_device(*handle);
    return tl::unexpected(spec.error());
  }
  std::unique_ptr<HdapiDevice> device(new HdapiDevice(functions, clock, *handle, std::move(*spec)));
  if (auto started = device->start(supervision); !started) return tl::unexpected(started.error());
  return device;
}

HdapiDevice::HdapiDevice(const HdapiFunctions& functions, const core::Clock& clock, HdapiHandle handle, DeviceSpec spec)
    : hd_(functions),
      clock_(clock),
      handle_(handle),
      spec_(std::move(spec)),
      places_(spec_.workspace_min_m, spec_.workspace_max_m),
      calibration_{.style = hdapi::calibration_style(functions)} {
  spec_.force_lasts_s = core::seconds(CommandFade::kStaleNs);
}

core::Result<void> HdapiDevice::start(Supervision supervision) {
  // keeps the driver's own clamp behind ours
  hd_.enable(hdapi::kForceClamping);
  hd_.set_scheduler_rate(1'000'000'000 / kSchedulerPeriodNs);
  hdapi::take_newest_error(hd_);  // errors of both settings, neither of them vital

  // inside a frame, a device without this property would look like a failed one
  std::array<double, hdapi::kRoomForValues> heat{};
  hd_.get_doubles(hdapi::kMotorTemperature, heat.data());
  measures_heat_ = hdapi::take_newest_error(hd_).code == 0;

  const HdapiSchedulerHandle callback = hd_.schedule_asynchronous(&HdapiDevice::call, this, hdapi::kHighestPriority);
  HdapiError error = hdapi::take_newest_error(hd_);
  if (error.code == 0 && callback != hdapi::kInvalidCallback) {
    callback_ = callback;
    hd_.start_scheduler();
    scheduler_started_ = true;
    error = hdapi::take_newest_error(hd_);
  }
  if (error.code != 0 || !callback_) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot start {}: {}; close other programs that use it", spec_.name,
                                     hdapi::error_text(hd_, error.code)));
  }
  if (supervision == Supervision::Caller) return {};
  if (!wait_until(kFirstFramePatience, [this] { return called_.load(); })) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot start {}: its driver did not call within {} s; switch it off and on",
                                     spec_.name, kFirstFramePatience.count()));
  }
  supervisor_ = std::thread([this] {
    while (!closing_.load()) {
      if (const auto line = supervise()) core::log_line(*line);
      std::this_thread::sleep_for(kSupervisionPause);
    }
  });
  return {};
}

HdapiDevice::~HdapiDevice() {
  closing_.store(true);
  if (supervisor_.joinable()) supervisor_.join();
  // a stalled scheduler cannot send the zero; its output is already off
  if (scheduler_started_) wait_until(kReleasePatience, [this] { return released_.load(); });
  hd_.make_current_device(handle_);
  hd_.disable(hdapi::kForceOutput);
  if (scheduler_started_) hd_.stop_scheduler();
  if (callback_) hd_.unschedule(*callback_);
  hd_.disable_device(handle_);
}

HdapiHealth HdapiDevice::health(std::int64_t now_ns) const noexcept {
  if (called_.load() && now_ns - last_frame_ns_.load() > kStallNs) return HdapiHealth::SchedulerStalled;
  return health_.load();
}

std::optional<std::string> HdapiDevice::supervise() {
  const HdapiHealth now = health(clock_.now_ns());
  const bool stalled = now == HdapiHealth::SchedulerStalled;
  if (stalled && !cut_) {
    hd_.make_current_device(handle_);
    hd_.disable(hdapi::kForceOutput);
    output_cut_.store(true);
  }
  cut_ = stalled;
  if (!told_.is_news(now, clock_.now_ns())) return std::nullopt;
  const std::uint32_t code = stalled ? 0 : error_code_.load();
  return fmt::format("{}: {}{}", spec_.name, describe(now),
                     code == 0 ? "" : fmt::format("; the driver said: {}", hdapi::error_text(hd_, code)));
}

std::uint32_t HdapiDevice::call(void* self) noexcept {
  static_cast<HdapiDevice*>(self)->run_frame();
  return hdapi::kContinue;
}

void HdapiDevice::run_frame() noexcept {
  const std::int64_t now_ns = clock_.now_ns();
  const std::int64_t elapsed_ns = std::clamp<std::int64_t>(now_ns - frame_.time_ns, 0, CommandFade::kReleaseNs);
  frame_.time_ns = now_ns;

  hd_.begin_frame(handle_);
  read_hand(now_ns);
  follow_calibration(now_ns);
  const bool closing = closing_.load();
  switch_output(own_health(now_ns) == HdapiHealth::Ready && !closing);
  send_force(now_ns, elapsed_ns);
  hd_.end_frame(handle_);
  take_errors(now_ns);

  const HdapiHealth health = own_health(now_ns);
  frame_.ready = health == HdapiHealth::Ready ? 1 : 0;
  mailbox_.publish(frame_);
  error_code_.store(fault_.code_of(health));
  health_.store(health);
  last_frame_ns_.store(now_ns);
  called_.store(true);
  if (closing) released_.store(true);
}

// Reads the position; keeps the last valid one while the device reports nonsense.
void HdapiDevice::read_hand(std::int64_t now_ns) noexcept {
  std::array<double, hdapi::kRoomForValues> mm{};
  hd_.get_doubles(hdapi::kPosition, mm.data());
  std::array<std::int32_t, hdapi::kRoomForValues> buttons{};
  hd_.get_integers(hdapi::kButtons, buttons.data());
  frame_.turn_on = (static_cast<std::uint32_t>(buttons[0]) & hdapi::kFirstButton) != 0 ? 1 : 0;
  if (measures_heat_) {
    std::array<double, hdapi::kRoomForValues> heat{};
    hd_.get_doubles(hdapi::kMotorTemperature, heat.data());
    frame_.motor_heat = 0.0;
    for (const double one : heat) {
      // a broken sensor (NaN) must not hide a hot motor
      if (one > frame_.motor_heat) frame_.motor_heat = one;
    }
  }

  const glm::dvec3 position_m = 1e-3 * glm::dvec3(mm[0], mm[1], mm[2]);
  if (places_.accepts(position_m)) {
    frame_.position_m = position_m;
  } else {
    raise(HdapiHealth::ImplausiblePosition, 0, now_ns);
  }
}

void HdapiDevice::follow_calibration(std::int64_t now_ns) noexcept {
  if (calibration_.health != HdapiHealth::Starting && now_ns - calibration_.checked_ns < kCalibrationCheckNs) return;
  calibration_.checked_ns = now_ns;
  const std::uint32_t status = hd_.check_calibration();
  if (status == hdapi::kCalibrated) {
    calibration_.health = HdapiHealth::Ready;
  } else if (status == hdapi::kNeedsUpdate) {
    // the new origin may move the hand's position, so never while a force is on
    if (output_ == Output::Off) hd_.update_calibration(calibration_.style);
    calibration_.health = HdapiHealth::Calibrating;
  } else {
    calibration_.health = HdapiHealth::NeedsInkwell;
  }
}

void HdapiDevice::switch_output(bool on) noexcept {
  if (output_cut_.exchange(false)) output_ = Output::Unknown;
  const Output wanted = on ? Output::On : Output::Off;
  if (output_ == wanted) return;
  if (on) {
    hd_.enable(hdapi::kForceOutput);
  } else {
    hd_.disable(hdapi::kForceOutput);
  }
  output_ = wanted;
}

void HdapiDevice::send_force(std::int64_t now_ns, std::int64_t elapsed_ns) noexcept {
  const glm::dvec3 wanted_n = mailbox_.wanted_n(now_ns, elapsed_ns);
  const glm::dvec3 target_n = output_ == Output::On ? wanted_n : glm::dvec3(0.0);
  // two of the servo's ticks may fall between two callbacks
  const double seconds = 1e-9 * static_cast<double>(std::min(elapsed_ns, kSchedulerPeriodNs));
  const double longest_step_n = kUsableLimitShare * spec_.max_slew_n_per_s * seconds;
  const glm::dvec3 step_n = target_n - force_n_;
  const double length = glm::length(step_n);
  force_n_ = target_n == glm::dvec3(0.0) || length <= longest_step_n ? target_n
                                                                     : force_n_ + step_n * (longest_step_n / length);
  const std::array<double, 3> newtons{force_n_.x, force_n_.y, force_n_.z};
  hd_.set_doubles(hdapi::kForce, newtons.data());
}

void HdapiDevice::take_errors(std::int64_t now_ns) noexcept {
  for (int i = 0; i < kMostErrorsInAFrame; ++i) {
    const HdapiError error = hd_.get_error();
    if (error.code == 0) return;
    raise(health_after(error.code), error.code, now_ns);
  }
}

void HdapiDevice::raise(HdapiHealth fault, std::uint32_t error_code, std::int64_t now_ns) noexcept {
  fault_.raise(fault, recovery_ns(fault), error_code, now_ns);
}

HdapiHealth HdapiDevice::own_health(std::int64_t now_ns) const noexcept {
  return fault_.health(calibration_.health, now_ns);
}

namespace {

// Loads the library, or returns nothing; logs the attempts.
std::optional<HdapiFunctions> find_library(const Environment& environment, ProbeLog& log) {
  const HdapiSearch search = load_hdapi(environment(kHdLibraryVariable));
  log_attempts("hdapi library", search.attempts, log);
  return search.functions;
}

}  // namespace

core::Result<std::unique_ptr<HapticDevice>> open_hdapi(const DeviceRequest& request, ProbeLog& log) {
  const auto functions = find_library(request.environment, log);
  if (!functions) return no_library("hdapi device", log, kHdLibraryVariable);
  auto device = HdapiDevice::open(*functions, request.clock, request.environment(kHdDeviceVariable));
  if (!device) {
    log.missing(device.error().message);
    return tl::unexpected(device.error());
  }
  log.found((*device)->spec().name);
  return std::unique_ptr<HapticDevice>(std::move(*device));
}

void probe_hdapi(const Environment& environment, ProbeLog& log) {
  const auto functions = find_library(environment, log);
  if (!functions) return;
  const auto spec = HdapiDevice::query(*functions, environment(kHdDeviceVariable));
  if (!spec) return log.missing(spec.error().message);
  const glm::dvec3 workspace_mm = 1e3 * (spec->workspace_max_m - spec->workspace_min_m);
  log.found(fmt::format("{}: {:.2g} N peak, {:.2g} N continuous, {:.0f} x {:.0f} x {:.0f} mm", spec->name,
                        spec->max_force_n, spec->max_continuous_force_n, workspace_mm.x, workspace_mm.y,
                        workspace_mm.z));
}

}  // namespace afm::haptics
