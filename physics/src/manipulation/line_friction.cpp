// SPDX-License-Identifier: Apache-2.0
#include "line_friction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace afm::physics {
namespace {

// A turn whose ends move less than this share of the middle is integrated by points: the closed form divides by it.
constexpr double kSmallTurn = 0.1;
// Smallest way along the axis, as a share of the motion, with which the closed form is evaluated.
constexpr double kLeastAlong = 1e-14;
constexpr int kPivotSteps = 40, kStepHalvings = 40;
constexpr double kFlat = 1e-6;  // small curvature that keeps a step of driven_motion() finite

struct Node {
  double place, weight;
};
// Gauss-Legendre for six points: exact to 1e-15 for turns up to kSmallTurn. In pairs, so that what is symmetric cancels
// to the last bit: a rod that is pushed in its very middle does not turn.
constexpr std::array<Node, 3> kNodes{{{0.2386191860831969, 0.46791393457269104},
                                      {0.6612093864662645, 0.36076157304813861},
                                      {0.9324695142031521, 0.17132449237917034}}};

double dot(const RodVector& a, const RodVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool turns_little(const RodVector& m) { return std::abs(m[2]) <= kSmallTurn * std::sqrt(m[0] * m[0] + m[1] * m[1]); }

// Ways of the two ends and what their integrals consist of.
struct Ends {
  explicit Ends(const RodVector& m) {
    const double back = m[1] - m[2], front = m[1] + m[2];
    along = std::max({std::abs(m[0]), kLeastAlong * std::abs(back), kLeastAlong * std::abs(front)});
    for (const auto& [end, across] : {std::pair{std::size_t{0}, back}, std::pair{std::size_t{1}, front}}) {
      p[end] = across;
      way[end] = std::sqrt(across * across + along * along);
      inverse[end] = std::asinh(across / along);
    }
  }
  double along = 0.0;
  std::array<double, 2> p{}, way{}, inverse{};
};

// Integral over the rod from its values at both ends.
double between(double back, double front) { return front - back; }

}  // namespace

MeanWay mean_way(const RodVector& m) noexcept {
  MeanWay mean;
  if (turns_little(m)) {
    if (m[0] == 0.0 && m[1] == 0.0) return mean;
    for (const auto& [place, weight] : kNodes) {
      const double front = m[1] + m[2] * place, back = m[1] - m[2] * place;
      const double of_front = std::sqrt(m[0] * m[0] + front * front), of_back = std::sqrt(m[0] * m[0] + back * back);
      mean.way += 0.5 * weight * (of_front + of_back);
      mean.slope[0] += 0.5 * weight * (m[0] / of_front + m[0] / of_back);
      mean.slope[1] += 0.5 * weight * (front / of_front + back / of_back);
      mean.slope[2] += 0.5 * weight * place * (front / of_front - back / of_back);
    }
    return mean;
  }
  const Ends ends(m);
  const auto& [back, front] = ends.p;
  const double t2 = ends.along * ends.along, half = 0.5 / m[2];
  const double of_inverse = between(ends.inverse[0], ends.inverse[1]);
  const double of_product = between(back * ends.way[0], front * ends.way[1]);
  const double of_way = between(ends.way[0], ends.way[1]);
  mean.way = 0.5 * half * (of_product + t2 * of_inverse);
  mean.slope[0] = half * m[0] * of_inverse;
  mean.slope[1] = half * of_way;
  mean.slope[2] = half / m[2] * (0.5 * (of_product - t2 * of_inverse) - m[1] * of_way);
  return mean;
}

RodMatrix mean_way_curvature(const RodVector& m) noexcept {
  RodMatrix c{};
  if (turns_little(m)) {
    if (m[0] == 0.0 && m[1] == 0.0) return c;
    for (const auto& [place, weight] : kNodes) {
      const double front = m[1] + m[2] * place, back = m[1] - m[2] * place;
      const auto share_at = [&](double across) {
        const double way = std::sqrt(m[0] * m[0] + across * across);
        return 0.5 * weight / (way * way * way);
      };
      const double f = share_at(front), b = share_at(back), t = m[0];
      c[0][0] += f * front * front + b * back * back;
      c[0][1] -= t * (f * front + b * back);
      c[0][2] -= t * place * (f * front - b * back);
      c[1][1] += t * t * (f + b);
      c[1][2] += t * t * place * (f - b);
      c[2][2] += t * t * place * place * (f + b);
    }
  } else {
    const Ends ends(m);
    const double t2 = ends.along * ends.along, half = 0.5 / m[2], a = m[1];
    const double ratio = between(ends.p[0] / ends.way[0], ends.p[1] / ends.way[1]);
    const double of_squares = between(ends.inverse[0], ends.inverse[1]) - ratio;  // p^2/way^3
    const double of_product = -between(1.0 / ends.way[0], 1.0 / ends.way[1]);     // p/way^3
    c[0][0] = half * of_squares;
    c[0][1] = -half * m[0] * of_product;
    c[0][2] = -half * m[0] / m[2] * (of_squares - a * of_product);
    c[1][1] = half * ratio;
    c[1][2] = half / m[2] * (t2 * of_product - a * ratio);
    c[2][2] = half / (m[2] * m[2]) * (t2 * of_squares - 2.0 * a * t2 * of_product + a * a * ratio);
  }
  c[1][0] = c[0][1];
  c[2][0] = c[0][2];
  c[2][1] = c[1][2];
  return c;
}

// The least mean way on the plane of motions on which the load does the work 1, by Newton's steps in that plane.
DrivenMotion driven_motion(const RodVector& load) noexcept {
  const double size2 = dot(load, load);
  if (!(size2 > 0.0)) return {};
  const double size = std::sqrt(size2);
  const RodVector normal{load[0] / size, load[1] / size, load[2] / size};
  // two axes of the plane: that of the smallest part of the normal, less its part along the normal, and one across both
  std::size_t least = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(normal[i]) < std::abs(normal[least])) least = i;
  }
  RodVector u{-normal[0] * normal[least], -normal[1] * normal[least], -normal[2] * normal[least]};
  u[least] += 1.0;
  const double length = std::sqrt(dot(u, u));
  for (double& part : u) part /= length;
  const RodVector v{normal[1] * u[2] - normal[2] * u[1], normal[2] * u[0] - normal[0] * u[2],
                    normal[0] * u[1] - normal[1] * u[0]};
  // lengths in units of 1/size: motion = normal + c u + d v
  RodVector motion = normal;
  MeanWay at = mean_way(motion);
  for (int step = 0; step < kPivotSteps; ++step) {
    const RodMatrix h = mean_way_curvature(motion);
    const auto form = [&h](const RodVector& a, const RodVector& b) {
      double sum = 0.0;
      for (std::size_t i = 0; i < 3; ++i) sum += a[i] * dot(h[i], b);
      return sum;
    };
    const double gu = dot(at.slope, u), gv = dot(at.slope, v);
    const double uu = form(u, u) + kFlat, uv = form(u, v), vv = form(v, v) + kFlat;
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 0.0)) break;
    double du = -(vv * gu - uv * gv) / determinant, dv = -(uu * gv - uv * gu) / determinant;
    const double far = std::max(1.0, std::sqrt(du * du + dv * dv));  // step no longer than the motion
    du /= far;
    dv /= far;
    bool gains = false;
    for (int halving = 0; halving < kStepHalvings && !gains; ++halving, du *= 0.5, dv *= 0.5) {
      RodVector next = motion;
      for (std::size_t i = 0; i < 3; ++i) next[i] += du * u[i] + dv * v[i];
      const MeanWay there = mean_way(next);
      if (!(there.way < at.way)) continue;
      gains = true;
      motion = next;
      at = there;
    }
    if (!gains) break;
  }
  return {size / at.way, motion};
}

}  // namespace afm::physics
