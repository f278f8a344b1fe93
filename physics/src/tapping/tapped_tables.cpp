// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "physics/quantity_text.h"
#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/driven_lever.h"
#include "physics/tapping/felt_swing.h"
#include "physics/tapping/tap_surface.h"
#include "physics/tapping/tap_table.h"
#include "physics/tapping/tapping_model.h"
#include "require_range.h"
#include "tapping/tap_walk.h"

namespace afm::physics {
namespace {

constexpr int kHeights = 400;               // number of heights in a walk
constexpr std::size_t kNodes = 1200;        // number of nodes in a branch
constexpr Length kClearOfSample{2e-9};      // distance from the free swing without a push
constexpr double kSteepestFall = 4.0;       // steepest slope of the push, in full pushes per free amplitude
constexpr double kFaintReduction = 0.02;    // faintest reduction of the amplitude, as a share of the free amplitude
constexpr double kStopped = 0.1;            // smallest amplitude as a share of the free one; with less, a tip may stick
constexpr int kMostTurns = 8;               // number of turning points that are tried
constexpr double kMostReachOfSwing = 10.0;  // farthest height in free amplitudes, for an attraction with a long range

Length height_of(int index, Length from, Length to) {
  return from + (to - from) * (static_cast<double>(index) / kHeights);
}

// Curve by the averaged flow, from rest to rest.
TappingCurve curve_of(AveragedFlow& flow, Length from, Length to) {
  TapDirection down{Branch::Approach, {}}, up{Branch::Retract, {}};
  for (int i = 0; i <= kHeights; ++i) down.heights.push_back(height_of(i, from, to));
  up.heights.assign(down.heights.rbegin(), down.heights.rend());
  TappingCurve curve;
  const DrivenLever& lever = flow.lever();
  TapState state = flow.settle({lever.free_amplitude, lever.free_phase}, from).state;
  walk_slowly(flow, down, state, curve);
  walk_slowly(flow, up, state, curve);
  return curve;
}

// Curve from above the attraction, also of a long range, down to contact, or to where the sample stops the swing: a
// smaller one may jump to states that the envelope of a hand does not reach.
TappingCurve averaged_curve(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever) {
  AveragedFlow flow(surface, lever, AveragedFlow::Search::AsFelt);
  const Length a0 = lever.free_amplitude, floor = surface->contact_height();
  Length from = floor + a0 + std::max(kClearOfSample, 0.5 * a0);
  while (from < kMostReachOfSwing * a0) {
    const Length amplitude = flow.settle({a0, lever.free_phase}, from).state.amplitude;
    if (std::abs(amplitude / a0 - 1.0) < 0.5 * kFaintReduction) break;
    from = from + 0.5 * a0;
  }
  // below, a swing hovers between states, which takes long to compute
  TapDirection down{Branch::Approach, {}};
  for (int i = 0; i <= kHeights; ++i) down.heights.push_back(height_of(i, from, floor));
  TapState state = flow.settle({a0, lever.free_phase}, from).state;
  TappingCurve curve;
  walk_slowly(flow, down, state, curve, kStopped * a0);
  const bool ends_above = curve.lost_at || state.amplitude < kStopped * a0;
  Length bottom = ends_above ? curve.points.back().z : floor;
  for (int i = 0; i < kMostTurns && from - bottom > kStopped * a0; ++i) {
    curve = curve_of(flow, from, bottom);
    if (!curve.lost_at) return curve;
    bottom = std::max(bottom, *curve.lost_at) + kStopped * a0;
  }
  throw UnphysicalValue("drive", "over this sample the averages follow no branch of this swing");
}

// P over falling Z, between the points of a walk.
double push_at(const std::vector<TapPoint>& points, const DrivenLever& lever, double z) {
  const auto below = std::find_if(points.begin(), points.end(), [&](const TapPoint& point) { return point.z.si <= z; });
  if (below == points.begin()) return tap_push(lever, points.front().state.amplitude).si;
  if (below == points.end()) return tap_push(lever, points.back().state.amplitude).si;
  const TapPoint &a = *std::prev(below), &b = *below;
  const double share = a.z.si > b.z.si ? (z - b.z.si) / (a.z.si - b.z.si) : 0.0;
  return tap_push(lever, b.state.amplitude + share * (a.state.amplitude - b.state.amplitude)).si;
}

// P of one branch from its end outwards, at equal distances.
struct PushNodes {
  Length end;
  BranchTable::Side side;
  double spacing;
  std::vector<double> push_n;

