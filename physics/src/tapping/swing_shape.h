// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace afm::physics {

// Departure of a swing from a sinusoid: its bend, the deflection of the lever that is not of the first harmonic,
// from the lowest point on. The height at an angle t from the lowest point, 0 to pi, is
//
//   bottom + 2 A sin^2(t/2) + bend(t),   bend(t) = y(t) - y(0),   y(t) = <F(t') G(t - t')>/k,
//
// with F the sample's force, averaged over the way down and the way up, and G of physics/tapping/tap_surface.h. Since G
// is a sum of products, y is
//
//   y(t) = [(2 P - C) cos(t) - 2 C t sin(t)]/(2 pi k) + 1/k integral from 0 to t of F(t') sin(t - t'),
//   P = integral of F (pi - t) sin(t),   C = integral of F cos(t),
//
// where the last term, large in a stiff contact, follows from what the tip has met before. So a quadrature in the order
// of the angles finds the bend as it goes, and only P and C have to be repeated.
//
// A quadrature calls begin(), then bend_now() and add() for each node in rising order, then finish(). One thread; does
// not allocate.
class SwingShape {
 public:
  // `halves`: of a node's force half lies before it, for the rate; without, the rate is off by up to that half.
  explicit SwingShape(double spring_constant, bool halves = true) : k_(spring_constant), halves_(halves) {}

  // Of the newest quadrature, between its nodes; 0 without one.
  double bend(double angle) const noexcept;

  void straighten() noexcept;
  void begin() noexcept {
    count_ = 0;
    cosine_before_ = sine_before_ = rate_squares_ = 0.0;
  }

  // At the next node, whose angle has this cosine and sine.
  double bend_now(double angle, double cosine, double sine) const noexcept {
    const double global = (2.0 * p_ - c_) * (cosine - 1.0) - 2.0 * c_ * angle * sine;
    return global / (2.0 * std::numbers::pi * k_) + (sine * cosine_before_ - cosine * sine_before_) / k_;
  }

  // A node with its weight, the force there, in N, and the bend that it was computed with.
  void add(double angle, double cosine, double sine, double weight, double force, double bend) noexcept {
    if (count_ == kMostNodes) return;
    const double global = -2.0 * (p_ * sine + c_ * angle * cosine) - c_ * sine;
    const double here = halves_ ? 0.5 * weight * force : 0.0;
    const double rate =
        global / (2.0 * std::numbers::pi * k_) + (cosine * cosine_before_ + sine * sine_before_ + here) / k_;
    rate_squares_ += weight * rate * rate;
    cosine_before_ += weight * force * cosine;
    sine_before_ += weight * force * sine;
    nodes_[filling_][count_++] = {angle, cosine, sine, weight * force, bend};
  }

  // Mean square of dy/dt over the newest quadrature, in m^2: half of the sum of n^2 A_n^2 over the harmonics n > 1.
  double mean_square_rate() const noexcept { return rate_squares_ / std::numbers::pi; }

  // Error of the bend: its difference from the one that the resulting P and C give, weighted by the force, in m.
  double finish() noexcept;

 private:
  struct Node {
    double angle = 0, cosine = 0, sine = 0, force = 0, bend = 0;
  };
  // More than any quadrature has, which has 12 for each factor of four between the closest height and the largest.
  static constexpr std::size_t kMostNodes = 512;
  using Nodes = std::array<Node, kMostNodes>;

  double k_;
  bool halves_;
  double p_ = 0.0, c_ = 0.0;
  double cosine_before_ = 0.0, sine_before_ = 0.0;  // integrals of F cos(t), F sin(t) up to the newest node
  double rate_squares_ = 0.0;                       // integral of (dy/dt)^2 up to it
  std::array<Nodes, 2> nodes_;
  std::size_t filling_ = 0;  // the newer quadrature; the other one is complete
  std::size_t old_count_ = 0, count_ = 0;
  mutable std::size_t cursor_ = 0;
};

}  // namespace afm::physics
