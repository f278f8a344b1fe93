// SPDX-License-Identifier: Apache-2.0
#include "profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "gram.h"

namespace afm::fits {

namespace {

constexpr double kFarthestWay = 5.0;  // limit of the change of a logarithm up to the end
constexpr double kCloseWay = 1e-3;    // tolerance as a share of the way

double free_of(const CurveProblem& problem, const Ended& ended) {
  return static_cast<double>(problem.size() - ended.noise.size() - problem.unknown_count());
}

// True if the sum of squares is lower than the fit's, which was no minimum.
bool is_lower(double squares, const Ended& ended) {
  constexpr double kLower = 1e-6;
  return squares < ended.squares * (1.0 - kLower);
}

}  // namespace

bool is_usable(const Unknowns& unknowns, double squares) {
  return std::isfinite(squares) && std::isnormal(std::exp(unknowns[kModulus])) &&
         std::all_of(unknowns.begin(), unknowns.end(), [](double value) { return std::isfinite(value); });
}

double deviation_of(std::size_t unknown, const CurveProblem& problem, const Ended& ended) {
  const double own = problem.gram(ended.unknowns, ended.noise).own(unknown);
  const double free = free_of(problem, ended);
  return own > 0.0 ? std::sqrt(ended.squares / free / own) : std::numeric_limits<double>::infinity();
}

namespace {

ProfileEnd no_end(double side) { return {side * std::numeric_limits<double>::infinity(), std::nullopt}; }

// All unknowns at once step to where the curve, linearised, has the end (Venzon & Moolgavkar 1988): two or three
// evaluations instead of as many fits. Empty if the steps do not close in.
std::optional<ProfileEnd> stepped_end(std::size_t unknown, const CurveProblem& problem, const Ended& ended,
                                      double side) {
  constexpr int kSteps = 8;
  const double target = ended.squares * std::exp(kChiSquare95 / free_of(problem, ended));
  Unknowns at(ended.unknowns);
  for (int step = 0; step < kSteps; ++step) {
    const Gram gram = problem.gram(at, ended.noise);
    if (step > 0 && is_lower(gram.squares(), ended)) return ProfileEnd{no_end(side).value, at};
    const auto change = gram.step_to(target, unknown, side);
    if (!change) return std::nullopt;
    for (std::size_t c = 0; c < at.size(); ++c) at[c] += (*change)[c];
    const double way = side * (at[unknown] - ended.unknowns[unknown]);
    if (!(way > 0.0 && way < kFarthestWay)) return std::nullopt;
    if (step > 0 && std::abs((*change)[unknown]) < kCloseWay * way) return ProfileEnd{at[unknown], std::nullopt};
  }
  return std::nullopt;
}

// The root of the fall is nearly linear in the way, and is stepped to along that line, once there is an end on either
// side between them.
ProfileEnd searched_end(std::size_t unknown, const CurveProblem& problem, const Ended& ended, double deviation,
                        double side) {
  constexpr int kSteps = 16;
  const double free = free_of(problem, ended), target = std::sqrt(kChiSquare95);
  struct Place {
    double way, root;
  };
  Place near{0.0, 0.0};
  std::optional<Place> far;
  double way = std::min(target * deviation, kFarthestWay);
  for (int step = 0; step < kSteps; ++step) {
    Unknowns unknowns(ended.unknowns);
    unknowns[unknown] += side * way;
    const double squares = problem.minimise(unknowns, ended.noise, unknown);
    if (!is_usable(unknowns, squares)) return no_end(side);
    if (is_lower(squares, ended)) return {no_end(side).value, unknowns};
    const Place here{way, std::sqrt(std::max(free * std::log(squares / ended.squares), 0.0))};
    if (here.root < target) {
      near = here;
    } else {
      far = here;
    }
    if (!far && way >= kFarthestWay) return no_end(side);
    const double slope = far ? (far->root - near.root) / (far->way - near.way) : here.root / here.way;
    const double next = slope > 0.0 ? std::min(near.way + (target - near.root) / slope, kFarthestWay) : kFarthestWay;
    if (std::abs(next - way) < kCloseWay * way && next < kFarthestWay) {
      return {ended.unknowns[unknown] + side * next, std::nullopt};
    }
    way = next;
  }
  return far ? ProfileEnd{ended.unknowns[unknown] + side * way, std::nullopt} : no_end(side);
}

}  // namespace

ProfileEnd profile_end(std::size_t unknown, const CurveProblem& problem, const Ended& ended, double deviation,
                       double side) {
  const auto stepped = stepped_end(unknown, problem, ended, side);
  return stepped ? *stepped : searched_end(unknown, problem, ended, deviation, side);
}

}  // namespace afm::fits
