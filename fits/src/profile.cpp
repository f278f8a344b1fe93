// SPDX-License-Identifier: Apache-2.0
#include "profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "correlated_noise.h"

namespace afm::fits {

bool is_usable(const Unknowns& unknowns, double squares) {
  return std::isfinite(squares) && std::isnormal(std::exp(unknowns[kModulus])) &&
         std::all_of(unknowns.begin(), unknowns.end(), [](double value) { return std::isfinite(value); });
}

double deviation_of(std::size_t unknown, const CurveProblem& problem, const Ended& ended) {
  std::vector<double> jacobian = problem.jacobian(ended.unknowns);
  const std::size_t n = problem.size(), count = problem.unknown_count();
  const std::size_t left = n - ended.noise.size();
  for (std::size_t c = 0; c < count; ++c) whiten(ended.noise, std::span(jacobian).subspan(c * n, n));
  for (std::size_t t = 0; t < left; ++t) std::swap(jacobian[t], jacobian[unknown * n + t]);
  // what the other columns leave of the unknown's, now the first, by Gram and Schmidt from the last column
  for (std::size_t c = count - 1; c >= 1; --c) {
    double own = 0.0;
    for (std::size_t t = 0; t < left; ++t) own += jacobian[c * n + t] * jacobian[c * n + t];
    for (std::size_t other = 0; other < c && own > 0.0; ++other) {
      double shared = 0.0;
      for (std::size_t t = 0; t < left; ++t) shared += jacobian[c * n + t] * jacobian[other * n + t];
      for (std::size_t t = 0; t < left; ++t) jacobian[other * n + t] -= shared / own * jacobian[c * n + t];
    }
  }
  double own = 0.0;
  for (std::size_t t = 0; t < left; ++t) own += jacobian[t] * jacobian[t];
  const auto free = static_cast<double>(left - count);
  return own > 0.0 ? std::sqrt(ended.squares / free / own) : std::numeric_limits<double>::infinity();
}

ProfileEnd profile_end(std::size_t unknown, const CurveProblem& problem, const Ended& ended, double deviation,
                       double side) {
  constexpr int kSteps = 16;
  constexpr double kFarthest = 5.0, kClose = 1e-3, kLower = 1e-6;
  const auto none = [side] { return ProfileEnd{side * std::numeric_limits<double>::infinity(), std::nullopt}; };
  const auto free = static_cast<double>(problem.size() - ended.noise.size() - problem.unknown_count());
  const double target = std::sqrt(kChiSquare95);
  struct Place {
    double way, root;
  };
  Place near{0.0, 0.0};
  std::optional<Place> far;
  double way = std::min(target * deviation, kFarthest);
  for (int step = 0; step < kSteps; ++step) {
    Unknowns unknowns(ended.unknowns);
    unknowns[unknown] += side * way;
    const double squares = problem.minimise(unknowns, ended.noise, unknown);
    if (!is_usable(unknowns, squares)) return none();
    if (squares < ended.squares * (1.0 - kLower)) return {none().value, unknowns};
    const Place here{way, std::sqrt(std::max(free * std::log(squares / ended.squares), 0.0))};
    if (here.root < target) {
      near = here;
    } else {
      far = here;
    }
    if (!far && way >= kFarthest) return none();
    const double slope = far ? (far->root - near.root) / (far->way - near.way) : here.root / here.way;
    const double next = slope > 0.0 ? std::min(near.way + (target - near.root) / slope, kFarthest) : kFarthest;
    if (std::abs(next - way) < kClose * way && next < kFarthest) {
      return {ended.unknowns[unknown] + side * next, std::nullopt};
    }
    way = next;
  }
  return far ? ProfileEnd{ended.unknowns[unknown] + side * way, std::nullopt} : none();
}

}  // namespace afm::fits
