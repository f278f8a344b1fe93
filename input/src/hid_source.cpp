// SPDX-License-Identifier: Apache-2.0
#include "input/hid_source.h"

#include <fmt/format.h>
#include <hidapi/hidapi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cwchar>
#include <thread>
#include <utility>

#include "core/log.h"

namespace afm::input {

namespace {

constexpr std::int64_t kLookPauseNs = 1'000'000'000;
constexpr std::int64_t kFirstOpenPauseNs = 100'000'000;
constexpr std::int64_t kLongestOpenPauseNs = 6'400'000'000;
constexpr int kReadPatienceMs = 10;
constexpr int kMostReportsAPoll = 64;
constexpr auto kSetUpPause = std::chrono::milliseconds(20);  // a Wii Remote drops an output report sent sooner
constexpr std::size_t kLongestReport = 256;
constexpr const char* kRule =
    "copy assets/wands/70-touchafm-wands.rules to /etc/udev/rules.d, run sudo udevadm control --reload, replug it";

// Reduces a text to printable ASCII, since a device's own name may contain terminal codes.
std::string plain(const wchar_t* text) {
  std::string result;
  for (; text != nullptr && *text != L'\0'; ++text) {
    result += *text >= L' ' && *text < 0x7F ? static_cast<char>(*text) : '?';
  }
  return result;
}

struct Seen {
  std::string path;
  std::string name;
  std::optional<KnownHid> known;
};

// Lists each device once, although hidapi lists it once per usage.
std::vector<Seen> enumerate(const std::vector<HidMapping>& mappings) {
  std::vector<Seen> seen;
  hid_device_info* const first = hid_enumerate(0, 0);
  for (const hid_device_info* info = first; info != nullptr; info = info->next) {
    const HidIdentity identity{
        .vendor = info->vendor_id, .product = info->product_id, .usage_page = info->usage_page, .usage = info->usage};
    const auto known = identify(identity, mappings);
    auto same = std::find_if(seen.begin(), seen.end(), [&](const Seen& s) { return s.path == info->path; });
    if (same == seen.end()) {
      const std::string product = plain(info->product_string);
      seen.push_back({info->path,
                      fmt::format("{} ({:04x}:{:04x})", product.empty() ? "HID device" : product, info->vendor_id,
                                  info->product_id),
                      known});
    } else if (known && (!same->known || !same->known->make)) {
      same->known = known;
    }
  }
  hid_free_enumeration(first);
  std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.path < b.path; });
  return seen;
}

std::string why_not_open(const std::string& path) {
  if (::access(path.c_str(), F_OK) == 0 && ::access(path.c_str(), R_OK | W_OK) != 0) {
    return fmt::format("permission denied for {}: {}", path, kRule);
  }
  return fmt::format("cannot open {} ({}): unplug it and plug it in again", path, plain(hid_error(nullptr)));
}

core::Result<void> start_library() {
  if (hid_init() == 0) return {};
  return core::failure(core::ErrorCategory::Failed, "cannot start the HID library: check that /sys is mounted");
}

}  // namespace

