// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace afm::physics {

// Cosine and sine of one angle.
struct Turned {
  double cosine, sine;
};

// A lever's answer to the sample's force F without its first harmonic, of a swing that is even about its lowest point
// at t = 0. With the drive at r resonances the mean and each harmonic answer by 1/(1 - n^2 r^2), undamped, so that with
// a = 1/r
//
//   k y(t) = a P cos(a t)/sin(a pi) - 2 C cos(t)/(pi (1 - r^2)) + a integral from 0 to t of F(t') sin(a (t - t')),
//   P = integral from 0 to pi of F cos(a (pi - t)),   C = integral of F cos(t).
//
// At the resonance, where both first terms are infinite, it is
//
//   k y(t) = [(2 P - C) cos(t) - 2 C t sin(t)]/(2 pi) + integral from 0 to t of F(t') sin(t - t'),
//   P = integral of F (pi - t) sin(t).
//
// There is none at r = 1/2, 1/3, ..., the resonance of a harmonic.
class HarmonicResponse {
 public:
  explicit HarmonicResponse(double spring_constant, double ratio = 1.0) noexcept : k_(spring_constant) {
    constexpr double kPi = std::numbers::pi;
    constexpr double kNearest = 1e-5;  // distance from resonance within which both forms differ by less than rounding
    resonant_ = std::abs(ratio - 1.0) < kNearest;
    if (resonant_) return;
    a_ = 1.0 / ratio;
    end_ = {std::cos(a_ * kPi), std::sin(a_ * kPi)};
    by_p_ = a_ / end_.sine;
    by_c_ = 2.0 / (kPi * (1.0 - ratio * ratio));
  }

  // Cosine and sine of a t, for those of t.
  Turned turned(double t, const Turned& of_t) const noexcept {
    return resonant_ ? of_t : Turned{std::cos(a_ * t), std::sin(a_ * t)};
  }

  // Contribution of a force to P.
  double p_of(double force, double t, const Turned& of_t, const Turned& of_at) const noexcept {
    if (resonant_) return force * (std::numbers::pi - t) * of_t.sine;
    return force * (end_.cosine * of_at.cosine + end_.sine * of_at.sine);
  }

  // G(t) of physics/tapping/tap_surface.h: k y(0) is <F G>.
  double at_lowest(double t, const Turned& of_t, const Turned& of_at) const noexcept {
    if (resonant_) return (std::numbers::pi - t) * of_t.sine - 0.5 * of_t.cosine;
    return std::numbers::pi * (by_p_ * p_of(1.0, t, of_t, of_at) - by_c_ * of_t.cosine);
  }

  // y(t) - y(0), with the integrals from 0 to t of F cos(a t') and F sin(a t').
  double bend(double p, double c, double t, const Turned& of_t, const Turned& of_at,
              const Turned& before) const noexcept {
    const double since = of_at.sine * before.cosine - of_at.cosine * before.sine;
    if (resonant_) return resonant_bend(p, c, t, of_t) + since / k_;
    return (far_bend(p, c, of_t, of_at) + a_ * since) / k_;
  }
  // The part of bend() that depends on P and C.
  double bend_of_sums(double p, double c, double t, const Turned& of_t, const Turned& of_at) const noexcept {
    return resonant_ ? resonant_bend(p, c, t, of_t) : far_bend(p, c, of_t, of_at) / k_;
  }

  // dy/dt, with the integrals of bend() and `here` of F at t itself.
  double rate(double p, double c, double t, const Turned& of_t, const Turned& of_at, const Turned& before,
              double here) const noexcept {
    const double since = of_at.cosine * before.cosine + of_at.sine * before.sine + here;
    if (!resonant_) return (by_c_ * c * of_t.sine - by_p_ * p * a_ * of_at.sine + a_ * a_ * since) / k_;
    const double of_sums = -2.0 * (p * of_t.sine + c * t * of_t.cosine) - c * of_t.sine;
    return of_sums / (2.0 * std::numbers::pi * k_) + since / k_;
  }

 private:
  double resonant_bend(double p, double c, double t, const Turned& of_t) const noexcept {
    const double of_sums = (2.0 * p - c) * (of_t.cosine - 1.0) - 2.0 * c * t * of_t.sine;
    return of_sums / (2.0 * std::numbers::pi * k_);
  }
  double far_bend(double p, double c, const Turned& of_t, const Turned& of_at) const noexcept {
    return by_p_ * p * (of_at.cosine - 1.0) - by_c_ * c * (of_t.cosine - 1.0);
  }

  double k_;
  bool resonant_ = true;
  double a_ = 1.0, by_p_ = 0.0, by_c_ = 0.0;
  Turned end_{-1.0, 0.0};
};

}  // namespace afm::physics
