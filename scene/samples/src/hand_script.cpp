// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/hand_script.h"

#include <algorithm>
#include <cmath>

namespace afm::scene {

using physics::Length;
using physics::LeverBase;
using physics::Sideways;

namespace {

Length way_of(const LeverBase& from, const HandMove& move) {
  const Sideways<Length> way = move.to.position - from.position;
  const double lines = lines_of(from, move);
  if (lines > 0.0) return magnitude(way) + (lines + 1.0) * move.sweep_width;
  return Length(std::hypot(way.x.si, way.y.si, (move.to.z - from.z).si));
}

}  // namespace

double lines_of(const LeverBase& from, const HandMove& move) {
  if (!(move.sweep_width.si > 0.0)) return 0.0;
  return std::ceil(magnitude(move.to.position - from.position) / move.line_spacing);
}

std::size_t ticks_of(const LeverBase& from, const HandMove& move, physics::Frequency rate) {
  const double way_m = way_of(from, move).si;
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(way_m / move.speed.si * rate.si)));
}

std::size_t waiting_ticks(const HandMove& move, physics::Frequency rate) {
  return static_cast<std::size_t>(std::ceil(move.wait.si * rate.si));
}

double all_ticks(const ParticleSet& set, physics::Frequency rate) {
  double ticks = 0.0;
  LeverBase from = set.start;
  for (const HandMove& move : set.moves) {
    ticks += static_cast<double>(ticks_of(from, move, rate) + waiting_ticks(move, rate));
    from = move.to;
  }
  return ticks;
}

LeverBase on_the_way(const LeverBase& from, const HandMove& move, double share) {
  if (share >= 1.0) return move.to;
  const Sideways<Length> way = move.to.position - from.position;
  const Length z = from.z + (move.to.z - from.z) * share;
  const double lines = lines_of(from, move);
  if (!(lines > 0.0)) return {from.position + way * share, z};
  const double length_m = magnitude(way).si, width_m = move.sweep_width.si, spacing_m = length_m / lines;
  const double gone_m = share * way_of(from, move).si - 0.5 * width_m;  // distance since the start of the first line
  double ahead_m = 0.0, aside_m = 0.5 * width_m + gone_m;               // aside: distance to the left
  if (gone_m > 0.0) {
    const double line = std::min(lines, std::floor(gone_m / (spacing_m + width_m)));
    const double on_line_m = gone_m - line * (spacing_m + width_m);
    const bool at_end = line >= lines;
    ahead_m = line * spacing_m + (at_end ? 0.0 : std::min(on_line_m, spacing_m));
    const double across_m = at_end ? on_line_m : std::max(0.0, on_line_m - spacing_m);
    aside_m = (std::fmod(line, 2.0) == 0.0 ? 1.0 : -1.0) * (0.5 * width_m - across_m);
  }
  const Sideways<double> along{way.x.si / length_m, way.y.si / length_m};
  return {from.position + Sideways<Length>{Length(ahead_m * along.x - aside_m * along.y),
                                           Length(ahead_m * along.y + aside_m * along.x)},
          z};
}

}  // namespace afm::scene
