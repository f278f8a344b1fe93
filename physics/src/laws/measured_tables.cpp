// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "physics/law_tables.h"
#include "physics/quantity_text.h"

namespace afm::physics {
namespace {

constexpr std::size_t kFewestPoints = 8;
constexpr std::size_t kMostPoints = 65536;

void check(std::span<const MeasuredPoint> branch, const std::string& name) {
  if (branch.size() < kFewestPoints || branch.size() > kMostPoints) {
    throw std::invalid_argument("the " + name + " of the curve has " + std::to_string(branch.size()) +
                                " points; it needs " + std::to_string(kFewestPoints) + " to " +
                                std::to_string(kMostPoints));
  }
  for (std::size_t i = 0; i < branch.size(); ++i) {
    if (!isfinite(branch[i].z) || !isfinite(branch[i].force)) {
      throw std::invalid_argument("point " + std::to_string(i + 1) + " of the curve's " + name + " is not finite");
    }
    if (i > 0 && branch[i].z <= branch[i - 1].z) {
      throw std::invalid_argument("point " + std::to_string(i + 1) + " of the curve's " + name + " at " +
                                  format_quantity(branch[i].z, kLengthUnits) + " does not lie above the one before");
    }
  }
}

// The index of the last point below the jump.
std::size_t jump_in(std::span<const MeasuredPoint> branch) {
  std::size_t jump = 0;
  double steepest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < branch.size(); ++i) {
    const double slope = ((branch[i + 1].force - branch[i].force) / (branch[i + 1].z - branch[i].z)).si;
    if (slope > steepest) {
      steepest = slope;
      jump = i;
    }
  }
  return jump;
}

double line_between(std::span<const MeasuredPoint> branch, double z) {
  const auto right = std::clamp(std::upper_bound(branch.begin(), branch.end(), z,
                                                 [](double value, const MeasuredPoint& p) { return value < p.z.si; }),
                                branch.begin() + 1, branch.end() - 1);
  const MeasuredPoint &from = *(right - 1), &to = *right;
  const double t = std::clamp((z - from.z.si) / (to.z - from.z).si, 0.0, 1.0);
  return from.force.si + t * (to.force - from.force).si;
}

// Equally spaced nodes, `cells_a_point` times as many as points; in between monotone cubics, whose slope at a node is
// the harmonic mean of its two neighbours' (Fritsch & Butland 1984).
BranchTable table(std::span<const MeasuredPoint> branch, BranchTable::Side side, std::size_t cells_a_point) {
  const bool above = side == BranchTable::Side::Above;
  const Length end = above ? branch.front().z : branch.back().z;
  const double sign = above ? 1.0 : -1.0;
  const std::size_t cells = cells_a_point * branch.size();
  const Length spacing = (branch.back().z - branch.front().z) / static_cast<double>(cells);

  std::vector<BranchTable::Node> nodes(cells + 1);
  for (std::size_t i = 0; i <= cells; ++i) {
    nodes[i].force_n = line_between(branch, end.si + sign * spacing.si * static_cast<double>(i));
  }
  const auto secant = [&](std::size_t i) { return (nodes[i + 1].force_n - nodes[i].force_n) / spacing.si; };
  for (std::size_t i = 1; i < cells; ++i) {
    const double before = secant(i - 1), after = secant(i);
    if (before * after > 0.0) nodes[i].slope = 2.0 * before * after / (before + after);
  }
  nodes.front().slope = secant(0);
  nodes.back().slope = secant(cells - 1);
  return BranchTable(end, side, spacing, std::move(nodes));
}

// The area between two branches, by trapezoids of a quarter of a node's distance.
template <class Upper>
Energy area(const Upper& upper, const BranchTable& lower, Length from, Length to, std::size_t points) {
  const std::size_t steps = 8 * points;
  const Length width = (to - from) / static_cast<double>(steps);
  Energy sum;
  for (std::size_t i = 0; i <= steps; ++i) {
    const Length z = from + width * static_cast<double>(i);
    const double weight = i == 0 || i == steps ? 0.5 : 1.0;
    sum = sum + weight * (upper(z) - lower.force(z)) * width;
  }
  return sum;
}

// Points of each branch on either side of its jump.
struct Cut {
  std::span<const MeasuredPoint> pressed;  // points below the jump of the approach; empty: unknown
  std::span<const MeasuredPoint> free;
  std::span<const MeasuredPoint> attached;
};

Cut cut(std::span<const MeasuredPoint> approach, std::span<const MeasuredPoint> retract, MeasuredJumps jumps) {
  if (jumps.approach == 0 && jumps.retract == 0) {
    return {{},
            approach.subspan(std::min(jump_in(approach) + 1, approach.size() - 2)),
            retract.first(std::max<std::size_t>(jump_in(retract) + 1, 2))};
  }
  if (jumps.approach < 2 || jumps.approach + 2 > approach.size() || jumps.retract < 2 ||
      jumps.retract > retract.size()) {
    throw std::invalid_argument("a jump of the curve lies outside of its branch");
  }
  return {approach.first(jumps.approach), approach.subspan(jumps.approach), retract.first(jumps.retract)};
}

// Long enough for the change from one branch to the other to add no more stiffness than the contact has on average.
Length turn_of(const LawTables& tables, std::span<const MeasuredPoint> pressed) {
  const Length depth = pressed.back().z - pressed.front().z;
  const Force rise = pressed.front().force - pressed.back().force;
  Force widest;
  for (const MeasuredPoint& point : pressed) widest = std::max(widest, point.force - tables.attached.force(point.z));
  const Length even = 0.01 * depth;
  return rise.si > 0.0 ? std::clamp(widest / (rise / depth), even, depth) : depth;
}

}  // namespace

