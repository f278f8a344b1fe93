// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fits/elastic_fit.h"
#include "gram.h"
#include "least_squares.h"

namespace afm::fits {

// Unknowns of a fit: logarithm of the reduced modulus, contact point, level, tilt with FitSetup::tilt, and of a law of
// adhesion the logarithm of the work of adhesion, the last.
using Unknowns = std::vector<double>;
inline constexpr std::size_t kModulus = 0, kContact = 1, kLevel = 2, kTilt = 3;

// The model at all samples, for one set of unknowns.
struct CurveModel {
  Unknowns unknowns;                // unknowns of the model; empty: not computed yet
  std::vector<double> residual_n;   // model, with its baseline, minus measured force
  std::vector<double> depth_m;      // depths of the tip; 0 where it is free
  std::vector<std::uint8_t> touch;  // flag of each sample, 1: the tip touches
  // derivatives of the force by the unknowns; 0 where the tip is free
  std::vector<double> by_modulus_n, by_contact_n_per_m, by_work_n;
  std::vector<double> near;     // results of the searches for the depths, from which the next ones begin; 0: none yet
  std::size_t first_touch = 0;  // index of the first touching sample; the number of samples if none touches
};

// The curve as a problem of least squares. Lengths are in metres. One thread.
class CurveProblem {
 public:
  CurveProblem(std::span<const Sample> samples, const FitSetup& setup);

  std::size_t size() const { return z_m_.size(); }
  std::size_t unknown_count() const { return 3U + (setup_.tilt ? 1U : 0U) + (is_adhesive_ ? 1U : 0U); }
  bool is_adhesive() const { return is_adhesive_; }
  std::size_t work() const { return unknown_count() - 1; }  // index of the work of adhesion, if there is one

  // Best modulus for this contact point, with the mean of the outer samples as level: the start of a fit. Empty without
  // a push there.
  std::optional<Unknowns> start_at(double contact_m) const;

  // Minimum of the whitened residuals. The unknown `held` stays. Returns the sum of squares. `reduction` as of
  // least_squares().
  double minimise(Unknowns& unknowns, std::span<const double> noise = {}, std::optional<std::size_t> held = {},
                  double reduction = kWholeReduction) const;

  // Model for these unknowns. Valid until the next call with other unknowns; costs nothing with those of the last one.
  const CurveModel& model(const Unknowns& unknowns) const;

  // Products of the whitened columns for these unknowns.
  Gram gram(const Unknowns& unknowns, std::span<const double> noise) const;

  // Model minus measured force, and its derivatives, column by column, not whitened.
  std::vector<double> residuals(const Unknowns& unknowns) const { return model(unknowns).residual_n; }
  std::vector<double> jacobian(const Unknowns& unknowns) const;

 private:
  void press(CurveModel& model) const;
  void press_against_tip(CurveModel& model) const;
  void hold(CurveModel& model) const;

  FitSetup setup_;
  bool is_adhesive_;
  std::vector<double> z_m_, force_n_;
  std::vector<double> way_m_;  // distance of each sample from the first one, for the tilt
  std::vector<bool> sticks_;
  mutable CurveModel last_;  // newest model, because solver and verdict request the same unknowns repeatedly
};

}  // namespace afm::fits
