// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>

#include "tapping/harmonic_response.h"

namespace afm::physics {

// Departure of a swing from a sinusoid: its bend, the deflection of the lever that is not of the first harmonic,
// from the lowest point on. The height at an angle t from the lowest point, 0 to pi, is
//
//   bottom + 2 A sin^2(t/2) + bend(t),   bend(t) = y(t) - y(0),   y(t) = <F(t') G(t - t')>/k,
//
// with F the sample's force, averaged over the way down and the way up. y is a sum of products of P, C and functions of
// t (tapping/harmonic_response.h), and of an integral from 0 to t, large in a stiff contact, which follows from what
// the tip has met before. So a quadrature in the order of the angles finds the bend as it goes, and only P and C have
// to be repeated. The sum from node to node is off by the square of their distance, too much for a tip that is held or
// drawn for the whole swing: so it is that of F less its mean and first harmonic in the quadrature before, which bend
// nothing.
//
// A quadrature calls begin(), then bend_now() and add() for each node in rising order, then finish(). One thread; does
// not allocate.
class SwingShape {
 public:
  // `exact`: less the mean and the first harmonic; and half of a node's force lies before it, without which the rate is
  // off by up to that half.
  explicit SwingShape(const HarmonicResponse& response, bool exact = true) : response_(response), exact_(exact) {}

  const HarmonicResponse& response() const noexcept { return response_; }

  // Bend of the newest quadrature, between its nodes; 0 without one.
  double bend(double angle) const noexcept;

  void straighten() noexcept;
  void begin() noexcept {
    count_ = 0;
    before_ = {0.0, 0.0};
  }

  // Bend at the next node: its angle, and the cosine and sine of it and of the angle turned by the response.
  double bend_now(double angle, const Turned& of_angle, const Turned& turned) const noexcept {
    return response_.bend(p_, c_, angle, of_angle, turned, before_);
  }

  // Rate of the bend at the next node, in m per rad; 0 unless `exact`.
  double rate_now(double angle, const Turned& of_angle, const Turned& turned, double weight,
                  double force) const noexcept {
    if (!exact_ || count_ == kMostNodes) return 0.0;
    const double bending = weight * (force - straight_.at(of_angle));
    return response_.rate(p_, c_, angle, of_angle, turned, before_, 0.5 * bending);
  }

  // Adds a node with its weight, its force, in N, and the bend with which it was computed.
  void add(double angle, const Turned& of_angle, const Turned& turned, double weight, double force,
           double bend) noexcept {
    if (count_ == kMostNodes) return;
    const double bending = weight * (force - straight_.at(of_angle));
    before_.cosine += bending * turned.cosine;
    before_.sine += bending * turned.sine;
    nodes_[filling_][count_++] = {angle, weight, of_angle, turned, weight * force, bending, bend};
  }

  // Mean square of dy/dt over the complete quadrature, in m^2: half of the sum of n^2 A_n^2 over the harmonics n > 1.
  double mean_square_rate() const noexcept;

  // Error of the bend: its difference from the one that the resulting P and C give, weighted by the force, in m.
  double finish() noexcept;

 private:
  // A force that causes no bend, in N.
  struct Straight {
    double mean = 0, cosine = 0;

    double at(const Turned& of_angle) const noexcept { return mean + cosine * of_angle.cosine; }
  };
  struct Node {
    double angle = 0, weight = 0;
    Turned of_angle{0.0, 0.0}, turned{0.0, 0.0};
    double force = 0, bending = 0, bend = 0;  // weight times the force, and times its part that bends
  };
  // Upper bound of a quadrature's nodes: 12 for each factor of four between the closest height and the largest.
  static constexpr std::size_t kMostNodes = 512;
  using Nodes = std::array<Node, kMostNodes>;

  Straight straight_part_of(const Nodes& nodes) const noexcept;
  double sum_of_square_rates(const Nodes& nodes, std::size_t count) const noexcept;

  HarmonicResponse response_;
  bool exact_;
  Straight straight_;                   // part of F in the complete quadrature that causes no bend; 0 unless exact
  double p_ = 0.0, c_ = 0.0;            // P and C of the rest of F
  double used_p_ = 0.0, used_c_ = 0.0;  // P and C with which the complete quadrature was made
  Turned before_{0.0, 0.0};  // integrals of the rest times cosine and sine of the turned angle, up to the newest node
  mutable std::optional<double> square_rates_;  // integral of (dy/dt)^2 over the complete quadrature, once it is known
  std::array<Nodes, 2> nodes_;
  std::size_t filling_ = 0;  // index of the newer quadrature; the other one is complete
  std::size_t old_count_ = 0, count_ = 0;
  mutable std::size_t cursor_ = 0;
};

}  // namespace afm::physics