struct HidSource::Device {
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
        if (got < 0) continue;  // falls back to nominal numbers
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

core::Result<std::vector<HidFinding>> find_hid_wands(const std::vector<HidMapping>& mappings) {
  if (auto started = start_library(); !started) return tl::unexpected(started.error());
  std::vector<HidFinding> findings;
  for (const Seen& seen : enumerate(mappings)) {
    HidFinding finding{.path = seen.path, .name = seen.name, .is_wand = false, .usable = false, .said = ""};
    if (!seen.known) {
      finding.said = "not a known wand; a wand file can describe it";
    } else if (!seen.known->make) {
      finding.said = seen.known->name + ": not a wand";
    } else {
      finding.is_wand = true;
      hid_device* const handle = hid_open_path(seen.path.c_str());
      finding.usable = handle != nullptr;
      finding.said = finding.usable ? fmt::format("{} at {}", seen.known->name, seen.path) : why_not_open(seen.path);
      if (finding.usable) hid_close(handle);
    }
    findings.push_back(std::move(finding));
  }
  return findings;
}

HidSource::HidSource(std::vector<HidMapping> mappings, const HandPlace& place, const core::Clock& clock)
    : mappings_(std::move(mappings)), place_(place), clock_(clock) {}

HidSource::~HidSource() = default;

core::Result<std::unique_ptr<HidSource>> HidSource::open(std::vector<HidMapping> mappings, const HandPlace& place,
                                                         const core::Clock& clock) {
  if (auto started = start_library(); !started) return tl::unexpected(started.error());
  return std::unique_ptr<HidSource>(new HidSource(std::move(mappings), place, clock));
}

void HidSource::look(std::int64_t now_ns) {
  next_look_ns_ = now_ns + kLookPauseNs;
  std::vector<std::string> paths;
  known_.clear();
  for (const Seen& seen : enumerate(mappings_)) {
    if (!seen.known || !seen.known->make) continue;
    paths.push_back(seen.path);
    known_.push_back({.name = seen.name, .make = seen.known->make});
  }
  if (paths == paths_) return;
  paths_ = std::move(paths);
  next_open_ns_ = now_ns;
  open_pause_ns_ = kFirstOpenPauseNs;
}

void HidSource::try_to_open(std::int64_t now_ns) {
  next_open_ns_ = now_ns + open_pause_ns_;
  open_pause_ns_ = std::min(2 * open_pause_ns_, kLongestOpenPauseNs);
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    hid_device* const handle = hid_open_path(paths_[i].c_str());
    if (handle == nullptr) {
      complain(fmt::format("wand: {}: {}", known_[i].name, why_not_open(paths_[i])));
      continue;
    }
    auto device = std::make_unique<Device>(handle);
    auto driver = known_[i].make();
    if (!device->set_up(*driver)) {
      complain(fmt::format("wand: {} rejected its set-up ({})", known_[i].name, plain(hid_error(handle))));
      continue;
    }
    device_ = std::move(device);
    wand_ = std::make_unique<HidWand>(std::move(driver), place_);
    complaint_.clear();
    core::log_line(fmt::format("wand: {}", known_[i].name));
    return;
  }
}

void HidSource::complain(const std::string& complaint) {
  if (complaint == complaint_) return;
  complaint_ = complaint;
  core::log_line(complaint);
}

void HidSource::lose() {
  core::log_line("wand: unplugged; plug it in again to continue");
  wand_.reset();
  device_.reset();
  paths_.clear();
  next_look_ns_ = 0;
}

WandState HidSource::nothing() const {
  WandState none;
  none.time_ns = clock_.now_ns();
  none.position_m = place_.position_m;
  return none;
}

WandState HidSource::poll() {
  if (!device_) {
    const std::int64_t now_ns = clock_.now_ns();
    if (now_ns >= next_look_ns_) look(now_ns);
    if (!paths_.empty() && now_ns >= next_open_ns_) try_to_open(now_ns);
  }
  if (!device_) {
    std::this_thread::sleep_for(std::chrono::milliseconds(kReadPatienceMs));
    return nothing();
  }
  std::array<std::uint8_t, kLongestReport> report;
  for (int i = 0; i < kMostReportsAPoll; ++i) {
    const int size = hid_read_timeout(device_->handle, report.data(), report.size(), i == 0 ? kReadPatienceMs : 0);
    if (size == 0) break;
    if (size < 0) {
      lose();
      return nothing();
    }
    if (!wand_->take(Bytes(report).first(static_cast<std::size_t>(size)), clock_.now_ns())) ++refused_;
    if (!device_->write(wand_->take_answers())) {
      lose();
      return nothing();
    }
  }
  return wand_->state(clock_.now_ns());
}

}  // namespace afm::input
