// SPDX-License-Identifier: Apache-2.0
#include "laws/equilibrium_branch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace afm::physics {
namespace {

// Laws have their parameter logarithmic over their scales, so that a step of s is a step of scale.
constexpr double kScanStep = 0.05;
constexpr int kHalvings = 80;  // bisections of an interval of s, to beyond the resolution of a double

// First point, kinks, last point.
std::vector<double> corners_of(const LawBranch& branch) {
  std::vector<double> corners{branch.first};
  corners.insert(corners.end(), branch.kinks.begin(), branch.kinks.end());
  corners.push_back(branch.last);
  return corners;
}

// Parameters at which a branch is examined: just before and just after a kink, never at it.
std::vector<double> scan_of(const LawBranch& branch) {
  const std::vector<double> corners = corners_of(branch);
  const double nudge = 1e-13 * (branch.last - branch.first);
  std::vector<double> scan;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const double from = i == 0 ? corners[i] : corners[i] + nudge;
    const double to = i + 2 == corners.size() ? corners[i + 1] : corners[i + 1] - nudge;
    const int steps = std::max(4, static_cast<int>(std::ceil((to - from) / kScanStep)));
    for (int k = 0; k < steps; ++k) scan.push_back(from + (to - from) * k / steps);
    scan.push_back(to);
  }
  return scan;
}

// dF/dh, signed for the intended direction of h; infinite where h is constant under a rising pull or turns back.
double gradient(const LawBranch& branch, double s, double sign) {
  const LawPoint point = branch.at(s);
  if (point.dh_ds * sign > 0.0) return point.dforce_ds / point.dh_ds;
  const bool wall = point.dh_ds == 0.0 && point.dforce_ds * sign <= 0.0;
  return wall ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
}

// Parameter of the steepest gradient between two parameters, by golden sections.
double steepest_between(const LawBranch& branch, double low, double high, double sign) {
  constexpr double kGolden = 0.6180339887498949;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = gradient(branch, left, sign), at_right = gradient(branch, right, sign);
  for (int i = 0; i < kHalvings; ++i) {
    if (at_left >= at_right) {
      high = right;
      right = left;
      at_right = at_left;
      at_left = gradient(branch, left = high - kGolden * (high - low), sign);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      at_right = gradient(branch, right = low + kGolden * (high - low), sign);
    }
  }
  return 0.5 * (low + high);
}

// One interval of Gauss-Legendre quadrature, eight points.
double panel(const LawBranch& branch, double from, double to) {
  constexpr std::array kAbscissa{0.18343464249564981, 0.52553240991632899, 0.79666647741362674, 0.96028985649753623};
  constexpr std::array kWeight{0.36268378337836199, 0.31370664587788729, 0.22238103445337448, 0.10122853629037626};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0.0;
  for (std::size_t i = 0; i < kAbscissa.size(); ++i) {
    for (const double s : {middle - half * kAbscissa[i], middle + half * kAbscissa[i]}) {
      const LawPoint point = branch.at(s);
      sum -= kWeight[i] * point.force.si * point.dh_ds;
    }
  }
  return half * sum;
}

// Integral over a stretch without kinks, in intervals that shrink towards both ends, where a law may behave like a
// fractional power.
double stretch_rise(const LawBranch& branch, double from, double to) {
  constexpr double kWidest = 0.25;
  constexpr double kShrink = 0.25;
  constexpr int kShrinkings = 12;
  double widest = std::min(kWidest, 0.5 * (to - from));
  double sum = 0.0;
  double outer = widest;
  for (int i = 0; i < kShrinkings; ++i) {
    const double inner = i + 1 == kShrinkings ? 0.0 : outer * kShrink;
    sum += panel(branch, from + inner, from + outer) + panel(branch, to - outer, to - inner);
    outer = inner;
  }
  const double left = from + widest, right = to - widest;
  const int panels = static_cast<int>(std::ceil((right - left) / kWidest));
  for (int i = 0; i < panels; ++i) {
    sum += panel(branch, left + (right - left) * i / panels, left + (right - left) * (i + 1) / panels);
  }
  return sum;
}

}  // namespace

EquilibriumBranch::EquilibriumBranch(const LawBranch& branch, double compliance, Direction direction)
    : branch_(branch), compliance_(compliance), sign_(direction == Direction::Outwards ? 1.0 : -1.0) {
  find_end();
}

EquilibriumBranch::Point EquilibriumBranch::at(double s) const {
  const LawPoint point = branch_.at(s);
  return {point.h.si - compliance_ * point.force.si, point.h.si, point.force.si,
          point.dh_ds - compliance_ * point.dforce_ds, point.dforce_ds};
}

double EquilibriumBranch::rate(double s) const { return sign_ * at(s).dz_ds; }

double EquilibriumBranch::fold_between(double stable, double unstable) const {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (stable + unstable);
    (rate(middle) >= 0.0 ? stable : unstable) = middle;
  }
  return 0.5 * (stable + unstable);
}

void EquilibriumBranch::find_end() {
  const std::vector<double> scan = scan_of(branch_);
  const auto is_kink = [this](double from, double to) {
    return std::any_of(branch_.kinks.begin(), branch_.kinks.end(), [&](double s) { return from < s && s < to; });
  };
  folded_ = true;
  double before_last = -std::numeric_limits<double>::infinity(), last = before_last;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (rate(scan[i]) < 0.0) {
      end_ = i == 0 ? scan[0] : fold_between(scan[i - 1], scan[i]);
      return;
    }
    // a stretch that folds and recovers between two points shows up as a maximum of the gradient there
    const double next = gradient(branch_, scan[i], sign_);
    if (i >= 2 && last > before_last && last >= next && !is_kink(scan[i - 2], scan[i])) {
      const double steepest = steepest_between(branch_, scan[i - 2], scan[i], sign_);
      if (rate(steepest) < 0.0) {
        end_ = fold_between(scan[i - 2], steepest);
        return;
      }
    }
    before_last = last;
    last = next;
  }
  end_ = branch_.last;
  folded_ = false;
}

