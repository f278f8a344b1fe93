// SPDX-License-Identifier: Apache-2.0
#include "physics/friction/lattice_tip.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace afm::physics {

namespace {

// Lengths are in periods. A step along the path is accepted if its prediction was good and the well is not about to
// end; otherwise it is halved, or the end of the well is determined.
constexpr double kPathStep = 0.125;
constexpr double kGoodPrediction = 0.04;
constexpr double kLeastShareOfCurvature = 0.35;
constexpr double kShortestStep = 1e-7;  // smallest step, as a fraction of the path
constexpr double kSlip = 0.02;          // smallest distance of a slip; shorter motions are none
constexpr double kParabola = 2.0;       // largest deviation of the end of a well from its parabola
constexpr int kMostSteps = 200;
constexpr int kMostIterations = 12;
constexpr double kSettled = 1e-9;  // size of Newton's last step; its error is the square of it
constexpr double kWellReach = 0.2;
constexpr double kKick = 0.01;
constexpr double kShortestRoll = 0.02, kLongestRoll = 0.06;
constexpr int kMostRolls = 400;

// The smaller eigenvalue of a symmetric matrix.
double least_curvature(double xx, double xy, double yy) {
  const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
  return mean - std::hypot(half, xy);
}

}  // namespace

double LatticeTip::Rest::least() const noexcept { return least_curvature(xx, xy, yy); }

LatticeTip::LatticeTip(LatticeKind kind, Length period, Stiffness spring) noexcept
    : landscape_(kind, period), k_(spring.si) {}

LatticeTip::Control LatticeTip::on_path(const Control& from, const Control& change, double t) const noexcept {
  return {from.x + t * change.x, from.y + t * change.y, from.scale + t * change.scale};
}

double LatticeTip::potential(double x, double y, const Control& at) const noexcept {
  const double dx = x - at.x, dy = y - at.y;
  return at.scale * landscape_.at(x, y).height + 0.5 * k_ * (dx * dx + dy * dy);
}

LatticeTip::Rest LatticeTip::rest_at(double x, double y, const Control& at) const noexcept {
  const LatticeLandscape::Place place = landscape_.at(x, y);
  return {x, y, at.scale * place.bend_xx + k_, at.scale * place.bend_xy, at.scale * place.bend_yy + k_};
}

// Newton's method for the tip's rest position, in a well no further away than `reach`.
bool LatticeTip::settle(Rest& rest, const Control& at, double reach) const noexcept {
  const double x0 = rest.x, y0 = rest.y, a = landscape_.period_m();
  for (int i = 0; i < kMostIterations; ++i) {
    const LatticeLandscape::Place place = landscape_.at(rest.x, rest.y);
    rest.xx = at.scale * place.bend_xx + k_;
    rest.xy = at.scale * place.bend_xy;
    rest.yy = at.scale * place.bend_yy + k_;
    const double fx = at.scale * place.slope_x + k_ * (rest.x - at.x);
    const double fy = at.scale * place.slope_y + k_ * (rest.y - at.y);
    const double determinant = rest.xx * rest.yy - rest.xy * rest.xy;
    if (!(determinant > 0.0 && rest.xx + rest.yy > 0.0)) return false;
    const double dx = (rest.yy * fx - rest.xy * fy) / determinant, dy = (rest.xx * fy - rest.xy * fx) / determinant;
    rest.x -= dx;
    rest.y -= dy;
    if (!(std::hypot(rest.x - x0, rest.y - y0) <= reach * a)) return false;
    if (std::hypot(dx, dy) <= kSettled * a) return true;
  }
  return false;
}

// Follows the steepest descent, in short steps each of which loses energy, until a well is close enough for settle().
void LatticeTip::roll_down(double x, double y, const Control& at) noexcept {
  const double a = landscape_.period_m(), steepest = at.scale * landscape_.sharpest_bend() + k_;
  double height = potential(x, y, at);
  for (int i = 0; i < kMostRolls; ++i) {
    Rest rest{.x = x, .y = y};
    if (settle(rest, at, kWellReach) && potential(rest.x, rest.y, at) <= height) {
      x = rest.x;
      y = rest.y;
      break;
    }
    const LatticeLandscape::Place place = landscape_.at(x, y);
    const double fx = at.scale * place.slope_x + k_ * (x - at.x), fy = at.scale * place.slope_y + k_ * (y - at.y);
    const double steep = std::hypot(fx, fy);
    if (!(steep > 0.0)) break;
    double way = std::clamp(steep / steepest, kShortestRoll * a, kLongestRoll * a);
    for (;; way *= 0.5) {
      const double lower_x = x - way * fx / steep, lower_y = y - way * fy / steep;
      const double lower = potential(lower_x, lower_y, at);
      if (lower < height) {
        x = lower_x;
        y = lower_y;
        height = lower;
        break;
      }
      if (way < kSettled * a) {
        i = kMostRolls;
        break;
      }
    }
  }
  x_ = x;
  y_ = y;
}

