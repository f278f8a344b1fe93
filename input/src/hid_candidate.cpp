// SPDX-License-Identifier: Apache-2.0
#include "hid_candidate.h"

#include <fmt/format.h>
#include <hidapi/hidapi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "core/log.h"

namespace afm::input {

namespace {

constexpr std::int64_t kFirstOpenPauseNs = 100'000'000;
constexpr std::int64_t kLongestOpenPauseNs = 6'400'000'000;
constexpr int kMostReportsAPoll = 64;
constexpr auto kSetUpPause = std::chrono::milliseconds(20);  // pause between reports; a Wii Remote drops an earlier one
constexpr std::size_t kLongestReport = 256;
constexpr const char* kRule =
    "copy 70-touchafm-wands.rules (in assets/wands; in a bundle: lib/udev/rules.d) to /etc/udev/rules.d, "
    "run sudo udevadm control --reload, replug it";

// Use of a wand: changes within a quarter of a second. Sticks vary by 0.02, sensors at rest drift by less than 1
// degree a second.
constexpr std::int64_t kUseMemoryNs = 250'000'000;
constexpr double kUsedDeflection = 0.05;
constexpr double kUsedTurnRad = 0.05;
constexpr std::int64_t kSettleNs = 2'000'000'000;  // settling time of an orientation filter

bool deflected(const glm::dvec3& now, const glm::dvec3& before) {
  const glm::dvec3 change = glm::abs(now - before);
  return std::max({change.x, change.y, change.z}) > kUsedDeflection;
}

bool turned(const WandState& now, const WandState& before) {
  if (!now.orientation_valid || !before.orientation_valid) return false;
  return glm::distance(ray_of(now).direction, ray_of(before).direction) > kUsedTurnRad;
}

}  // namespace

std::string plain_hid_text(const wchar_t* text) {
  std::string result;
  for (; text != nullptr && *text != L'\0'; ++text) {
    result += *text >= L' ' && *text < 0x7F ? static_cast<char>(*text) : '?';
  }
  return result;
}

std::string why_hid_is_closed(const std::string& path) {
  if (::access(path.c_str(), F_OK) == 0 && ::access(path.c_str(), R_OK | W_OK) != 0) {
    return fmt::format("permission denied for {}: {}", path, kRule);
  }
  return fmt::format("cannot open {} ({}): unplug it and plug it in again", path, plain_hid_text(hid_error(nullptr)));
}

struct HidCandidate::Device {
  explicit Device(hid_device* opened) : handle(opened) {}
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  ~Device() { hid_close(handle); }

  // Requests the calibration and sends the set-up reports. False if the device rejects them.
  bool set_up(HidDriver& driver) const {
    if (const auto request = driver.calibration()) {
      std::vector<std::vector<std::uint8_t>> reports;
      for (int i = 0; i < request->times; ++i) {
        std::vector<std::uint8_t> report(request->size);
        report[0] = request->id;
        const int got = hid_get_feature_report(handle, report.data(), report.size());
        if (got < 0) continue;  // fallback to nominal numbers
        report.resize(static_cast<std::size_t>(got));
        reports.push_back(std::move(report));
      }
      driver.calibrate(reports);
    }
    return write(driver.set_up());
  }

  // False if the device rejects one of them.
  bool write(const std::vector<std::vector<std::uint8_t>>& reports) const {
    for (const std::vector<std::uint8_t>& report : reports) {
      if (hid_write(handle, report.data(), report.size()) < 0) return false;
      std::this_thread::sleep_for(kSetUpPause);
    }
    return true;
  }

  hid_device* handle;
};

HidCandidate::HidCandidate(std::string path, const KnownHid& known)
    : path_(std::move(path)), known_(known), open_pause_ns_(kFirstOpenPauseNs) {}

HidCandidate::~HidCandidate() = default;

bool HidCandidate::try_to_open(const HandPlace& place, std::int64_t now_ns) {
  if (is_open() || now_ns < next_open_ns_) return false;
  next_open_ns_ = now_ns + open_pause_ns_;
  open_pause_ns_ = std::min(2 * open_pause_ns_, kLongestOpenPauseNs);
  std::string complaint;
  if (hid_device* const handle = hid_open_path(path_.c_str())) {
    auto device = std::make_unique<Device>(handle);
    auto driver = known_.make();
    if (device->set_up(*driver)) {
      device_ = std::move(device);
      wand_ = std::make_unique<HidWand>(std::move(driver), place);
      state_ = earlier_ = wand_->state(now_ns);
      earlier_ns_ = now_ns;
      steady_ns_ = now_ns + kSettleNs;
      return true;
    }
    complaint = fmt::format("wand: {} rejected its set-up ({})", name(), plain_hid_text(hid_error(handle)));
  } else {
    complaint = fmt::format("wand: {}: {}", name(), why_hid_is_closed(path_));
  }
  if (complaint != complaint_) core::log_line(complaint);
  complaint_ = complaint;
  return false;
}

void HidCandidate::refuse(std::span<const std::uint8_t> report) {
  if (++refused_ < next_refusal_) return;
  next_refusal_ *= 10;
  core::log_line(fmt::format(
      "wand: {} at {}: {} {} not understood, the last of {} bytes that begin with {:#04x}; if the wand does not react, "
      "describe it in a wand file",
      name(), path_, refused_, refused_ == 1 ? "report" : "reports", report.size(), report.empty() ? 0 : report[0]));
}

bool HidCandidate::read(int patience_ms, const core::Clock& clock) {
  std::array<std::uint8_t, kLongestReport> report;
  for (int i = 0; i < kMostReportsAPoll; ++i) {
    const int size = hid_read_timeout(device_->handle, report.data(), report.size(), i == 0 ? patience_ms : 0);
    if (size < 0) return false;
    if (size == 0) break;
    const std::int64_t now_ns = clock.now_ns();
    const auto received = Bytes(report).first(static_cast<std::size_t>(size));
    if (!wand_->take(received, now_ns)) refuse(received);
    if (!device_->write(wand_->take_answers())) return false;
    watch(now_ns);
  }
  watch(clock.now_ns());
  return true;
}

void HidCandidate::watch(std::int64_t now_ns) {
  state_ = wand_->state(now_ns);
  // a pedal stops the force and points nowhere
  const std::uint32_t pressed = state_.buttons & ~earlier_.buttons & ~bit(WandButton::Stop);
  const bool used = pressed != 0 || deflected(state_.push, earlier_.push) || deflected(state_.turn, earlier_.turn) ||
                    (now_ns > steady_ns_ && turned(state_, earlier_));
  if (used) used_ns_ = now_ns;
  if (!used && now_ns - earlier_ns_ < kUseMemoryNs && state_.buttons == earlier_.buttons) return;
  earlier_ = state_;
  earlier_ns_ = now_ns;
}

std::uint32_t HidCandidate::take_stops() { return state_.stops - std::exchange(counted_stops_, state_.stops); }

}  // namespace afm::input