// Newton's method, with bisection outside the bracket; Z increases from low to high along the stretch.
double EquilibriumBranch::solve(double z, double guess, double low, double high, Point& solution) const {
  constexpr double kSmallStep = 1e-7;  // size of a step whose square, the error of the next one, is below rounding
  double s = guess;
  for (int i = 0; i < 2 * kHalvings; ++i) {
    solution = at(s);
    const double miss = sign_ * (solution.z - z);
    (miss > 0.0 ? high : low) = s;
    double step = (z - solution.z) / solution.dz_ds;
    if (std::abs(step) < kSmallStep || !(high - low > 1e-15)) {
      if (!std::isfinite(step) || std::abs(step) >= kSmallStep) step = 0.0;
      solution.force += step * solution.dforce_ds;
      return s + step;
    }
    const double next = s + step;
    s = next > low && next < high ? next : 0.5 * (low + high);
  }
  return s;
}

std::optional<double> EquilibriumBranch::at_z(double z) const {
  double low = branch_.first, high = end_;
  if (sign_ * (z - at(low).z) < 0.0 || sign_ * (at(high).z - z) < 0.0) return std::nullopt;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (sign_ * (at(middle).z - z) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

BranchTable::Piece EquilibriumBranch::piece(double from, double to, double end_z, double reach) const {
  // below this fraction of the end's Z, rounding hides the branch
  constexpr double kNearest = 0x1p-36;
  constexpr double kSmallestScale = 1e-10;  // scale for a branch that ends at Z = 0, m
  const Point start = at(from);
  const double last_distance = std::min(reach, std::abs(at(to).z - start.z));
  BranchTable::Piece piece;
  piece.start = std::abs(start.z - end_z);
  piece.last_u = std::sqrt(last_distance);
  const double nearest = std::min(kNearest * std::max(std::abs(start.z), kSmallestScale), 0.01 * last_distance);
  piece.first_octave = static_cast<int>(std::floor(0.5 * std::log2(nearest)));

  piece.nodes.push_back({start.force, 0.0});
  // at a kink the law's slope may be that of the other side
  const double last = to + 1e-12 * (from - to);
  double s = from, ds_du = 0.0, last_u = 0.0;
  for (std::size_t i = 1; last_u < piece.last_u; ++i) {
    const double u = std::min(BranchTable::node_u(piece.first_octave, i), piece.last_u);
    Point point;
    const double guess = std::max(s + ds_du * (u - last_u), last);
    s = solve(start.z - sign_ * u * u, guess, last, s, point);
    ds_du = -sign_ * 2.0 * u / point.dz_ds;
    piece.nodes.push_back({point.force, ds_du * point.dforce_ds});
    last_u = u;
  }
  // a parabola over the first cell: with a fold the slope at its end is finite but cannot be computed from dF/dZ
  BranchTable::Node &first = piece.nodes[0], &second = piece.nodes[1];
  first.slope = 2.0 * (second.force_n - first.force_n) / BranchTable::node_u(piece.first_octave, 1) - second.slope;
  return piece;
}

BranchTable EquilibriumBranch::table(double reach) const {
  const double end_z = at(end_).z;
  std::vector<BranchTable::Piece> pieces;
  bool forceless = true;
  double from = end_;
  const auto add = [&](double to) {
    const double left = reach - std::abs(at(from).z - end_z);
    if (!(left > 0.0) || at(to).z == at(from).z) return;
    pieces.push_back(piece(from, to, end_z, left));
    for (const BranchTable::Node& node : pieces.back().nodes) forceless = forceless && node.force_n == 0.0;
    from = to;
  };
  for (auto kink = branch_.kinks.rbegin(); kink != branch_.kinks.rend(); ++kink) {
    if (*kink < end_) add(*kink);
  }
  add(branch_.first);
  if (forceless) return {};
  const auto side = sign_ > 0.0 ? BranchTable::Side::Below : BranchTable::Side::Above;
  return BranchTable(Length(end_z), side, std::move(pieces));
}

LawBranch reversed(const LawBranch& branch) {
  LawBranch other{-branch.last, -branch.first, {}, {branch.kinks.rbegin(), branch.kinks.rend()}};
  for (double& kink : other.kinks) kink = -kink;
  other.at = [at = branch.at](double s) {
    LawPoint point = at(-s);
    point.dh_ds = -point.dh_ds;
    point.dforce_ds = -point.dforce_ds;
    return point;
  };
  return other;
}

double steepest_attraction(const LawBranch& branch) {
  const double sign = branch.at(branch.last).h > branch.at(branch.first).h ? 1.0 : -1.0;
  const std::vector<double> scan = scan_of(branch);
  double steepest = 0.0;
  std::size_t place = scan.size();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double here = gradient(branch, scan[i], sign);
    if (here > steepest) {
      steepest = here;
      place = i;
    }
  }
  if (place == scan.size()) return 0.0;
  const double low = scan[place == 0 ? 0 : place - 1], high = scan[std::min(place + 1, scan.size() - 1)];
  return std::max(steepest, gradient(branch, steepest_between(branch, low, high, sign), sign));
}

double potential_rise(const LawBranch& branch, double from, double to) {
  if (to < from) return -potential_rise(branch, to, from);
  double sum = 0.0;
  for (const double kink : branch.kinks) {
    if (kink <= from || kink >= to) continue;
    sum += stretch_rise(branch, from, kink);
    from = kink;
  }
  return sum + stretch_rise(branch, from, to);
}

}  // namespace afm::physics