  double sign() const { return side == BranchTable::Side::Above ? 1.0 : -1.0; }
  double z(std::size_t node) const { return end.si + sign() * spacing * static_cast<double>(node); }
};

PushNodes push_nodes(const std::function<double(double z)>& push_n, Length end, BranchTable::Side side, Length length) {
  PushNodes nodes{end, side, length.si / static_cast<double>(kNodes - 1), std::vector<double>(kNodes)};
  for (std::size_t i = 0; i < kNodes; ++i) nodes.push_n[i] = push_n(nodes.z(i));
  return nodes;
}

BranchTable table_of(const PushNodes& push) {
  std::vector<BranchTable::Node> nodes(push.push_n.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].force_n = push.push_n[i];
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
    // no overshoot beside a fold
    const double before = nodes[i].force_n - nodes[i - 1].force_n, after = nodes[i + 1].force_n - nodes[i].force_n;
    if (before * after > 0.0) nodes[i].slope = 2.0 * before * after / (before + after) / push.spacing;
  }
  nodes.front().slope = (nodes[1].force_n - nodes[0].force_n) / push.spacing;
  return {push.end, push.side, Length(push.spacing), std::move(nodes)};
}

// Lowers P where it rises too steeply on the way down.
void limit_rise(PushNodes& nodes, double most_n_per_m) {
  const double most_n = most_n_per_m * nodes.spacing;
  std::vector<double>& push_n = nodes.push_n;
  if (nodes.side == BranchTable::Side::Above) {
    for (std::size_t i = push_n.size() - 1; i-- > 0;) push_n[i] = std::min(push_n[i], push_n[i + 1] + most_n);
  } else {
    for (std::size_t i = 1; i < push_n.size(); ++i) push_n[i] = std::min(push_n[i], push_n[i - 1] + most_n);
  }
}

// Energy of a loop down the free branch and up the attached one, between their ends.
double given_by_loop(const BranchTable& free, const BranchTable& attached) {
  constexpr int kSteps = 1000;
  const double from = free.end().si, step = (attached.end().si - from) / kSteps;
  double sum_n = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const Length z(from + (i + 0.5) * step);
    sum_n += (attached.force(z) - free.force(z)).si;
  }
  return sum_n * step;
}

// Puts both branches of P by direct integration, safe for a hand that feels them once a tick. A swing that changes in a
// step, as where the tip sticks, has its push spread over some Z. A repelled branch that pushes more than the
// attracted one would give a hand energy with each loop; its push is then no larger than that of the attracted one.
void put_felt_branches(const TapTable& rests, Length floor, Length highest, LawTables& tables) {
  const DrivenLever& lever = rests.lever();
  const double most_n_per_m = kSteepestFall * tap_push(lever, Length()).si / lever.free_amplitude.si;
  const auto push_of = [&](bool repelled) {
    return [&rests, &lever, floor, repelled](double z) {
      const TapTable::Rest rest = rests.at(repelled, std::max(z, floor.si));
      return tap_push(lever, Length(std::hypot(rest.u_m, rest.v_m))).si;
    };
  };
  const Length in = tables.figures.z_jtc, off = tables.figures.z_joc;
  PushNodes free = push_nodes(push_of(false), in, BranchTable::Side::Above, highest - in);
  limit_rise(free, most_n_per_m);
  tables.free = table_of(free);
  const Length pressed = std::max(off - floor, Length(1e-3 * lever.free_amplitude.si));
  PushNodes attached = push_nodes(push_of(true), off, BranchTable::Side::Below, pressed);
  limit_rise(attached, most_n_per_m);
  tables.attached = table_of(attached);
  if (given_by_loop(tables.free, tables.attached) <= 0.0) return;
  for (std::size_t i = 0; i < attached.push_n.size() && attached.z(i) > in.si; ++i) {
    attached.push_n[i] = std::min(attached.push_n[i], tables.free.force(Length(attached.z(i))).si);
  }
  limit_rise(attached, most_n_per_m);
  tables.attached = table_of(attached);
}

}  // namespace

Force tap_push(const DrivenLever& lever, Length amplitude) noexcept {
  return lever.spring_constant * lever.base_amplitude * (1.0 - amplitude / lever.free_amplitude);
}

