// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tap_portrait.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace afm::physics {
namespace {

constexpr std::size_t kNodesOfHeight = 240;
constexpr double kFinestDistance = 0.1e-9;  // m; nodes closer to contact are evenly spaced, farther ones by factors
constexpr double kLeastSwingShare = 0.01;   // smallest amplitude of the table, as a share of the free amplitude
constexpr double kStepsOfReach = 250.0;     // number of steps of an edge per free amplitude
constexpr int kMostStepsOfEdge = 6000, kStepsOfPoint = 2;
constexpr double kFirstStepShare = 1e-3;  // first step from an unstable state, as a share of the free amplitude

struct SwingVector {
  double u, v;
};

// The averaged flow at one height: u' = -g u - w v, v' = -g v + w u + drive, with g and w functions of A alone.
class FlowAtHeight {
 public:
  struct Rates {
    double g, w;
  };

  FlowAtHeight(AveragedFlow& flow, double contact, double z, double reach)
      : z_(z - contact), free_amplitude_(flow.lever().free_amplitude.si) {
    const DrivenLever& lever = flow.lever();
    const double k = lever.spring_constant.si, r = lever.ratio;
    drive_ = lever.base_amplitude.si / (2.0 * r);
    least_ = kLeastSwingShare * lever.free_amplitude.si;
    first_x_ = x_of(least_);
    step_ = (x_of(reach) - first_x_) / static_cast<double>(kNodesOfHeight - 1);
    // from the highest lowest point down, so that the shift of each swing begins near its own
    for (std::size_t i = 0; i < kNodesOfHeight; ++i) {
      const double amplitude = amplitude_of(i), stored = k * r * amplitude * amplitude;
      const SwingAverages& swing = flow.averages(Length(amplitude), Length(z));
      rates_.push_back({0.5 / lever.quality_factor + flow.lost().si / (2.0 * std::numbers::pi * stored),
                        (r * r - 1.0) / (2.0 * r) + swing.virial.si / stored});
    }
  }

  double free_amplitude() const { return free_amplitude_; }
  double amplitude_of(std::size_t node) const {
    return z_ - kFinestDistance * std::sinh(first_x_ + static_cast<double>(node) * step_);
  }

  Rates rates(double amplitude) const {
    const double x = (x_of(std::max(amplitude, least_)) - first_x_) / step_;
    const auto node = static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(kNodesOfHeight - 2)));
    const double share = std::min(x - static_cast<double>(node), 1.0);
    const Rates &a = rates_[node], &b = rates_[node + 1];
    return {a.g + share * (b.g - a.g), a.w + share * (b.w - a.w)};
  }

  SwingVector velocity(const SwingVector& at) const {
    const Rates rate = rates(std::hypot(at.u, at.v));
    return {-rate.g * at.u - rate.w * at.v, -rate.g * at.v + rate.w * at.u + drive_};
  }

  // Force that the drive lacks for a resting swing of this amplitude: zero at rest, where it rises with the
  // amplitude if the state is stable, and falls if it is a saddle.
  double imbalance(double amplitude) const {
    const Rates rate = rates(amplitude);
    return amplitude * std::hypot(rate.g, rate.w) - drive_;
  }

  SwingVector rest(double amplitude) const {
    const Rates rate = rates(amplitude);
    const double square = rate.g * rate.g + rate.w * rate.w;
    return {-drive_ * rate.w / square, drive_ * rate.g / square};
  }

  // The amplitude at rest between two nodes.
  double root_after(std::size_t node) const {
    double low = amplitude_of(node), high = amplitude_of(node + 1);
    const bool rises = imbalance(low) < 0.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      ((imbalance(middle) < 0.0) == rises ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  // Direction of the path into a saddle: the eigenvector of the negative eigenvalue there.
  SwingVector way_in(const SwingVector& saddle) const {
    const double h = 1e-4 * free_amplitude_;
    const SwingVector right = velocity({saddle.u + h, saddle.v}), left = velocity({saddle.u - h, saddle.v});
    const SwingVector up = velocity({saddle.u, saddle.v + h}), down = velocity({saddle.u, saddle.v - h});
    const double uu = (right.u - left.u) / (2.0 * h), vu = (right.v - left.v) / (2.0 * h);
    const double uv = (up.u - down.u) / (2.0 * h), vv = (up.v - down.v) / (2.0 * h);
    const double half = 0.5 * (uu + vv);
    const double value = half - std::sqrt(std::max(0.0, half * half - (uu * vv - uv * vu)));
    // of the two forms of the eigenvector, the longer one
    const SwingVector a{uv, value - uu}, b{value - vv, vu};
    const SwingVector& longer = std::hypot(a.u, a.v) > std::hypot(b.u, b.v) ? a : b;
    const double length = std::hypot(longer.u, longer.v);
    return {longer.u / length, longer.v / length};
  }

 private:
  double x_of(double amplitude) const { return std::asinh((z_ - amplitude) / kFinestDistance); }

  double z_, free_amplitude_;
  double drive_ = 0.0, least_ = 0.0, first_x_ = 0.0, step_ = 0.0;
  std::vector<Rates> rates_;
};

// Against the flow, by Runge's and Kutta's steps of equal length.
std::vector<SwingPoint> path_back(const FlowAtHeight& flow, SwingVector at, double reach) {
  const double step = flow.free_amplitude() / kStepsOfReach;
  const auto backwards = [&](const SwingVector& from, const SwingVector& along, double share) {
    const SwingVector velocity = flow.velocity({from.u + share * step * along.u, from.v + share * step * along.v});
    const double speed = std::hypot(velocity.u, velocity.v);
    return SwingVector{-velocity.u / speed, -velocity.v / speed};
  };
  std::vector<SwingPoint> path;
  for (int i = 0; i < kMostStepsOfEdge && std::hypot(at.u, at.v) <= reach; ++i) {
    if (i % kStepsOfPoint == 0) path.push_back({Length(at.u), Length(at.v)});
    const SwingVector a = backwards(at, {}, 0.0), b = backwards(at, a, 0.5), c = backwards(at, b, 0.5),
                      d = backwards(at, c, 1.0);
    at.u += step / 6.0 * (a.u + 2.0 * b.u + 2.0 * c.u + d.u);
    at.v += step / 6.0 * (a.v + 2.0 * b.v + 2.0 * c.v + d.v);
  }
  return path;
}

}  // namespace

TapPortrait tap_portrait(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever, Length z,
                         Length reach) {
  TapPortrait portrait;
  const Length contact = surface->contact_height();
  if (z < contact) return portrait;
  AveragedFlow flow(surface, lever);
  const FlowAtHeight at_height(flow, contact.si, z.si, reach.si);
  for (std::size_t i = 0; i + 1 < kNodesOfHeight; ++i) {
    const bool before = at_height.imbalance(at_height.amplitude_of(i)) < 0.0;
    const bool after = at_height.imbalance(at_height.amplitude_of(i + 1)) < 0.0;
    if (before == after) continue;
    const double amplitude = at_height.root_after(i);
    const SwingVector rest = at_height.rest(amplitude);
    if (before) {
      TapState state{Length(amplitude), std::atan2(rest.v, rest.u)};
      flow.follow(state, z);
      portrait.states.push_back(state);
      continue;
    }
    const SwingVector way = at_height.way_in(rest);
    for (const double side : {-1.0, 1.0}) {
      const double first = side * kFirstStepShare * at_height.free_amplitude();
      portrait.edges.push_back(path_back(at_height, {rest.u + first * way.u, rest.v + first * way.v}, reach.si));
    }
  }
  return portrait;
}

}  // namespace afm::physics
