// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tapping/swing_shape.h"

namespace afm::physics {

// Sums over a part of a swing whose height is bottom + 2 A sin^2(angle/2), and its bend.
struct SwingSums {
  double force = 0.0;          // integral of F, N
  double cosine = 0.0;         // integral of F cos(angle)
  double work = 0.0;           // integral of F sin(angle)
  double viscous = 0.0;        // integral of sqrt(delta) (h'/A)^2 over the angle, sqrt(m)
  double shift = 0.0;          // integral of F times the lever's response at angle 0 without the first harmonic, N
  double highest = -HUGE_VAL;  // largest force of a viscous sample on the way down, N

  SwingSums operator+(const SwingSums& other) const {
    return {force + other.force,     cosine + other.cosine, work + other.work,
            viscous + other.viscous, shift + other.shift,   std::max(highest, other.highest)};
  }
};

// Gauss-Legendre with 12 nodes on (0, 1): node and weight of one half; the other is its mirror image (Abramowitz &
// Stegun 25.4.30).
struct GaussNode {
  double x, weight;
};
inline constexpr std::array<GaussNode, 6> kGauss12{{{0.1252334085114689, 0.2491470458134028},
                                                    {0.3678314989981802, 0.2334925365383548},
                                                    {0.5873179542866175, 0.2031674267230659},
                                                    {0.7699026741943047, 0.1600783285433462},
                                                    {0.9041172563704749, 0.1069393259953184},
                                                    {0.9815606342467192, 0.0471753363865118}}};

template <class Add>
void gauss12(double from, double to, const Add& add) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  // in rising order
  for (std::size_t i = kGauss12.size(); i-- > 0;) add(middle - half * kGauss12[i].x, half * kGauss12[i].weight);
  for (const GaussNode& node : kGauss12) add(middle + half * node.x, half * node.weight);
}

// A swing over a force that is analytic above `steep`, below which it varies fast.
struct SwingGeometry {
  double amplitude, bottom;
  double zero_of_indentation;
  HarmonicResponse response;
  SwingShape* shape = nullptr;  // bend of the swing, updated with the forces; null: none
  double ways = 1.0;            // fraction of both ways in which the force acts: 1, or one half
  bool viscous = false;         // true: the sample has a viscous force
  double friction = 0.0;        // viscous force over sqrt(delta) and the tip's speed in A, N/sqrt(m)

  double bend(double angle) const { return shape == nullptr ? 0.0 : shape->bend(angle); }
  double height(double angle) const {
    const double s = std::sin(0.5 * angle);
    return bottom + 2.0 * amplitude * s * s + bend(angle);
  }
  double angle(double height) const {
    double bent = 0.0, found = straight_angle(height);
    if (shape == nullptr) return found;
    for (int i = 0; i < 12; ++i) {
      const double next = shape->bend(found);
      if (std::abs(next - bent) < 1e-18) break;
      bent = next;
      found = straight_angle(height - bent);
    }
    return found;
  }
  double straight_angle(double height) const {
    const double share = (height - bottom) / (2.0 * amplitude);
    return 2.0 * std::asin(std::sqrt(std::clamp(share, 0.0, 1.0)));
  }

  template <class ForceAt>
  void add(double angle, double weight, const ForceAt& force_at, SwingSums& sums) const {
    const double s = std::sin(0.5 * angle), sine_squared = 4.0 * s * s * (1.0 - s * s);
    const double cosine = 1.0 - 2.0 * s * s, sine = std::sqrt(sine_squared);
    const Turned of_angle{cosine, sine}, turned = response.turned(angle, of_angle);
    double bent = 0.0;
    if (shape != nullptr) bent = ways == 1.0 ? shape->bend_now(angle, of_angle, turned) : shape->bend(angle);
    const double h = bottom + 2.0 * amplitude * s * s + bent;
    const double here = force_at(h), force = weight * here;
    const bool slides = viscous && h < zero_of_indentation;
    const double bending =
        slides && shape != nullptr ? shape->rate_now(angle, of_angle, turned, ways * weight, here) : 0.0;
    if (shape != nullptr) shape->add(angle, of_angle, turned, ways * weight, here, bent);
    sums.force += force;
    sums.cosine += force * cosine;
    sums.work += force * sine;
    sums.shift += force * response.at_lowest(angle, of_angle, turned);
    if (slides) {
      const double speed = sine + bending / amplitude;
      const double speed_squared = bending == 0.0 ? sine_squared : speed * speed;
      const double root = std::sqrt(zero_of_indentation - h);
      sums.viscous += weight * root * speed_squared;
      if (friction > 0.0) sums.highest = std::max(sums.highest, here + friction * root * speed);
    }
  }

  // Sums in contact, between two angles. At the upper end the force may vary like the root of the distance, which the
  // quadratic change of variable makes smooth.
  template <class ForceAt>
  SwingSums in_contact(double from, double to, const ForceAt& force_at) const {
    SwingSums sums;
    if (to <= from) return sums;
    const auto add_mapped = [&](double u, double weight) {
      add(from + (to - from) * u * (2.0 - u), weight * 2.0 * (to - from) * (1.0 - u), force_at, sums);
    };
    gauss12(0.0, 0.5, add_mapped);
    gauss12(0.5, 1.0, add_mapped);
    return sums;
  }

  // Sums above contact, between two angles: pieces on which the distance from `pole`, below all heights, grows by a
  // factor of four, so that each converges in the same way however near the tip comes.
  template <class ForceAt>
  SwingSums above_contact(double from, double to, double pole, const ForceAt& force_at) const {
    SwingSums sums;
    for (double left = from; left < to;) {
      const double right = std::min(to, angle(pole + 4.0 * (height(left) - pole)));
      const double end = right > left ? right : to;
      gauss12(left, end, [&](double at, double weight) { add(at, weight, force_at, sums); });
      left = end;
    }
    return sums;
  }
};

}  // namespace afm::physics