std::shared_ptr<const LawTables> tapped_law_tables(Law law, const std::shared_ptr<const TapSurface>& surface,
                                                   const DrivenLever& lever) {
  require_range("relaxation", lever.relaxation().si, 0.0, kLongestFeltRelaxation.si, kTimeUnits);
  LawTables tables;
  if (lever.quality_factor < AveragedFlow::kLeastQuality)
    tables.taps = std::make_shared<const TapTable>(surface, lever);
  const TappingCurve curve = tables.taps ? tables.taps->walk() : averaged_curve(surface, lever);
  SlowWalk walk = slow_walk_of(curve, lever);
  if (tables.taps) {
    const auto& loop = tables.taps->loop();
    walk.in = loop ? std::optional(loop->in) : std::nullopt;
    walk.off = loop ? std::optional(loop->off) : std::nullopt;
  }
  const Length a0 = lever.free_amplitude, floor = surface->contact_height(), from = walk.down.front().z;
  tables.law = law;
  tables.contact = surface->contact();
  tables.contact_gap = surface->zero_of_indentation();
  tables.tapped_full = tap_push(lever, Length());
  tables.pressed_to = tables.taps ? floor : std::max(floor, walk.down.back().z);
  CycleFigures& figures = tables.figures;
  figures.hysteretic = walk.hysteretic();
  if (figures.hysteretic) {
    figures.z_jtc = walk.in->z;
    figures.z_joc = walk.off->z;
    figures.force_before_jtc = tap_push(lever, walk.in->before.amplitude);
    figures.force_after_jtc = tap_push(lever, walk.in->after.amplitude);
    figures.force_before_joc = tap_push(lever, walk.off->before.amplitude);
    figures.force_after_joc = tap_push(lever, walk.off->after.amplitude);
  } else {
    figures.z_jtc = figures.z_joc = tables.taps ? tables.taps->falls_at() : meeting_of(walk, lever);
    figures.force_before_jtc = figures.force_after_jtc = Force(push_at(walk.down, lever, figures.z_jtc.si));
    figures.force_before_joc = figures.force_after_joc = figures.force_before_jtc;
  }
  figures.tip_height_before_jtc = figures.tip_height_after_jtc = figures.z_jtc;
  figures.tip_height_before_joc = figures.tip_height_after_joc = figures.z_joc;
  figures.critical_stiffness = Stiffness(HUGE_VAL);
  if (tables.taps) {
    put_felt_branches(*tables.taps, floor, from, tables);
  } else {
    const auto push_over = [&lever](const std::vector<TapPoint>& points) {
      return [&lever, &points](double z) { return push_at(points, lever, z); };
    };
    tables.free =
        table_of(push_nodes(push_over(walk.down), figures.z_jtc, BranchTable::Side::Above, from - figures.z_jtc));
    const Length pressed = std::max(figures.z_joc - floor, Length(1e-3 * a0.si));
    tables.attached = table_of(push_nodes(push_over(figures.hysteretic ? walk.up : walk.down), figures.z_joc,
                                          BranchTable::Side::Below, pressed));
  }
  double loop = 0.0;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const TapPoint &a = curve.points[i - 1], &b = curve.points[i];
    loop -= 0.5 * (tap_push(lever, a.state.amplitude) + tap_push(lever, b.state.amplitude)).si * (b.z - a.z).si;
  }
  figures.loop_energy = figures.lost_at_jtc = Energy(std::max(0.0, loop));

  const auto felt = std::find_if(walk.down.begin(), walk.down.end(), [&](const TapPoint& point) {
    return std::abs(point.state.amplitude / a0 - 1.0) > kFaintReduction;
  });
  const Length faint_above = felt == walk.down.end() ? figures.z_joc : felt->z;
  tables.tapped_from = std::max({a0 + kClearOfSample, faint_above, figures.z_joc});
  return std::make_shared<const LawTables>(std::move(tables));
}

Length largest_felt_swing(const DrivenLever& lever) noexcept {
  const bool averages = lever.quality_factor >= AveragedFlow::kLeastQuality;
  return (averages ? kLargestAveragedShare : kLostSwingShare) * lever.free_amplitude;
}

Length largest_swing_of_hand(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever,
                             const LawTables& tables) {
  Length largest = lever.free_amplitude;
  if (lever.ratio <= 1.0) return largest;
  const TappingCurve curve = tables.taps ? tables.taps->walk() : averaged_curve(surface, lever);
  for (const TapPoint& point : curve.points) largest = std::max(largest, point.state.amplitude);
  return largest;
}

}  // namespace afm::physics
