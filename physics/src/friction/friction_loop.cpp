// SPDX-License-Identifier: Apache-2.0
#include "physics/friction/friction_loop.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace afm::physics {

namespace {

using Points = std::span<const LateralPoint>;

// Distance back, as a share of the whole run's width, from which on a turn counts; larger than the noise.
constexpr double kTurnShare = 0.1;
constexpr double kStickShare = 0.4;   // change of force, as a share of that at a turn, below which the tip still sticks
constexpr double kNoWidth = 1e-4;     // difference of both strokes that is rounding, as a share of the change of force
constexpr double kBeyondStick = 1.1;  // beginning of sliding, in units of the distance over which the tip sticks

// Places of the points at which the direction changes, with the first and the last point.
std::vector<std::size_t> turns_of(Points run) {
  const auto [least, most] = std::minmax_element(
      run.begin(), run.end(), [](const LateralPoint& a, const LateralPoint& b) { return a.place < b.place; });
  const Length back = kTurnShare * (most->place - least->place);
  std::vector<std::size_t> turns{0};
  std::size_t low = 0, high = 0;
  int direction = 0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (run[i].place > run[high].place) high = i;
    if (run[i].place < run[low].place) low = i;
    if (direction >= 0 && run[high].place - run[i].place > back) {
      if (direction > 0) turns.push_back(high);
      direction = -1;
      low = i;
    } else if (direction <= 0 && run[i].place - run[low].place > back) {
      if (direction < 0) turns.push_back(low);
      direction = 1;
      high = i;
    }
    if (direction > 0) low = i;
    if (direction < 0) high = i;
  }
  turns.push_back(run.size() - 1);
  return turns;
}

// Least squares over the points at the beginning of a stroke whose force has changed by less than `change`.
double slope_at_turn(Points stroke, double change) {
  double n = 0, x = 0, f = 0, xx = 0, xf = 0;
  const double x0 = stroke.front().place.si, f0 = stroke.front().force.si;
  for (const LateralPoint& point : stroke) {
    const double dx = point.place.si - x0, df = point.force.si - f0;
    if (std::abs(df) > change) break;
    n += 1.0;
    x += dx;
    f += df;
    xx += dx * dx;
    xf += dx * df;
  }
  const double spread = n * xx - x * x;
  return spread > 0.0 ? (n * xf - x * f) / spread : 0.0;
}

// Mean of the force over the places from `low` to `high`, by trapezoids.
double mean_between(Points stroke, double low, double high) {
  double sum = 0.0;
  for (std::size_t i = 1; i < stroke.size(); ++i) {
    double x0 = stroke[i - 1].place.si, x1 = stroke[i].place.si;
    double f0 = stroke[i - 1].force.si, f1 = stroke[i].force.si;
    if (x0 > x1) {
      std::swap(x0, x1);
      std::swap(f0, f1);
    }
    const double from = std::max(x0, low), to = std::min(x1, high);
    if (!(to > from)) continue;
    const double slope = (f1 - f0) / (x1 - x0);
    // a shaking hand's step back counts once in each direction
    const double sign =
        (stroke[i].place > stroke[i - 1].place) == (stroke.back().place > stroke.front().place) ? 1 : -1;
    sum += sign * (to - from) * (f0 + slope * (0.5 * (from + to) - x0));
  }
  return sum / (high - low);
}

// The cycle from point `a` over the turn `b` to point `c` of the run.
std::optional<FrictionLoop> loop_between(Points run, std::size_t a, std::size_t b, std::size_t c) {
  const Points first = run.subspan(a, b - a + 1), second = run.subspan(b, c - b + 1);
  const bool up_first = first.back().place > first.front().place;
  const Points forward = up_first ? first : second, backward = up_first ? second : first;

  const auto of_force = [](const LateralPoint& p, const LateralPoint& q) { return p.force < q.force; };
  const Points cycle = run.subspan(a, c - a + 1);
  const auto [least, most] = std::minmax_element(cycle.begin(), cycle.end(), of_force);
  const double change = (most->force - least->force).si;
  if (!(change > 0.0)) return std::nullopt;
  const double slope = slope_at_turn(second, kStickShare * change);
  if (!(slope > 0.0)) return std::nullopt;
  const double sticks = kBeyondStick * change / slope;
  const double low = std::max(forward.front().place, backward.back().place).si + sticks;
  const double high = std::min(forward.back().place, backward.front().place).si - sticks;
  if (!(high > low)) return std::nullopt;

  const double there = mean_between(forward, low, high), back = mean_between(backward, low, high);
  const double width = std::abs(there - back) > kNoWidth * change ? there - back : 0.0;
  return FrictionLoop{.half_width = Force(0.5 * width),
                      .offset = Force(0.5 * (there + back)),
                      .slope = Stiffness(slope),
                      .dissipated = Energy(width * (high - low)),
                      .begin = a,
                      .turn = b,
                      .end = c};
}

}  // namespace

std::vector<LateralPoint> along_main_line(std::span<const SidewaysPoint> points) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const SidewaysPoint& point : points) {
    const double px = point.place.x.si, py = point.place.y.si;
    n += 1.0;
    x += px;
    y += py;
    xx += px * px;
    xy += px * py;
    yy += py * py;
  }
  const double angle = n > 0.0 ? 0.5 * std::atan2(2.0 * (xy - x * y / n), xx - x * x / n - yy + y * y / n) : 0.0;
  const double ux = std::cos(angle), uy = std::sin(angle);
  std::vector<LateralPoint> run(points.size());
  std::transform(points.begin(), points.end(), run.begin(), [&](const SidewaysPoint& point) {
    return LateralPoint{ux * point.place.x + uy * point.place.y, -ux * point.force.x - uy * point.force.y};
  });
  return run;
}

std::optional<FrictionLoop> last_friction_loop(Points run) {
  if (run.size() < 4) return std::nullopt;
  const std::vector<std::size_t> turns = turns_of(run);
  for (std::size_t i = turns.size() - 1; i >= 2; --i) {
    if (auto loop = loop_between(run, turns[i - 2], turns[i - 1], turns[i])) return loop;
  }
  return std::nullopt;
}

}  // namespace afm::physics
