// SPDX-License-Identifier: Apache-2.0
#include "curve_problem.h"

#include <algorithm>
#include <cmath>

#include "correlated_noise.h"
#include "least_squares.h"

namespace afm::fits {

CurveProblem::CurveProblem(std::span<const Sample> samples, const FitSetup& setup) : setup_(setup) {
  for (const Sample& sample : samples) {
    z_m_.push_back(sample.z_m);
    force_n_.push_back(sample.force_n);
  }
  origin_m_ = z_m_.front();
}

// Lever and contact in series (F7): d + F(d)/k = z_c - Z, by Newton's method; F is convex, so that it comes from deeper
// from its second step on. Against the tip (F8): d = z_c - (Z + F_measured/k).
CurveProblem::Bent CurveProblem::bent(const Unknowns& unknowns, std::size_t sample) const {
  constexpr int kMostSteps = 60;
  constexpr double kClose = 1e-7;  // the error of a step is the square
  const double modulus_pa = std::exp(unknowns[kModulus]), spring = setup_.spring_n_per_m;
  const double measured_n = force_n_[sample] - setup_.zero_n;
  if (setup_.against == Against::Tip) {
    const double depth_m = unknowns[kContact] - (z_m_[sample] + measured_n / spring);
    const Push push = push_of(setup_.indenter, depth_m);
    return {std::max(depth_m, 0.0), modulus_pa * push.force, modulus_pa * push.force, modulus_pa * push.slope};
  }
  const double way_m = unknowns[kContact] - z_m_[sample];
  if (!(way_m > 0.0)) return {};
  const double level_n = unknowns[kLevel];
  double depth_m = std::clamp(way_m - (force_n_[sample] - level_n) / spring, 0.01 * way_m, way_m);
  Push push;
  for (int step = 0; step < kMostSteps; ++step) {
    push = push_of(setup_.indenter, depth_m);
    const double off_m = depth_m + modulus_pa * push.force / spring - way_m;
    const double next_m = depth_m - off_m / (1.0 + modulus_pa * push.slope / spring);
    const double change_m = next_m - depth_m;
    depth_m = next_m > 0.0 ? std::min(next_m, way_m) : 0.5 * depth_m;
    if (std::abs(change_m) > kClose * depth_m) continue;
    push.force += push.slope * change_m;
    break;
  }
  const double softer = 1.0 / (1.0 + modulus_pa * push.slope / spring);
  return {depth_m, modulus_pa * push.force, modulus_pa * push.force * softer, modulus_pa * push.slope * softer};
}

std::vector<CurveProblem::Bent> CurveProblem::all_bent(const Unknowns& unknowns) const {
  std::vector<Bent> all(size());
  for (std::size_t t = 0; t < size(); ++t) all[t] = bent(unknowns, t);
  return all;
}

void CurveProblem::fill(const Unknowns& unknowns, const std::vector<Bent>& bent, std::span<double> residuals) const {
  for (std::size_t t = 0; t < size(); ++t) {
    const double tilt_n = setup_.tilt ? unknowns[kTilt] * (z_m_[t] - origin_m_) : 0.0;
    residuals[t] = bent[t].force_n + unknowns[kLevel] + tilt_n - force_n_[t];
  }
}

void CurveProblem::fill_jacobian(const std::vector<Bent>& bent, std::span<double> jacobian) const {
  const std::size_t n = size();
  for (std::size_t t = 0; t < n; ++t) {
    jacobian[kModulus * n + t] = bent[t].by_modulus_n;
    jacobian[kContact * n + t] = bent[t].by_contact_n_per_m;
    jacobian[kLevel * n + t] = 1.0;
    if (setup_.tilt) jacobian[kTilt * n + t] = z_m_[t] - origin_m_;
  }
}

std::optional<Unknowns> CurveProblem::start_at(double contact_m) const {
  double level_n = 0.0, outside = 0.0;
  for (std::size_t t = 0; t < size(); ++t) {
    if (z_m_[t] <= contact_m) continue;
    level_n += force_n_[t];
    outside += 1.0;
  }
  level_n = outside > 0.0 ? level_n / outside : *std::min_element(force_n_.begin(), force_n_.end());
  // in the tip's coordinate the force is linear in the modulus
  double above = 0.0, below = 0.0;
  for (std::size_t t = 0; t < size(); ++t) {
    const double force_n = force_n_[t] - level_n;
    const double push = push_of(setup_.indenter, contact_m - (z_m_[t] + force_n / setup_.spring_n_per_m)).force;
    above += push * force_n;
    below += push * push;
  }
  if (!(below > 0.0 && above > 0.0)) {
    // a tip that never comes below the contact point: a lever too soft for this sample
    double deepest_m = contact_m, greatest_n = 0.0;
    for (std::size_t t = 0; t < size(); ++t) {
      deepest_m = std::min(deepest_m, z_m_[t]);
      greatest_n = std::max(greatest_n, force_n_[t] - level_n);
    }
    const double push = push_of(setup_.indenter, 0.1 * (contact_m - deepest_m)).force;
    if (!(push > 0.0 && greatest_n > 0.0)) return std::nullopt;
    above = greatest_n;
    below = push;
  }
  double contact = contact_m;
  if (setup_.against == Against::Tip) contact += (level_n - setup_.zero_n) / setup_.spring_n_per_m;
  Unknowns start{std::log(above / below), contact, level_n};
  if (setup_.tilt) start.push_back(0.0);
  return start;
}

double CurveProblem::minimise(Unknowns& unknowns, std::span<const double> noise, std::optional<double> held) const {
  const std::size_t n = size(), first = held ? 1 : 0, left = n - noise.size();
  if (held) unknowns[kModulus] = *held;
  std::vector<double> columns(n * unknown_count());
  // the solver asks for the Jacobian where it has just asked for the residuals
  Unknowns at;
  std::vector<Bent> bent;
  const auto white = [&](std::span<double> values, std::span<double> to) {
    whiten(noise, values);
    std::copy_n(values.begin(), left, to.begin());
  };
  const Residuals evaluate = [&](std::span<const double> free, std::span<double> residuals,
                                 std::span<double> jacobian) {
    Unknowns now(unknowns);
    std::copy(free.begin(), free.end(), now.begin() + static_cast<std::ptrdiff_t>(first));
    if (now != at) {
      bent = all_bent(now);
      at = now;
    }
    const std::span all(columns);
    if (jacobian.empty()) {
      fill(now, bent, all.first(n));
      return white(all.first(n), residuals);
    }
    fill_jacobian(bent, all);
    for (std::size_t c = first; c < unknown_count(); ++c) {
      white(all.subspan(c * n, n), jacobian.subspan((c - first) * left, left));
    }
  };
  std::vector<double> free(unknowns.begin() + static_cast<std::ptrdiff_t>(first), unknowns.end());
  const double squares = least_squares(evaluate, left, free);
  std::copy(free.begin(), free.end(), unknowns.begin() + static_cast<std::ptrdiff_t>(first));
  return squares;
}

std::vector<double> CurveProblem::residuals(const Unknowns& unknowns) const {
  std::vector<double> residuals(size());
  fill(unknowns, all_bent(unknowns), residuals);
  return residuals;
}

std::vector<double> CurveProblem::jacobian(const Unknowns& unknowns) const {
  std::vector<double> jacobian(size() * unknown_count());
  fill_jacobian(all_bent(unknowns), jacobian);
  return jacobian;
}

double CurveProblem::depth_m(const Unknowns& unknowns, std::size_t sample) const {
  return bent(unknowns, sample).depth_m;
}

double CurveProblem::force_n(const Unknowns& unknowns, std::size_t sample) const {
  const double tilt_n = setup_.tilt ? unknowns[kTilt] * (z_m_[sample] - origin_m_) : 0.0;
  return bent(unknowns, sample).force_n + unknowns[kLevel] + tilt_n;
}

}  // namespace afm::fits
