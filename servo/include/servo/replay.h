// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "core/result.h"
#include "servo/session_file.h"

namespace afm::servo {

// The first number of a tick or an event that a replay did not give again.
struct Difference {
  std::size_t index = 0;  // of the sample, or of the event
  std::string quantity;   // "hand_force_N"
  double recorded = 0;    // of an enumerator its number
  double replayed = 0;
};

struct Replay {
  std::size_t ticks = 0;   // that were compared
  std::size_t events = 0;  // that the replay gave
  std::size_t different_ticks = 0;
  std::optional<Difference> first;  // of the samples
  std::optional<Difference> first_event;
  double largest_tip_n = 0;   // difference of the force on the tip
  double largest_hand_n = 0;  // and on the hand, along the sample's normal

  bool identical() const { return !first && !first_event; }
};

// The part of a session that is compared, in seconds from its first tick. What came before it is felt again all the
// same, because the forces depend on it.
struct ReplayRange {
  double from_s = 0;
  double to_s = std::numeric_limits<double>::infinity();

  bool holds(double at_s) const { return at_s >= from_s && at_s <= to_s; }
};

// Runs the recorded hand through a servo at the recorded times, with the renderer's signs of life as they were, and
// compares every number bit for bit. Needs no clock, takes about a thousandth of the session's time. Fails if a servo
// refuses what the session says was felt.
core::Result<Replay> replay(const RecordedSession& session, const ReplayRange& range = {});

}  // namespace afm::servo