// The direction of the least curvature; arbitrary if it is equal in all directions.
std::array<double, 2> LatticeTip::softest(const Rest& rest) noexcept {
  const double least = rest.least();
  double x = rest.xy, y = least - rest.xx;
  if (std::hypot(rest.yy - least, rest.xy) > std::hypot(x, y)) {
    x = rest.yy - least;
    y = -rest.xy;
  }
  const double length = std::hypot(x, y);
  if (!(length > 0.0)) return {1.0, 0.0};
  return {x / length, y / length};
}

// Returns whether a tip at rest at `t` in `rest` reaches the end of its well at `end` in `last`, and not that of
// another well. Near the end of a well, its minimum moves with the square root of the remaining path.
bool LatticeTip::leads_to(const Rest& rest, double t, const Rest& last, double end, const Control& at,
                          const Control& change) const noexcept {
  const auto [ex, ey] = softest(last);
  const LatticeLandscape::Place p = landscape_.at(last.x, last.y);
  const double third = at.scale * (p.third[0] * ex * ex * ex + 3.0 * p.third[1] * ex * ex * ey +
                                   3.0 * p.third[2] * ex * ey * ey + p.third[3] * ey * ey * ey);
  const double pull = change.scale * (p.slope_x * ex + p.slope_y * ey) - k_ * (change.x * ex + change.y * ey);
  const double away = (rest.x - last.x) * ex + (rest.y - last.y) * ey;
  const double parabola = 2.0 * pull * (end - t), bent = third * away * away;
  if (!(third * away > 0.0 && bent * pull > 0.0)) return false;
  return bent / parabola < kParabola && parabola / bent < kParabola;
}

// Leaves the end of its well, at `now_`, along the direction without curvature, to the side to which the path pulls it.
void LatticeTip::slip(double fraction, const Control& change, Step& step) noexcept {
  const auto [ex, ey] = softest(rest_at(x_, y_, now_));
  const LatticeLandscape::Place place = landscape_.at(x_, y_);
  const double pull_x = k_ * change.x - change.scale * place.slope_x;
  const double pull_y = k_ * change.y - change.scale * place.slope_y;
  const double side = pull_x * ex + pull_y * ey < 0.0 ? -1.0 : 1.0;
  const double kick = side * kKick * landscape_.period_m();

  const double before_x = x_, before_y = y_;
  const Sideways<Force> force_before = force();
  const double height = potential(x_, y_, now_);
  roll_down(x_ + kick * ex, y_ + kick * ey, now_);
  const Energy lost(std::max(0.0, height - potential(x_, y_, now_)));
  step.lost = step.lost + lost;
  const double way = std::hypot(x_ - before_x, y_ - before_y);
  if (way < kSlip * landscape_.period_m() || step.slip_count == step.slips.size()) return;
  step.slips[step.slip_count++] = {.fraction = fraction,
                                   .support = {Length(now_.x), Length(now_.y)},
                                   .way = {Length(x_ - before_x), Length(y_ - before_y)},
                                   .force_before = force_before,
                                   .force_after = force(),
                                   .lost = lost};
}

// Newton's method for the place on the path where the tip rests and the determinant of the curvatures is zero.
bool LatticeTip::find_end_of_well(const Control& from, const Control& change, double t, double furthest, Rest& rest,
                                  double& end) const noexcept {
  const double a = landscape_.period_m();
  double x = rest.x, y = rest.y, at_t = t;
  for (int i = 0; i < kMostIterations; ++i) {
    const Control at = on_path(from, change, at_t);
    const LatticeLandscape::Place p = landscape_.at(x, y);
    const double xx = at.scale * p.bend_xx + k_, xy = at.scale * p.bend_xy, yy = at.scale * p.bend_yy + k_;
    const double fx = at.scale * p.slope_x + k_ * (x - at.x), fy = at.scale * p.slope_y + k_ * (y - at.y);
    const double determinant = xx * yy - xy * xy;
    // their derivatives by t, and the determinant's by x, y and t
    const double fx_t = change.scale * p.slope_x - k_ * change.x, fy_t = change.scale * p.slope_y - k_ * change.y;
    const double d_x = at.scale * (p.third[0] * yy + xx * p.third[2] - 2.0 * xy * p.third[1]);
    const double d_y = at.scale * (p.third[1] * yy + xx * p.third[3] - 2.0 * xy * p.third[2]);
    const double d_t = change.scale * (p.bend_xx * yy + xx * p.bend_yy - 2.0 * xy * p.bend_xy);
    // Cramer's rule for [xx xy fx_t; xy yy fy_t; d_x d_y d_t]
    const double c_x = yy * d_t - fy_t * d_y, c_y = xy * d_t - fy_t * d_x, c_t = xy * d_y - yy * d_x;
    const double whole = xx * c_x - xy * c_y + fx_t * c_t;
    if (!(std::abs(whole) > 0.0)) return false;
    const double step_x =
        (fx * c_x - xy * (fy * d_t - fy_t * determinant) + fx_t * (fy * d_y - yy * determinant)) / whole;
    const double step_y =
        (xx * (fy * d_t - fy_t * determinant) - fx * c_y + fx_t * (xy * determinant - fy * d_x)) / whole;
    const double step_t = (xx * (yy * determinant - fy * d_y) - xy * (xy * determinant - fy * d_x) + fx * c_t) / whole;
    x -= step_x;
    y -= step_y;
    at_t -= step_t;
    if (!(std::hypot(x - rest.x, y - rest.y) <= kWellReach * a && at_t >= t - 1.0 && at_t <= furthest + 1.0)) {
      return false;
    }
    if (std::hypot(step_x, step_y) > kSettled * a || std::abs(step_t) > kSettled) continue;
    const Rest found = rest_at(x, y, on_path(from, change, at_t));
    // the other curvature must hold the tip, and the end must be ahead
    if (!(at_t > t && at_t <= furthest && found.xx + found.yy > 0.0)) return false;
    if (!leads_to(rest, t, found, at_t, on_path(from, change, at_t), change)) return false;
    rest = found;
    end = at_t;
    return true;
  }
  return false;
}

