// SPDX-License-Identifier: Apache-2.0
#include "hand_moves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "physics/contact_parameters.h"
#include "physics/manipulation/half_turn.h"
#include "physics/manipulation/tip_contact.h"
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
constexpr double kTouching = 1e-6;  // overlap that is a touch, in radii

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
  if (!table.has("line_spacing")) table.refuse("line_spacing", "is missing; a sweep needs the distance of its lines");
  move.sweep_width = within(table, "sweep_width", physics::kLengthUnits, kLeastSweep, kWidestPlace);
  move.line_spacing = within(table, "line_spacing", physics::kLengthUnits, kLeastSweep, kWidestPlace);
  const double lines = lines_of(from, move);
  if (!(lines > 0.0)) table.refuse("sweep_width", "a sweep goes across its path, and this move stays where it is");
  if (lines > kMostLines) {
    table.refuse("line_spacing", fmt::format("the sweep has {:.0f} lines, {:.0f} at most", lines, kMostLines));
  }
}

// Distance of the axes of a tip above that place and a particle, in which they touch like a tip and a sphere.
Length distance_to(const physics::PlacedParticle& particle, const physics::ParticleSpecies& species,
                   const physics::Sideways<Length>& place) {
  const physics::HalfTurn turn = physics::half_turn(particle.angle_rad);
  const double cosine = turn.w * turn.w - turn.z * turn.z, sine = 2.0 * turn.w * turn.z;
  const physics::Sideways<Length> from = place - particle.position;
  const Length half = 0.5 * species.length;
  const Length along = std::clamp(cosine * from.x + sine * from.y, -half, half);
  const Length away = physics::magnitude(from - physics::Sideways<Length>{cosine * along, sine * along});
  return std::max(Length(0.0), away - physics::core_radius(species));
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

void check_start(const TomlTable& start, const ParticleSet& set) {
  const Length tip_z = std::max(set.start.z, Length());  // height of the tip; the sample holds it if the base is lower
  for (std::size_t i = 0; i < set.particles.size(); ++i) {
    const physics::ParticleSpecies& species = set.setup.species[set.particles[i].species];
    const Length radius = species.contact.tip_radius;
    const Length touching =
        physics::touching_height(set.setup.tip, radius, distance_to(set.particles[i], species, set.start.position));
    if (tip_z >= touching - kTouching * radius) continue;
    start.refuse("z", fmt::format("the tip would be inside particle {}, which it touches at {} there: start higher, or "
                                  "beside it",
                                  i + 1, physics::format_quantity(touching, physics::kLengthUnits, 3)));
  }
}

}  // namespace afm::scene
