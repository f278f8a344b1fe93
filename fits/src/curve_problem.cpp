// SPDX-License-Identifier: Apache-2.0
#include "curve_problem.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "adhesive_branch.h"
#include "least_squares.h"
#include "series.h"

namespace afm::fits {

CurveProblem::CurveProblem(std::span<const Sample> samples, const FitSetup& setup)
    : setup_(setup), is_adhesive_(row_of(setup.indenter.shape).is_adhesive) {
  z_m_.reserve(samples.size());
  force_n_.reserve(samples.size());
  way_m_.reserve(samples.size());
  sticks_.reserve(samples.size());
  for (const Sample& sample : samples) {
    z_m_.push_back(sample.z_m);
    force_n_.push_back(sample.force_n);
    way_m_.push_back(sample.z_m - samples.front().z_m);
    sticks_.push_back(sample.sticks);
  }
}

// Presses in series with the lever, some samples at once. Arrays are reached by pointers: a check of each index would
// cost as much as the arithmetic.
void CurveProblem::press(CurveModel& model) const {
  constexpr std::size_t kAtOnce = PressedLever::kAtOnce;
  const double spring = setup_.spring_n_per_m, contact_m = model.unknowns[kContact], level_n = model.unknowns[kLevel];
  const PressedLever lever(setup_.indenter, std::exp(model.unknowns[kModulus]), spring);
  double* const near = model.near.data();
  std::array<std::size_t, kAtOnce> sample{};
  alignas(PressedLever::Four) std::array<double, kAtOnce> way{}, start{};
  PressedLever::Four way_m{}, root{};
  PressedLever::Pressed pressed;
  const auto press_first = [&, depth_m = model.depth_m.data(), residual_n = model.residual_n.data(),
                            by_modulus_n = model.by_modulus_n.data(), by_contact = model.by_contact_n_per_m.data(),
                            touch = model.touch.data()](std::size_t count) {
    unrolled<2>([&](auto k) {
      way_m[k] = two_at(way.data() + 2 * k);
      root[k] = two_at(start.data() + 2 * k);
    });
    lever.at(way_m, root, pressed);
    unrolled<2>([&](auto k) {
      const Two softer = 1.0 / (1.0 + pressed.slope_n_per_m[k] / spring);
      const Two by_modulus = pressed.force_n[k] * softer, slope = pressed.slope_n_per_m[k] * softer;
      for (std::size_t i = 2 * k; i < std::min<std::size_t>(count, 2 * k + 2); ++i) {
        const std::size_t t = sample[i];
        const int of_pair = i == 2 * k ? 0 : 1;
        depth_m[t] = pressed.depth_m[k][of_pair];
        residual_n[t] += pressed.force_n[k][of_pair];
        by_modulus_n[t] = by_modulus[of_pair];
        by_contact[t] = slope[of_pair];
        near[t] = root[k][of_pair];
        touch[t] = 1;
      }
    });
  };
  const double* const z_m = z_m_.data();
  const double* const measured_n = force_n_.data();
  std::size_t waiting = 0;
  for (std::size_t t = 0; t < size(); ++t) {
    const double to_contact_m = contact_m - z_m[t];
    if (!(to_contact_m > 0.0)) continue;
    // at first from the depth that was measured
    constexpr double kLeast = 0.01;  // smallest start as a share of the way
    sample[waiting] = t;
    way[waiting] = to_contact_m;
    start[waiting] = near[t] > 0.0 ? near[t]
                                   : std::sqrt(std::clamp(to_contact_m - (measured_n[t] - level_n) / spring,
                                                          kLeast * to_contact_m, to_contact_m));
    if (++waiting < kAtOnce) continue;
    press_first(kAtOnce);
    waiting = 0;
  }
  if (waiting == 0) return;
  // the last ones again in the places that are left
  for (std::size_t i = waiting; i < kAtOnce; ++i) {
    way[i] = way[waiting - 1];
    start[i] = start[waiting - 1];
  }
  press_first(waiting);
}

// F8: d = z_c - (Z + F_measured/k)
void CurveProblem::press_against_tip(CurveModel& model) const {
  const double modulus_pa = std::exp(model.unknowns[kModulus]);
  for (std::size_t t = 0; t < size(); ++t) {
    const double tip_m = z_m_[t] + (force_n_[t] - setup_.zero_n) / setup_.spring_n_per_m;
    const double depth_m = model.unknowns[kContact] - tip_m;
    if (!(depth_m > 0.0)) continue;
    const Push push = push_of(setup_.indenter, depth_m);
    model.depth_m[t] = depth_m;
    model.by_modulus_n[t] = modulus_pa * push.force;
    model.residual_n[t] += model.by_modulus_n[t];
    model.by_contact_n_per_m[t] = modulus_pa * push.slope;
    model.touch[t] = 1;
  }
}

// The samples that touch are known beforehand, because the law has two forces at one height.
void CurveProblem::hold(CurveModel& model) const {
  const Indenter& indenter = setup_.indenter;
  const Unknowns& unknowns = model.unknowns;
  const AdhesiveBranch branch(indenter.shape,
                              {physics::Length(indenter.radius_m), physics::Pressure(std::exp(unknowns[kModulus])),
                               physics::SurfaceEnergy(std::exp(unknowns[work()]))},
                              indenter.atomic_distance_m, setup_.spring_n_per_m);
  double near = branch.fold();
  for (std::size_t t = 0; t < size(); ++t) {
    if (!sticks_[t]) continue;
    const AdhesiveBranch::Held held = branch.at(unknowns[kContact] - z_m_[t], near);
    model.depth_m[t] = held.depth_m;
    model.residual_n[t] += held.force_n;
    model.by_modulus_n[t] = held.by_modulus_n;
    model.by_contact_n_per_m[t] = held.by_contact_n_per_m;
    model.by_work_n[t] = held.by_work_n;
    model.touch[t] = 1;
  }
}

const CurveModel& CurveProblem::model(const Unknowns& unknowns) const {
  CurveModel& model = last_;
  if (unknowns == model.unknowns) return model;
  const std::size_t n = size();
  model.near.resize(n, 0.0);
  model.residual_n.resize(n);
  // before its first touch the last model has written nothing
  const auto changed = static_cast<std::ptrdiff_t>(model.first_touch);
  const auto clear = [&](auto& column) {
    column.resize(n);
    std::fill(column.begin() + changed, column.end(), 0);
  };
  for (std::vector<double>* const column : {&model.depth_m, &model.by_modulus_n, &model.by_contact_n_per_m}) {
    clear(*column);
  }
  if (is_adhesive_) clear(model.by_work_n);
  clear(model.touch);
  model.unknowns = unknowns;
  const double level_n = unknowns[kLevel], tilt = setup_.tilt ? unknowns[kTilt] : 0.0;
  for (std::size_t t = 0; t < n; ++t) model.residual_n[t] = level_n + tilt * way_m_[t] - force_n_[t];
  if (is_adhesive_) {
    hold(model);
  } else if (setup_.against == Against::Tip) {
    press_against_tip(model);
  } else {
    press(model);
  }
  const auto first = std::find(model.touch.begin(), model.touch.end(), 1);
  model.first_touch = static_cast<std::size_t>(first - model.touch.begin());
  return model;
}

Gram CurveProblem::gram(const Unknowns& unknowns, std::span<const double> noise) const {
  const CurveModel& here = model(unknowns);
  Columns columns;
  const auto add = [&](const std::vector<double>& values, std::size_t unknown) {
    columns.values[columns.count] = values.data();
    columns.unknowns[columns.count++] = unknown;
  };
  add(here.residual_n, unknown_count());
  if (setup_.tilt) add(way_m_, kTilt);
  columns.dense = columns.count;
  add(here.by_modulus_n, kModulus);
  add(here.by_contact_n_per_m, kContact);
  if (is_adhesive_) add(here.by_work_n, work());
  columns.late = here.first_touch;
  columns.size = size();
  columns.level = kLevel;
  return {columns, noise};
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

// The solver sees as few residuals as unknowns, with the same sums: each of its steps is that of the whole curve.
double CurveProblem::minimise(Unknowns& unknowns, std::span<const double> noise, std::optional<std::size_t> held,
                              double reduction) const {
  std::vector<std::size_t> freed;
  std::vector<double> free;
  freed.reserve(unknown_count());
  free.reserve(unknown_count());
  for (std::size_t c = 0; c < unknown_count(); ++c) {
    if (c == held) continue;
    freed.push_back(c);
    free.push_back(unknowns[c]);
  }
  if (size() < noise.size() + freed.size()) return std::numeric_limits<double>::quiet_NaN();
  // the solver asks for the Jacobian where it has just asked for the residuals
  Unknowns now(unknowns);
  std::optional<Gram::Few> few;
  const Residuals evaluate = [&](std::span<const double> values, std::span<double> residuals,
                                 std::span<double> jacobian) {
    bool same = few.has_value();
    for (std::size_t c = 0; c < values.size(); ++c) {
      same = same && now[freed[c]] == values[c];
      now[freed[c]] = values[c];
    }
    if (!same) few = gram(now, noise).few(held);
    if (jacobian.empty()) {
      std::copy_n(few->residuals.begin(), residuals.size(), residuals.begin());
    } else {
      std::copy_n(few->jacobian.begin(), jacobian.size(), jacobian.begin());
    }
  };
  const double squares = least_squares(evaluate, freed.size() + 1, free, reduction);
  for (std::size_t c = 0; c < freed.size(); ++c) unknowns[freed[c]] = free[c];
  return squares;
}

std::vector<double> CurveProblem::jacobian(const Unknowns& unknowns) const {
  const CurveModel& here = model(unknowns);
  const auto n = static_cast<std::ptrdiff_t>(size());
  std::vector<double> jacobian(size() * unknown_count(), 1.0);
  const auto fill = [&](std::size_t unknown, const std::vector<double>& column) {
    std::copy(column.begin(), column.end(), jacobian.begin() + static_cast<std::ptrdiff_t>(unknown) * n);
  };
  fill(kModulus, here.by_modulus_n);
  fill(kContact, here.by_contact_n_per_m);
  if (setup_.tilt) fill(kTilt, way_m_);
  if (is_adhesive_) fill(work(), here.by_work_n);
  return jacobian;
}

}  // namespace afm::fits