Force LawTables::contact_force(Length z, Length lowest) const noexcept {
  const Force risen = attached.force(z);
  if (turn.si <= 0.0) return risen;
  const double share = std::clamp((z - lowest) / turn, 0.0, 1.0);
  // above the place of contact no higher than the approach, so that a tip drawn up at once gains no work
  const Force down = z > figures.z_jtc ? std::min(pressed.force(z), free.force(z)) : pressed.force(z);
  return risen + (1.0 - share) * std::max(Force(), down - risen);
}

std::shared_ptr<const LawTables> measured_law_tables(std::span<const MeasuredPoint> approach,
                                                     std::span<const MeasuredPoint> retract,
                                                     const ContactParameters& contact, MeasuredJumps jumps) {
  validate(contact);
  check(approach, "approach");
  check(retract, "retract");
  const auto [pressed, free, attached] = cut(approach, retract, jumps);
  const MeasuredPoint in = pressed.empty() ? free.front() : MeasuredPoint{pressed.back().z, free.front().force},
                      off = attached.back();
  const bool pulls = off.force < Force() || !pressed.empty();
  if (off.z <= in.z || !pulls || attached.front().z >= in.z) {
    throw std::invalid_argument("the curve has no loop that could be felt: it jumps to contact at " +
                                format_quantity(in.z, kLengthUnits) + " and off contact at " +
                                format_quantity(off.z, kLengthUnits) + " under " +
                                format_quantity(off.force, kForceUnits));
  }

  LawTables tables;
  tables.law = Law::Measured;
  tables.contact = contact;
  // 2 replays sessions of 0.1.0 bit for bit; 8 puts a node at or near an event's own point
  const std::size_t cells = pressed.empty() ? 2 : 8;
  tables.free = table(free, BranchTable::Side::Above, cells);
  tables.attached = table(attached, BranchTable::Side::Below, cells);
  if (!pressed.empty()) {
    tables.pressed = table(pressed, BranchTable::Side::Below, cells);
    tables.turn = turn_of(tables, pressed);
    tables.pressed_to = pressed.front().z;
  }
  CycleFigures& figures = tables.figures;
  figures.hysteretic = true;
  figures.z_jtc = in.z;
  figures.force_before_jtc = in.force;
  figures.force_after_jtc = tables.contact_force(in.z, in.z);
  figures.z_joc = off.z;
  figures.force_before_joc = off.force;
  figures.force_after_joc = tables.free.force(off.z);
  figures.tip_height_before_jtc = in.z + figures.force_before_jtc / contact.spring_constant;
  figures.tip_height_after_jtc = in.z + figures.force_after_jtc / contact.spring_constant;
  figures.tip_height_before_joc = off.z + figures.force_before_joc / contact.spring_constant;
  figures.tip_height_after_joc = off.z + figures.force_after_joc / contact.spring_constant;
  const std::size_t count = std::max(approach.size(), retract.size());
  const auto in_contact = [&](Length z) { return tables.contact_force(z, z); };
  const auto before_contact = [&](Length z) { return tables.free.force(z); };
  figures.loop_energy = area(before_contact, tables.attached, in.z, off.z, count);
  if (!pressed.empty()) {
    const Length bottom = std::max(pressed.front().z, attached.front().z);
    figures.loop_energy = figures.loop_energy + area(in_contact, tables.attached, bottom, in.z, count);
  }
  figures.lost_at_joc = figures.loop_energy;
  figures.critical_stiffness = Stiffness(std::numeric_limits<double>::infinity());
  return std::make_shared<const LawTables>(std::move(tables));
}

}  // namespace afm::physics
