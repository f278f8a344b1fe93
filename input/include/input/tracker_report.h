// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "input/dtrack_source.h"

namespace afm::input {

// Sentence about a part of a packet that is left out, without the tracker's name.
std::string text_of(const DtrackFault& fault);

// Log lines about a tracker: when its frames begin, stop and continue, how many are lost, which parts of them cannot be
// read (each kind once), and a head that never appears. Main thread only.
class TrackerReport {
 public:
  // `place` is the address that the tracker sends to, as ADDRESS:PORT; `head` the body that the picture follows.
  TrackerReport(std::string place, std::int64_t now_ns, std::optional<std::uint32_t> head = std::nullopt)
      : place_(std::move(place)), began_ns_(now_ns), awaited_head_(head) {}

  // Call once per frame: returns a line if there is something new to report. Losses are summed over 10 s.
  std::optional<std::string> follow(const DtrackUpdate& update, std::int64_t now_ns);

  // Summary of the whole run.
  std::string total() const;

  static constexpr std::int64_t kPatienceNs = 5'000'000'000;   // longest wait for a first frame, and for the head in it
  static constexpr std::int64_t kSilenceNs = 1'000'000'000;    // shortest silence worth a line
  static constexpr std::int64_t kIntervalNs = 10'000'000'000;  // interval of lines about losses

 private:
  std::optional<std::string> change_of_state(std::int64_t now_ns);
  std::optional<std::string> new_fault();
  std::optional<std::string> missing_head(std::int64_t now_ns);
  std::optional<std::string> new_losses(std::int64_t now_ns);

  static constexpr std::size_t kMostFaults = 16;  // largest number of faults named; further ones are only counted

  std::string place_;
  std::int64_t began_ns_;
  enum class State { Waiting, Missing, Heard, Silent } state_ = State::Waiting;
  DtrackUpdate now_, reported_;
  std::int64_t reported_ns_ = 0;
  std::vector<DtrackFault> named_;
  std::optional<std::uint32_t> awaited_head_;
  std::set<std::uint32_t> seen_;  // numbers of the bodies that have had a pose
  std::int64_t heard_ns_ = 0;     // time of the first frame
};

}  // namespace afm::input
