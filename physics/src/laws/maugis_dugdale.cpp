// SPDX-License-Identifier: Apache-2.0
#include "physics/maugis_dugdale.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace afm::physics {
namespace {

using std::numbers::pi;

// Limits that include every contact of a force microscope: at the first, the contact is 10^12 times its cohesive zone;
// at the second it is a point within rounding.
constexpr double kDeepestPoint = -30.0;
constexpr double kPoint = -1e-32;

// sin(x) - x cos(x), as a series for small x, where it cancels.
double sine_less_its_tangent(double x) {
  if (x > 1.0) return std::sin(x) - x * std::cos(x);
  double term = x * x * x / 3.0;
  double sum = term;
  for (int k = 1; k <= 9; ++k) {
    term *= -x * x / (2.0 * k * (2.0 * k + 3.0));
    sum += term;
  }
  return sum;
}

// Parameter below 0 where `falls` changes from true to false, to the last digit. Bisects by orders of magnitude,
// because it may be very close to 0.
template <class Falls>
double turning_point(double inner, double outer, Falls falls) {
  for (;;) {
    const double middle = -std::sqrt(inner * outer);
    if (!(middle > inner && middle < outer)) return outer;
    (falls(middle) ? inner : outer) = middle;
  }
}

// The radius c of the cohesive zone from (6.18) as quadratic c^2 + linear c = 1.
struct ZoneEquation {
  double quadratic;
  double linear;
  double radius() const { return 2.0 / (linear + std::sqrt(linear * linear + 4.0 * quadratic)); }
};

ZoneEquation zone_equation(double lambda, double theta, double sine) {
  // a = c cos(theta); the second difference is written without cancellation
  const double half_sine = std::sin(0.5 * theta);
  return {0.25 * lambda * sine_less_its_tangent(2.0 * theta),
          4.0 / 3.0 * lambda * lambda * (theta * sine - 2.0 * half_sine * half_sine)};
}

// Radius of the zone around a contact that has shrunk to a point.
double point_zone_radius(double lambda) { return zone_equation(lambda, pi / 2.0, 1.0).radius(); }

MaugisPoint zone_without_contact(double lambda, double s) {
  const double c = point_zone_radius(lambda) * std::exp(-s);
  const double drawn_out = 8.0 / (3.0 * pi) * lambda * c;
  MaugisPoint point{};
  point.load = -pi / 2.0 * lambda * c * c;
  point.indentation = 0.5 * c * c - drawn_out - 2.0 / (pi * lambda);
  point.dload_ds = -2.0 * point.load;
  point.dindentation_ds = drawn_out - c * c;
  return point;
}

}  // namespace

MaugisPoint maugis_point(double lambda, double s) {
  if (s > 0.0) return zone_without_contact(lambda, s);
  // theta from the more accurate of its sine and cosine
  const double sine = std::exp(s);
  const double cosine = std::sqrt(std::max(0.0, -std::expm1(2.0 * s)));
  const double theta = std::atan2(sine, cosine);

  const ZoneEquation equation = zone_equation(lambda, theta, sine);
  const double c = equation.radius();

  // derivatives along s: d theta/ds = tan(theta), whose pole at the point cancels against cos(theta) in all that follow
  const double dc = -c * theta * sine * (2.0 * lambda * sine * c + 4.0 / 3.0 * lambda * lambda) /
                    (2.0 * equation.quadratic * c + equation.linear);
  const double a = c * cosine;
  const double da2 = 2.0 * c * (dc * cosine * cosine - c * sine * sine);
  const double zone = sine * cosine + theta;
  MaugisPoint point{};
  point.contact_radius = a;
  point.load = a * a * a - lambda * c * c * zone;
  point.indentation = a * a - 4.0 / 3.0 * lambda * c * sine;
  point.dload_ds = 1.5 * a * da2 - 2.0 * lambda * c * (dc * zone + c * sine * cosine);
  point.dindentation_ds = da2 - 4.0 / 3.0 * lambda * sine * (dc + c);
  return point;
}

double maugis_pull_off(double lambda) {
  return turning_point(kDeepestPoint, kPoint, [=](double s) { return maugis_point(lambda, s).dload_ds < 0.0; });
}

double maugis_fixed_grips_end(double lambda) {
  // where d delta/dc = 0 for a zone without contact, if the contact extends that far
  const double zone_end = std::log(point_zone_radius(lambda) / (8.0 / (3.0 * pi) * lambda));
  if (zone_end > 0.0) return zone_end;
  return turning_point(kDeepestPoint, kPoint, [=](double s) { return maugis_point(lambda, s).dindentation_ds < 0.0; });
}

double maugis_at_load(double lambda, double load) {
  const double pull_off = maugis_pull_off(lambda);
  const double least = maugis_point(lambda, pull_off).load;
  if (!(load >= least)) {
    throw std::invalid_argument("load of " + std::to_string(load) + " pi W R tears the contact off, which holds " +
                                std::to_string(least) + " pi W R");
  }
  return turning_point(kDeepestPoint, pull_off, [=](double s) { return maugis_point(lambda, s).load > load; });
}

MaugisUnits maugis_units(const AdhesiveContact& contact) noexcept {
  const auto& [r, e, w] = contact;
  const Pressure k = 4.0 / 3.0 * e;
  return {cbrt(pi * w * r * r / k), pi * w * r, cbrt(pi * w / k * (pi * w / k) * r)};
}

Pressure cohesive_stress(SurfaceEnergy work_of_adhesion, Length atomic_distance) noexcept {
  return 16.0 / (9.0 * std::numbers::sqrt3) * work_of_adhesion / atomic_distance;
}

double maugis_lambda(const AdhesiveContact& contact, Pressure cohesive_stress) noexcept {
  const auto& [r, e, w] = contact;
  const Pressure k = 4.0 / 3.0 * e;
  return 2.0 * std::cbrt(cohesive_stress / k * (cohesive_stress / k) * (cohesive_stress * r / (pi * w)));
}

}  // namespace afm::physics
