// SPDX-License-Identifier: Apache-2.0
#include "hand_moves.h"

#include <fmt/format.h>

#include "physics/contact_parameters.h"
#include "physics/quantity_text.h"
#include "scene/samples/hand_script.h"

namespace afm::scene {
namespace {

using physics::Length;

constexpr Length kHighestPlace{1e-5};
constexpr physics::Velocity kSlowestHand{1e-11}, kFastestHand{1e-4};
constexpr physics::Time kLongestWait{3600.0};
constexpr Length kLeastSweep{1e-10};  // smallest width and spacing of lines
constexpr double kMostLines = 10'000.0;

template <class Q, class Units>
Q within(const TomlTable& table, std::string_view key, const Units& units, Q least, Q most) {
  const Q value = table.quantity(key, units);
  if (!(value >= least && value <= most)) {
    table.refuse(key, fmt::format("{} is not within {}", physics::format_quantity(value, units),
                                  physics::range_text(least.si, most.si, units)));
  }
  return value;
}

void read_sweep(const TomlTable& table, const physics::LeverBase& from, HandMove& move) {
  if (!table.has("sweep_width")) {
    if (table.has("line_spacing")) table.refuse("line_spacing", "belongs to a sweep_width");
    return;
  }
  move.sweep_width = within(table, "sweep_width", physics::kLengthUnits, kLeastSweep, kWidestPlace);
  move.line_spacing = within(table, "line_spacing", physics::kLengthUnits, kLeastSweep, kWidestPlace);
  const double lines = lines_of(from, move);
  if (!(lines > 0.0)) table.refuse("sweep_width", "a sweep goes across its path, and this move stays where it is");
  if (lines > kMostLines) {
    table.refuse("line_spacing", fmt::format("the sweep has {:.0f} lines, {:.0f} at most", lines, kMostLines));
  }
}

}  // namespace

Length place(const TomlTable& table, std::string_view key, Length most) {
  const Length value = table.quantity(key, physics::kLengthUnits);
  if (!(value >= -most && value <= most)) {
    table.refuse(key, fmt::format("{} is not within -{} to {}", physics::format_quantity(value, physics::kLengthUnits),
                                  physics::format_quantity(most, physics::kLengthUnits),
                                  physics::format_quantity(most, physics::kLengthUnits)));
  }
  return value;
}

physics::LeverBase base(const TomlTable& table) {
  return {{place(table, "x", kWidestPlace), place(table, "y", kWidestPlace)}, place(table, "z", kHighestPlace)};
}

HandMove read_move(const TomlTable& table, const physics::LeverBase& from, bool soft) {
  table.allow_only({"x", "y", "z", "speed", "wait", "sweep_width", "line_spacing"});
  if (soft && table.has("wait")) table.refuse("wait", "a soft sample does not change while the hand waits");
  if (soft && table.has("sweep_width")) table.refuse("sweep_width", "a soft sample has no particles to sweep");
  HandMove move{.to = base(table),
                .speed = within(table, "speed", physics::kVelocityUnits, kSlowestHand, kFastestHand)};
  read_sweep(table, from, move);
  if (table.has("wait")) move.wait = within(table, "wait", physics::kTimeUnits, physics::Time(0.0), kLongestWait);
  return move;
}

}  // namespace afm::scene
