// SPDX-License-Identifier: Apache-2.0
#include "physics/branch_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace afm::physics {
namespace {

// The top bits of a positive double count the nodes of its octave: the exponent and the first bits of the mantissa.
constexpr int kDroppedBits = 52 - std::countr_zero(BranchTable::kNodesPerOctave);

std::uint64_t octave_bits(double u) { return std::bit_cast<std::uint64_t>(u) >> kDroppedBits; }
double from_octave_bits(std::uint64_t bits) { return std::bit_cast<double>(bits << kDroppedBits); }
std::uint64_t first_bits(int octave) { return static_cast<std::uint64_t>(octave + 1023) << (52 - kDroppedBits); }

// The inverse of a power of two: the negative exponent.
double inverse_of_power(double power_of_two) {
  constexpr std::uint64_t kTwiceBias = std::uint64_t{2046} << 52;
  return std::bit_cast<double>(kTwiceBias - std::bit_cast<std::uint64_t>(power_of_two));
}

double cubic(const BranchTable::Node& from, const BranchTable::Node& to, double width, double t) {
  const double rise = to.force_n - from.force_n;
  const double bend_from = from.slope * width - rise;
  const double bend_to = rise - to.slope * width;
  return from.force_n + t * (rise + (1.0 - t) * (bend_from * (1.0 - t) + bend_to * t));
}

double in_graded(const BranchTable::Piece& piece, double distance) {
  const double u = std::sqrt(distance);
  const std::uint64_t bits = octave_bits(u), first = first_bits(piece.first_octave);
  const std::size_t cell = bits < first ? 0 : std::min<std::size_t>(bits - first + 1, piece.nodes.size() - 2);
  const double left = cell == 0 ? 0.0 : from_octave_bits(first + cell - 1);
  const double right = from_octave_bits(first + cell);
  const BranchTable::Node &from = piece.nodes[cell], &to = piece.nodes[cell + 1];
  if (right > piece.last_u) return cubic(from, to, piece.last_u - left, (u - left) / (piece.last_u - left));
  // the width is a power of two, so that its inverse is exact, and much faster than a division
  const double width = right - left;
  return cubic(from, to, width, (u - left) * inverse_of_power(width));
}

double in_even(const BranchTable::Piece& piece, double spacing, double distance) {
  const double cells = distance / spacing;
  const std::size_t cell = std::min(static_cast<std::size_t>(cells), piece.nodes.size() - 2);
  return cubic(piece.nodes[cell], piece.nodes[cell + 1], spacing, cells - static_cast<double>(cell));
}

}  // namespace

BranchTable BranchTable::straight(Force force_at_zero, Stiffness slope) {
  BranchTable table;
  table.line_force_at_zero_ = force_at_zero.si;
  table.line_slope_ = slope.si;
  return table;
}

double BranchTable::node_u(int first_octave, std::size_t index) noexcept {
  return index == 0 ? 0.0 : from_octave_bits(first_bits(first_octave) + index - 1);
}

BranchTable::BranchTable(Length end, Side side, std::vector<Piece> pieces)
    : end_z_(end.si), side_(side == Side::Above ? 1.0 : -1.0), pieces_(std::move(pieces)) {
  const Piece& last = pieces_.back();
  continue_from(last.start + last.last_u * last.last_u, last.nodes.back(),
                last.nodes.back().slope / (2.0 * last.last_u));
}

BranchTable::BranchTable(Length end, Side side, Length spacing, std::vector<Node> nodes)
    : end_z_(end.si), side_(side == Side::Above ? 1.0 : -1.0), spacing_(spacing.si) {
  continue_from(spacing_ * static_cast<double>(nodes.size() - 1), nodes.back(), nodes.back().slope);
  pieces_.push_back({0.0, 0, 0.0, std::move(nodes)});
}

void BranchTable::continue_from(double distance, const Node& last, double slope_outwards) {
  reach_ = distance;
  last_force_ = last.force_n;
  if (side_ < 0.0) {
    line_slope_ = -slope_outwards;
    line_force_at_zero_ = last_force_ - line_slope_ * (end_z_ - reach_);
  } else if (last_force_ != 0.0) {
    // a force that does not decrease at the end of the table is made to, as slowly as 1/distance
    tail_exponent_ = std::max(1.0, -reach_ * slope_outwards / last_force_);
  }
}

Force BranchTable::force_beyond(double z, double distance) const noexcept {
  if (tail_exponent_ > 0.0) return Force(last_force_ * std::pow(distance / reach_, -tail_exponent_));
  return Force(line_force_at_zero_ + line_slope_ * z);
}

Force BranchTable::force(Length z) const noexcept {
  const double distance = std::max(0.0, side_ > 0.0 ? z.si - end_z_ : end_z_ - z.si);
  if (distance >= reach_) return force_beyond(z.si, distance);
  const Piece* piece = pieces_.data();
  if (spacing_ > 0.0) return Force(in_even(*piece, spacing_, distance));
  // a swing waits for each force: most laws have one piece, which starts at zero
  if (pieces_.size() == 1) return Force(in_graded(*piece, distance));
  piece += pieces_.size() - 1;
  while (piece->start > distance) --piece;
  return Force(in_graded(*piece, distance - piece->start));
}

}  // namespace afm::physics
