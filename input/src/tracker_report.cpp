// SPDX-License-Identifier: Apache-2.0
#include "input/tracker_report.h"

#include <fmt/format.h>

namespace afm::input {

namespace {

std::string losses(std::uint64_t good, std::uint64_t lost, std::uint64_t old, std::uint64_t bad) {
  return fmt::format("{} frames received, {} lost, {} late or repeated, {} malformed packets", good, lost, old, bad);
}

}  // namespace

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

std::optional<std::string> TrackerReport::follow(const DtrackUpdate& update, std::int64_t now_ns) {
  now_ = update;
  if (auto line = change_of_state(now_ns)) return line;
  if (reported_ns_ == 0) reported_ns_ = now_ns;
  if (state_ != State::Heard || now_ns - reported_ns_ < kIntervalNs) return std::nullopt;
  const std::uint64_t lost = now_.lost_frames - reported_.lost_frames;
  const std::uint64_t old = now_.old_packets - reported_.old_packets;
  const std::uint64_t bad = now_.bad_packets - reported_.bad_packets;
  std::optional<std::string> line;
  if (lost + old + bad > 0) {
    line = fmt::format("tracker: in {:.0f} s: {}", 1e-9 * static_cast<double>(now_ns - reported_ns_),
                       losses(now_.good_packets - reported_.good_packets, lost, old, bad));
  }
  reported_ = now_;
  reported_ns_ = now_ns;
  return line;
}

std::string TrackerReport::total() const {
  return fmt::format("tracker: in the whole run: {}",
                     losses(now_.good_packets, now_.lost_frames, now_.old_packets, now_.bad_packets));
}

}  // namespace afm::input
