// SPDX-License-Identifier: Apache-2.0
#include "adhesive_branch.h"

#include <algorithm>
#include <cmath>

#include "physics/adhesion_map.h"
#include "physics/maugis_dugdale.h"

namespace afm::fits {

namespace {

// Ends of the parameter: a contact far deeper than its neck, and DMT's, whose radius is 2e-9 there.
constexpr double kDeepest = -30.0, kPoint = 20.0;

// JKR's contact is lost at fixed grips, the last of all folds, at a radius of (1/6)^(1/3) in Maugis' units.
const double kJkrEnd = std::log(6.0) / 3.0;

}  // namespace

AdhesiveBranch::AdhesiveBranch(Shape law, const physics::AdhesiveContact& contact, double atomic_distance_m,
                               double spring_n_per_m)
    : law_(law),
      lambda_(physics::maugis_lambda(
          contact, physics::cohesive_stress(contact.work_of_adhesion, physics::Length(atomic_distance_m)))),
      spring_n_per_m_(spring_n_per_m) {
  const physics::MaugisUnits units = physics::maugis_units(contact);
  load_n_ = units.load.si;
  indentation_m_ = units.indentation.si;
  fold_ = find_fold();
}

// JKR: P = a^3 - sqrt(6 a^3), delta = a^2 - (2/3) sqrt(6 a); DMT: P = a^3 - 2, delta = a^2; both with a = exp(-s).
AdhesiveBranch::Point AdhesiveBranch::point(double lambda, double s) const {
  if (law_ == Shape::Maugis) {
    const physics::MaugisPoint maugis = physics::maugis_point(lambda, s);
    return {maugis.load, maugis.indentation, maugis.dload_ds, maugis.dindentation_ds};
  }
  const double a = std::exp(-s), square = a * a, cube = square * a;
  if (law_ == Shape::Dmt) return {cube - 2.0, square, -3.0 * cube, -2.0 * square};
  const double root = std::sqrt(6.0 * a);
  return {cube - a * root, square - 2.0 / 3.0 * root, 1.5 * a * root - 3.0 * cube, root / 3.0 - 2.0 * square};
}

double AdhesiveBranch::way_m(const Point& point) const {
  return indentation_m_ * point.indentation + load_n_ * point.load / spring_n_per_m_;
}

double AdhesiveBranch::way_slope_m(const Point& point) const {
  return indentation_m_ * point.dindentation + load_n_ * point.dload / spring_n_per_m_;
}

// Parameter at which the way stops falling with s.
double AdhesiveBranch::find_fold() const {
  constexpr int kHalvings = 60;
  double inner = kDeepest, outer = kPoint;
  if (law_ == Shape::Dmt) return outer;
  outer = law_ == Shape::Jkr ? kJkrEnd : physics::maugis_fixed_grips_end(lambda_);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (inner + outer);
    (way_slope_m(point(lambda_, middle)) < 0.0 ? inner : outer) = middle;
  }
  return inner;
}

// Newton's method between ends that close in.
double AdhesiveBranch::solve(double way, double near) const {
  constexpr int kMostSteps = 80;
  constexpr double kStep = 0.5, kClose = 1e-6;  // the error of a step is the square
  double inner = std::min(near, fold_) - kStep, outer = fold_;
  while (inner > kDeepest && way_m(point(lambda_, inner)) < way) inner -= kStep;
  double s = std::clamp(near, inner, outer);
  for (int step = 0; step < kMostSteps; ++step) {
    const Point here = point(lambda_, s);
    const double off_m = way_m(here) - way;
    (off_m > 0.0 ? inner : outer) = s;
    const double newton = s - off_m / way_slope_m(here);
    const double next = newton >= inner && newton <= outer ? newton : 0.5 * (inner + outer);
    const double change = std::abs(next - s);
    s = next;
    if (change < kClose && next == newton) break;
  }
  return s;
}

AdhesiveBranch::Held AdhesiveBranch::at(double way, double& near) const {
  const bool beyond = way < fold_way_m();
  near = beyond ? fold_ : solve(way, near);
  const Point here = point(lambda_, near);
  // derivatives by the logarithm of lambda at one s, by central differences; the other laws do not depend on it
  double load_by_lambda = 0.0, indentation_by_lambda = 0.0;
  if (law_ == Shape::Maugis) {
    constexpr double kStep = 1e-4;  // step of the central difference, whose error is its square
    const Point more = point(lambda_ * std::exp(kStep), near), less = point(lambda_ * std::exp(-kStep), near);
    load_by_lambda = (more.load - less.load) / (2.0 * kStep);
    indentation_by_lambda = (more.indentation - less.indentation) / (2.0 * kStep);
  }
  Held held{indentation_m_ * here.indentation, load_n_ * here.load, 0.0, 0.0, 0.0};
  const double slope_n = load_n_ * here.dload, way_slope = way_slope_m(here);
  // change of the force at one way, where the units of load and indentation and lambda grow with these powers
  const auto change = [&](double load_power, double indentation_power, double lambda_power) {
    const double load_n = held.force_n * load_power + load_n_ * load_by_lambda * lambda_power;
    const double depth_m = held.depth_m * indentation_power + indentation_m_ * indentation_by_lambda * lambda_power;
    if (beyond) return -spring_n_per_m_ * depth_m;  // valid except for the shift of the fold
    return load_n - slope_n * (depth_m + load_n / spring_n_per_m_) / way_slope;
  };
  held.by_modulus_n = change(0.0, -2.0 / 3.0, -2.0 / 3.0);
  held.by_work_n = change(1.0, 2.0 / 3.0, 2.0 / 3.0);
  held.by_contact_n_per_m = beyond ? spring_n_per_m_ : slope_n / way_slope;
  if (beyond) held.force_n = spring_n_per_m_ * (way - held.depth_m);
  return held;
}

double AdhesiveBranch::pull_off_n() const {
  if (law_ == Shape::Dmt) return 2.0 * load_n_;
  if (law_ == Shape::Jkr) return 1.5 * load_n_;
  return -load_n_ * physics::maugis_point(lambda_, physics::maugis_pull_off(lambda_)).load;
}

double tabor_of(const physics::AdhesiveContact& contact, double atomic_distance_m) {
  const auto& [radius, modulus, work] = contact;
  const double range = work.si / (modulus.si * atomic_distance_m);
  return std::cbrt(radius.si / atomic_distance_m * range * range);
}

Shape law_of_tabor(double tabor) {
  switch (physics::regime_of(tabor, 0.0)) {
    case physics::Regime::Jkr:
      return Shape::Jkr;
    case physics::Regime::Maugis:
      return Shape::Maugis;
    default:
      return Shape::Dmt;
  }
}

}  // namespace afm::fits
