// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "input/dtrack_source.h"

namespace afm::input {

// Log lines about a tracker: when its frames begin, stop and continue, and how many are lost. Main thread only.
class TrackerReport {
 public:
  // `place` is the address that the tracker sends to, as ADDRESS:PORT.
  TrackerReport(std::string place, std::int64_t now_ns) : place_(std::move(place)), began_ns_(now_ns) {}

  // Call once per frame: returns a line if there is something new to report. Losses are summed over 10 s.
  std::optional<std::string> follow(const DtrackUpdate& update, std::int64_t now_ns);

  // Summary of the whole run.
  std::string total() const;

  static constexpr std::int64_t kPatienceNs = 5'000'000'000;   // wait for the first frame
  static constexpr std::int64_t kSilenceNs = 1'000'000'000;    // shortest silence worth a line
  static constexpr std::int64_t kIntervalNs = 10'000'000'000;  // between two lines about losses

 private:
  std::optional<std::string> change_of_state(std::int64_t now_ns);

  std::string place_;
  std::int64_t began_ns_;
  enum class State { Waiting, Missing, Heard, Silent } state_ = State::Waiting;
  DtrackUpdate now_, reported_;
  std::int64_t reported_ns_ = 0;
};

}  // namespace afm::input