void LatticeTip::follow(const Control& from, const Control& change, Step& step) noexcept {
  const double a = landscape_.period_m();
  const double way = std::hypot(change.x, change.y) / a;
  const double longest = kPathStep / std::max(way, kPathStep);
  double stride = longest;
  double t = 0.0;
  for (int i = 0; t < 1.0 && i < kMostSteps; ++i) {
    const double next = std::min(1.0, t + stride);
    const Rest rest = rest_at(x_, y_, now_);
    const LatticeLandscape::Place place = landscape_.at(x_, y_);
    const double pull_x = k_ * change.x - change.scale * place.slope_x;
    const double pull_y = k_ * change.y - change.scale * place.slope_y;
    const double determinant = std::max(rest.xx * rest.yy - rest.xy * rest.xy, 1e-300);
    const double h = (next - t) / determinant;
    const double ahead_x = h * (rest.yy * pull_x - rest.xy * pull_y);
    const double ahead_y = h * (rest.xx * pull_y - rest.xy * pull_x);
    const Control at = on_path(from, change, next);
    if (std::hypot(ahead_x, ahead_y) <= kPathStep * a) {
      Rest there{.x = x_ + ahead_x, .y = y_ + ahead_y};
      if (settle(there, at, kGoodPrediction) && there.least() >= kLeastShareOfCurvature * rest.least()) {
        x_ = there.x;
        y_ = there.y;
        now_ = at;
        t = next;
        stride = std::min(2.0 * stride, longest);
        continue;
      }
    }
    Rest end_of_well = rest;
    double end = next;
    if (!find_end_of_well(from, change, t, next, end_of_well, end) && next - t > kShortestStep) {
      stride = 0.5 * (next - t);
      continue;
    }
    x_ = end_of_well.x;
    y_ = end_of_well.y;
    now_ = on_path(from, change, end);
    t = end;
    slip(t, change, step);
    stride = std::max(stride, 0.1 * longest);
  }
  if (t < 1.0) {
    now_ = on_path(from, change, 1.0);
    roll_down(x_, y_, now_);
  }
}

LatticeTip::Step LatticeTip::land(const Sideways<Length>& support, Energy scale) noexcept {
  now_ = {support.x.si, support.y.si, scale.si};
  Step step;
  roll_down(now_.x, now_.y, now_);
  step.given = stored();
  return step;
}

LatticeTip::Step LatticeTip::move_to(const Sideways<Length>& support, Energy scale) noexcept {
  Step step;
  const double a = landscape_.period_m();
  Control change{support.x.si - now_.x, support.y.si - now_.y, scale.si - now_.scale};
  if (const double periods = std::hypot(change.x, change.y) / a; periods > kLongestPath) {
    const double skipped = 1.0 - kLongestPath / periods;
    const double before = stored().si;
    now_.x += skipped * change.x;
    now_.y += skipped * change.y;
    roll_down(x_ + skipped * change.x, y_ + skipped * change.y, now_);
    step.given = Energy(std::max(0.0, stored().si - before));
    change.x *= 1.0 - skipped;
    change.y *= 1.0 - skipped;
  }
  const Control from = now_;
  follow(from, change, step);
  return step;
}

Sideways<Force> LatticeTip::force() const noexcept { return {Force(k_ * (x_ - now_.x)), Force(k_ * (y_ - now_.y))}; }

Energy LatticeTip::stored() const noexcept { return Energy(potential(x_, y_, now_)); }

double LatticeTip::relief() const noexcept { return landscape_.at(x_, y_).height; }

}  // namespace afm::physics
