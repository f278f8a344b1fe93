// SPDX-License-Identifier: Apache-2.0
#include "physics/branch_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace afm::physics {
namespace {

// The top bits of a positive double count sixty-fourths of octaves: exponent and the first six bits of the mantissa.
constexpr int kDroppedBits = 46;
static_assert(BranchTable::kNodesPerOctave == std::size_t{1} << (52 - kDroppedBits));

std::uint64_t octave_bits(double u) { return std::bit_cast<std::uint64_t>(u) >> kDroppedBits; }
double from_octave_bits(std::uint64_t bits) { return std::bit_cast<double>(bits << kDroppedBits); }

}  // namespace

BranchTable BranchTable::straight(Force force_at_zero, Stiffness slope) {
  BranchTable table;
  table.line_force_at_zero_ = force_at_zero.si;
  table.line_slope_ = slope.si;
  return table;
}

double BranchTable::node_u(int first_octave, std::size_t index) noexcept {
  return index == 0 ? 0.0 : from_octave_bits(octave_bits(std::ldexp(1.0, first_octave)) + index - 1);
}

BranchTable::BranchTable(Length end, Side side, int first_octave, std::vector<Node> nodes)
    : end_z_(end.si),
      side_(side == Side::Above ? 1.0 : -1.0),
      first_octave_bits_(octave_bits(std::ldexp(1.0, first_octave))),
      nodes_(std::move(nodes)) {
  const Node& last = nodes_.back();
  const double last_u = node_u(first_octave, nodes_.size() - 1);
  reach_ = last_u * last_u;
  const double slope_outwards = last.slope / (2.0 * last_u);  // dF/d|Z - Z_end|
  if (side == Side::Above) {
    if (last.force_n == 0.0) return;
    // a force that does not fall where the table ends is made to, as slowly as 1/distance
    tail_exponent_ = std::max(1.0, -reach_ * slope_outwards / last.force_n);
  } else {
    line_slope_ = -slope_outwards;
    line_force_at_zero_ = last.force_n - line_slope_ * (end_z_ - reach_);
  }
}

Force BranchTable::force_beyond(double z, double distance) const noexcept {
  if (tail_exponent_ > 0.0) return Force(nodes_.back().force_n * std::pow(distance / reach_, -tail_exponent_));
  return Force(line_force_at_zero_ + line_slope_ * z);
}

Force BranchTable::force(Length z) const noexcept {
  const double distance = (z.si - end_z_) * side_;
  if (nodes_.empty() || distance >= reach_) return force_beyond(z.si, distance);

  const double u = std::sqrt(std::max(0.0, distance));
  const std::uint64_t bits = octave_bits(u);
  const std::size_t cell = bits < first_octave_bits_
                               ? 0
                               : std::min(static_cast<std::size_t>(bits - first_octave_bits_) + 1, nodes_.size() - 2);
  const double left = cell == 0 ? 0.0 : from_octave_bits(first_octave_bits_ + cell - 1);
  const double width = from_octave_bits(first_octave_bits_ + cell) - left;

  const Node& from = nodes_[cell];
  const Node& to = nodes_[cell + 1];
  const double t = (u - left) / width;
  const double rise = to.force_n - from.force_n;
  const double bend_from = from.slope * width - rise;
  const double bend_to = rise - to.slope * width;
  return Force(from.force_n + t * (rise + (1.0 - t) * (bend_from * (1.0 - t) + bend_to * t)));
}

}  // namespace afm::physics
