// SPDX-License-Identifier: Apache-2.0
#include "input/tracker_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace afm::input {

namespace {

constexpr double kManyOld = 0.1;  // late or repeated packets as a share of the received ones

// Text with the counts of `now` since `before`.
std::string losses(const DtrackUpdate& now, const DtrackUpdate& before) {
  const std::uint64_t left_out = now.left_out - before.left_out;
  return fmt::format("{} frames received, {} lost, {} late or repeated, {} malformed packets{}",
                     now.good_packets - before.good_packets, now.lost_frames - before.lost_frames,
                     now.old_packets - before.old_packets, now.bad_packets - before.bad_packets,
                     left_out > 0 ? fmt::format(", {} bodies or lines left out", left_out) : "");
}

}  // namespace

std::string text_of(const DtrackFault& fault) {
  const std::string subject =
      fault.subject.empty() ? "" : fmt::format(": {}{}", fault.subject, fault.id ? fmt::format(" {}", *fault.id) : "");
  return fmt::format("{}{} is left out: {} (\"{}\")",
                     fault.line.empty() ? "a packet" : fmt::format("line {}", fault.line), subject, fault.reason,
                     fault.text.data());
}

std::optional<std::string> TrackerReport::change_of_state(std::int64_t now_ns) {
  const bool heard = now_.good_packets > 0;
  const bool silent = heard && now_ns - now_.time_ns > kSilenceNs;
  if (heard && !silent && state_ != State::Heard) {
    const bool again = state_ == State::Silent;
    state_ = State::Heard;
    return fmt::format("tracker: receiving frames{}", again ? " again" : "");
  }
  if (silent && state_ == State::Heard) {
    state_ = State::Silent;
    return fmt::format("tracker: no frame for {} s: check the measurement and the cable", kSilenceNs / 1'000'000'000);
  }
  if (!heard && state_ == State::Waiting && now_ns - began_ns_ > kPatienceNs) {
    state_ = State::Missing;
    return fmt::format("tracker: no frame in {} s{}: start the measurement, and send its output to {}",
                       kPatienceNs / 1'000'000'000,
                       now_.bad_packets > 0 ? fmt::format(", but {} malformed packets", now_.bad_packets) : "", place_);
  }
  return std::nullopt;
}

std::optional<std::string> TrackerReport::new_fault() {
  const std::size_t count = std::min(now_.faults.count, now_.faults.first.size());
  for (std::size_t i = 0; i < count && named_.size() < kMostFaults; ++i) {
    const DtrackFault& fault = now_.faults.first[i];
    const bool known =
        std::any_of(named_.begin(), named_.end(), [&](const DtrackFault& other) { return fault.same_kind(other); });
    if (known) continue;
    named_.push_back(fault);
    return "tracker: " + text_of(fault);
  }
  return std::nullopt;
}

std::optional<std::string> TrackerReport::missing_head(std::int64_t now_ns) {
  if (!awaited_head_ || now_.good_packets == 0) return std::nullopt;
  if (heard_ns_ == 0) heard_ns_ = now_ns;
  for (std::size_t i = 0; i < now_.frame.body_count; ++i) {
    if (now_.frame.bodies[i].tracked) seen_.insert(now_.frame.bodies[i].id);
  }
  const bool found = seen_.contains(*awaited_head_);
  if (!found && now_ns - heard_ns_ <= kPatienceNs) return std::nullopt;
  const std::uint32_t head = *awaited_head_;
  awaited_head_.reset();
  if (found) return std::nullopt;
  return fmt::format(
      "tracker: its frames have had no pose of body {}, the head, for {} s; of bodies: {}. Bring the glasses into view "
      "of "
      "the cameras, or name another body with --head",
      head, kPatienceNs / 1'000'000'000, seen_.empty() ? "none" : fmt::format("{}", fmt::join(seen_, ", ")));
}

std::optional<std::string> TrackerReport::new_losses(std::int64_t now_ns) {
  if (reported_ns_ == 0) reported_ns_ = now_ns;
  if (state_ != State::Heard || now_ns - reported_ns_ < kIntervalNs) return std::nullopt;
  const auto sum = [](const DtrackUpdate& u) { return u.lost_frames + u.old_packets + u.bad_packets + u.left_out; };
  std::optional<std::string> line;
  if (sum(now_) > sum(reported_)) {
    line = fmt::format("tracker: in {:.0f} s: {}", 1e-9 * static_cast<double>(now_ns - reported_ns_),
                       losses(now_, reported_));
    const std::uint64_t good = now_.good_packets - reported_.good_packets,
                        old = now_.old_packets - reported_.old_packets;
    if (static_cast<double>(old) > kManyOld * static_cast<double>(good))
      *line += fmt::format("; check that only one tracker sends, and once, to {}", place_);
  }
  reported_ = now_;
  reported_ns_ = now_ns;
  return line;
}

std::optional<std::string> TrackerReport::follow(const DtrackUpdate& update, std::int64_t now_ns) {
  now_ = update;
  std::optional<std::string> line = change_of_state(now_ns);
  if (!line) line = new_fault();
  if (!line) line = missing_head(now_ns);
  if (!line) line = new_losses(now_ns);
  return line;
}

std::string TrackerReport::total() const {
  return fmt::format("tracker: in the whole run: {}", losses(now_, DtrackUpdate{}));
}

}  // namespace afm::input
