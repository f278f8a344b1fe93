// SPDX-License-Identifier: Apache-2.0
#include "input/hid_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hidapi/hidapi.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <thread>
#include <utility>

#include "core/log.h"
#include "hid_candidate.h"

namespace afm::input {

namespace {

constexpr std::int64_t kLookPauseNs = 1'000'000'000;
constexpr int kReadPatienceMs = 10;
constexpr std::int64_t kKeepNs = 1'000'000'000;  // time for which a used wand keeps its place

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
      const std::string product = plain_hid_text(info->product_string);
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

// True for a device whose node, numbers or part of the name, as printed by `touchafm devices`, were requested. A pedal
// is always meant.
bool is_meant(const Seen& seen, const std::string& wanted) {
  const auto lower = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  return wanted.empty() || seen.known->only_stops || seen.path == wanted ||
         lower(seen.name).find(lower(wanted)) != std::string::npos ||
         lower(seen.known->name).find(lower(wanted)) != std::string::npos;
}

core::Result<void> start_library() {
  if (hid_init() == 0) return {};
  return core::failure(core::ErrorCategory::Failed, "cannot start the HID library: check that /sys is mounted");
}

}  // namespace

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
      finding.said =
          finding.usable ? fmt::format("{} at {}", seen.known->name, seen.path) : why_hid_is_closed(seen.path);
      if (finding.usable) hid_close(handle);
    }
    findings.push_back(std::move(finding));
  }
  return findings;
}

HidSource::HidSource(std::vector<HidMapping> mappings, const HandPlace& place, const core::Clock& clock,
                     std::string wanted)
    : mappings_(std::move(mappings)), place_(place), clock_(clock), wanted_(std::move(wanted)) {}

HidSource::~HidSource() = default;

core::Result<std::unique_ptr<HidSource>> HidSource::open(std::vector<HidMapping> mappings, const HandPlace& place,
                                                         const core::Clock& clock, const std::string& wanted) {
  if (auto started = start_library(); !started) return tl::unexpected(started.error());
  return std::unique_ptr<HidSource>(new HidSource(std::move(mappings), place, clock, wanted));
}

// Keeps the candidates that are still there, and adds the new ones.
void HidSource::look(std::int64_t now_ns) {
  next_look_ns_ = now_ns + kLookPauseNs;
  std::vector<std::unique_ptr<HidCandidate>> candidates;
  bool named = false;
  for (const Seen& seen : enumerate(mappings_)) {
    if (!seen.known || !seen.known->make || !is_meant(seen, wanted_)) continue;
    named = named || !seen.known->only_stops;
    const auto same = std::find_if(candidates_.begin(), candidates_.end(),
                                   [&](const auto& c) { return c && c->path() == seen.path; });
    candidates.push_back(same != candidates_.end() ? std::move(*same)
                                                   : std::make_unique<HidCandidate>(
                                                         seen.path, KnownHid{.name = seen.name,
                                                                             .make = seen.known->make,
                                                                             .only_stops = seen.known->only_stops}));
  }
  // an open one that is no longer listed is lost by its next reading
  for (auto& old : candidates_) {
    if (old && old->is_open()) candidates.push_back(std::move(old));
  }
  candidates_ = std::move(candidates);
  if (!named && !wanted_.empty() && !std::exchange(complained_, true)) {
    core::log_line(
        fmt::format("wand: no connected wand is \"{}\": plug it in, or choose a node, numbers or a name that "
                    "touchafm devices lists",
                    wanted_));
  }
}

void HidSource::open_candidates(std::int64_t now_ns) {
  std::vector<std::string> more;
  for (const auto& candidate : candidates_) {
    if (!candidate->try_to_open(place_, now_ns)) continue;
    if (followed_ == nullptr) {
      follow(*candidate, "");
    } else {
      more.push_back(candidate->name() + " at " + candidate->path());
    }
  }
  if (more.empty()) return;
  core::log_line(fmt::format("wand: also {}; the one that is moved or pressed is followed", fmt::join(more, ", ")));
}

void HidSource::follow(HidCandidate& candidate, const std::string& place) {
  followed_ = &candidate;
  core::log_line(fmt::format("wand: {}{}", candidate.name(), place));
}

// Selects the wand used last, unless the present one is in use.
void HidSource::choose(std::int64_t now_ns) {
  if (followed_ != nullptr && followed_->used_ns() != 0 &&
      (now_ns - followed_->used_ns() < kKeepNs || followed_->state().buttons != 0)) {
    return;
  }
  HidCandidate* newest = followed_;
  for (const auto& candidate : candidates_) {
    if (candidate->is_open() && (newest == nullptr || candidate->used_ns() > newest->used_ns()))
      newest = candidate.get();
  }
  if (newest != nullptr && newest != followed_) follow(*newest, " at " + newest->path());
}

// Returns whether the followed wand is still there.
bool HidSource::read_candidates() {
  bool kept = true;
  const auto is_lost = [&](const std::unique_ptr<HidCandidate>& candidate) {
    if (!candidate->is_open()) return false;
    const bool there = candidate->read(candidate.get() == followed_ ? kReadPatienceMs : 0, clock_);
    stops_ += candidate->take_stops();
    if (!there && candidate.get() == followed_) kept = false;
    return !there;
  };
  candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), is_lost), candidates_.end());
  return kept;
}

WandState HidSource::nothing() const {
  WandState none;
  none.time_ns = clock_.now_ns();
  none.position_m = place_.position_m;
  none.stops = stops_;
  return none;
}

WandState HidSource::poll() {
  const std::int64_t now_ns = clock_.now_ns();
  if (now_ns >= next_look_ns_) look(now_ns);
  open_candidates(now_ns);
  if (!read_candidates()) {
    core::log_line("wand: unplugged; plug it in again to continue");
    followed_ = nullptr;
    next_look_ns_ = 0;
    return nothing();
  }
  choose(clock_.now_ns());
  if (followed_ == nullptr) {
    std::this_thread::sleep_for(std::chrono::milliseconds(kReadPatienceMs));
    return nothing();
  }
  WandState state = followed_->state();
  state.stops = stops_;
  return state;
}

}  // namespace afm::input
