// SPDX-License-Identifier: Apache-2.0
#include "curve_problem.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adhesive_branch.h"
#include "correlated_noise.h"
#include "least_squares.h"
#include "series.h"

namespace afm::fits {

CurveProblem::CurveProblem(std::span<const Sample> samples, const FitSetup& setup)
    : setup_(setup), is_adhesive_(row_of(setup.indenter.shape).is_adhesive) {
  for (const Sample& sample : samples) {
    z_m_.push_back(sample.z_m);
    force_n_.push_back(sample.force_n);
    sticks_.push_back(sample.sticks);
  }
  origin_m_ = z_m_.front();
}

// In series with the lever, or against the tip (F8): d = z_c - (Z + F_measured/k).
CurveProblem::Bent CurveProblem::bent(const Unknowns& unknowns, double modulus_pa, std::size_t sample) const {
  const double spring = setup_.spring_n_per_m;
  const double measured_n = force_n_[sample] - setup_.zero_n;
  if (setup_.against == Against::Tip) {
    const double depth_m = unknowns[kContact] - (z_m_[sample] + measured_n / spring);
    const Push push = push_of(setup_.indenter, depth_m);
    const double force_n = modulus_pa * push.force;
    return {depth_m > 0.0, std::max(depth_m, 0.0), force_n, force_n, modulus_pa * push.slope, 0.0};
  }
  const double way_m = unknowns[kContact] - z_m_[sample];
  if (!(way_m > 0.0)) return {};
  const double near_m = way_m - (force_n_[sample] - unknowns[kLevel]) / spring;
  const auto [depth_m, push] = in_series(setup_.indenter, modulus_pa, spring, way_m, near_m);
  const double softer = 1.0 / (1.0 + modulus_pa * push.slope / spring);
  const double force_n = modulus_pa * push.force;
  return {true, depth_m, force_n, force_n * softer, modulus_pa * push.slope * softer, 0.0};
}

// The samples that touch are known beforehand, because the law has two forces at one height.
std::vector<CurveProblem::Bent> CurveProblem::all_held(const Unknowns& unknowns) const {
  const Indenter& indenter = setup_.indenter;
  const AdhesiveBranch branch(indenter.shape,
                              {physics::Length(indenter.radius_m), physics::Pressure(std::exp(unknowns[kModulus])),
                               physics::SurfaceEnergy(std::exp(unknowns[work()]))},
                              indenter.atomic_distance_m, setup_.spring_n_per_m);
  std::vector<Bent> all(size());
  double near = branch.fold();
  for (std::size_t t = 0; t < size(); ++t) {
    if (!sticks_[t]) continue;
    const AdhesiveBranch::Held held = branch.at(unknowns[kContact] - z_m_[t], near);
    all[t] = {true, held.depth_m, held.force_n, held.by_modulus_n, held.by_contact_n_per_m, held.by_work_n};
  }
  return all;
}

std::vector<CurveProblem::Bent> CurveProblem::all_bent(const Unknowns& unknowns) const {
  if (is_adhesive_) return all_held(unknowns);
  std::vector<Bent> all(size());
  const double modulus_pa = std::exp(unknowns[kModulus]);
  for (std::size_t t = 0; t < size(); ++t) all[t] = bent(unknowns, modulus_pa, t);
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
    if (is_adhesive_) jacobian[work() * n + t] = bent[t].by_work_n;
  }
}

std::optional<Unknowns> CurveProblem::start_at(double contact_m) const {
  double level_n = 0.0, outside = 0.0;
  for (std::size_t t = 0; t < size(); ++t) {
    if (is_adhesive_ ? sticks_[t] : z_m_[t] <= contact_m) continue;
    level_n += force_n_[t];
    outside += 1.0;
  }
  level_n = outside > 0.0 ? level_n / outside : *std::min_element(force_n_.begin(), force_n_.end());
  // in the tip's coordinate the force is linear in the modulus; adhesion is about that of DMT, added to the load
  const double added_n = is_adhesive_ ? setup_.pull_off_n : 0.0;
  double above = 0.0, below = 0.0;
  for (std::size_t t = 0; t < size(); ++t) {
    const double force_n = force_n_[t] - level_n;
    const double push = push_of(setup_.indenter, contact_m - (z_m_[t] + force_n / setup_.spring_n_per_m)).force;
    above += push * (force_n + added_n);
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
  if (is_adhesive_) {
    // between JKR's 3/2 pi W R and DMT's 2 pi W R
    start.push_back(std::log(setup_.pull_off_n / (1.75 * std::numbers::pi * setup_.indenter.radius_m)));
  }
  return start;
}

double CurveProblem::minimise(Unknowns& unknowns, std::span<const double> noise, std::optional<std::size_t> held,
                              double reduction) const {
  const std::size_t n = size(), left = n - noise.size();
  std::vector<std::size_t> freed;
  for (std::size_t c = 0; c < unknown_count(); ++c) {
    if (c != held) freed.push_back(c);
  }
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
    for (std::size_t c = 0; c < free.size(); ++c) now[freed[c]] = free[c];
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
    for (std::size_t c = 0; c < freed.size(); ++c) {
      white(all.subspan(freed[c] * n, n), jacobian.subspan(c * left, left));
    }
  };
  std::vector<double> free;
  free.reserve(freed.size());
  for (const std::size_t c : freed) free.push_back(unknowns[c]);
  const double squares = least_squares(evaluate, left, free, reduction);
  for (std::size_t c = 0; c < freed.size(); ++c) unknowns[freed[c]] = free[c];
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

}  // namespace afm::fits
