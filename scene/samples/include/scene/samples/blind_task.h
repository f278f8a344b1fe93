// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "core/enumerators.h"
#include "physics/friction/sideways.h"
#include "physics/units.h"

namespace afm::scene {

// Tasks that are done by feel and sound: the wall is dark from the first touch to the end.
enum class BlindKind { Line, Threshold };
struct BlindKindRow {
  BlindKind kind;
  std::string_view word, meaning;
};
inline constexpr std::array kBlindKinds{
    BlindKindRow{BlindKind::Line, "line", "a particle is pushed along a line, at least as far as a target"},
    BlindKindRow{BlindKind::Threshold, "threshold",
                 "a pinned particle is pressed as hard as a loose one holds before it gives"}};
static_assert(core::has_row_for_each(kBlindKinds, &BlindKindRow::kind));

struct BlindTask {
  BlindKind kind = BlindKind::Line;
  std::size_t particle = 0;  // index in the set of the particle to push
  std::size_t target = 0;    // index in the set of its target; BlindKind::Line only

  bool operator==(const BlindTask&) const = default;
};

struct ParticleSet;

// Reason why a set does not allow the task, for its author; empty: it does. Its numbers are those of the set.
std::string why_not(const BlindTask& task, const ParticleSet& set);

// Largest relative error of an answer that counts as finding the threshold.
inline constexpr double kThresholdWithin = 0.2;

// Path of a particle relative to the line from its start to a target.
struct LineWay {
  physics::Length along;
  physics::Length aside;   // distance from the line
  physics::Length length;  // whole length of the line

  bool far_enough() const { return along >= length; }
};
LineWay way_along(const physics::Sideways<physics::Length>& start, const physics::Sideways<physics::Length>& target,
                  const physics::Sideways<physics::Length>& place);

// Force that a hand holds: the largest mean over kHeldNs of one contact, so that neither its tremor nor the lift
// counts. One thread.
class HeldForce {
 public:
  static constexpr std::int64_t kHeldNs = 1'000'000'000;

  // Call in order of time, in every tick of the contact.
  void add(std::int64_t time_ns, double force_n);

  // Ends the contact; empty if it was shorter than kHeldNs.
  std::optional<double> leave();

 private:
  struct Part {
    std::int64_t time_ns;
    double sum_n_ns;  // integral of the force over time, from the start of the contact
  };
  std::deque<Part> parts_;  // ticks of the newest kHeldNs
  double force_n_ = 0;      // newest force
  std::optional<double> most_n_;
};

}  // namespace afm::scene
