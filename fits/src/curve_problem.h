// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fits/elastic_fit.h"
#include "least_squares.h"

namespace afm::fits {

// Unknowns of a fit: logarithm of the reduced modulus, contact point, level, tilt with FitSetup::tilt, and of a law of
// adhesion the logarithm of the work of adhesion, the last.
using Unknowns = std::vector<double>;
inline constexpr std::size_t kModulus = 0, kContact = 1, kLevel = 2, kTilt = 3;

// The curve as a problem of least squares. Lengths are in metres.
class CurveProblem {
 public:
  CurveProblem(std::span<const Sample> samples, const FitSetup& setup);

  std::size_t size() const { return z_m_.size(); }
  std::size_t unknown_count() const { return 3U + (setup_.tilt ? 1U : 0U) + (is_adhesive_ ? 1U : 0U); }
  bool is_adhesive() const { return is_adhesive_; }
  std::size_t work() const { return unknown_count() - 1; }  // place of the work of adhesion, if there is one

  // Best modulus for this contact point, the mean of the outer samples as level: where a fit begins. Empty if nothing
  // pushes there.
  std::optional<Unknowns> start_at(double contact_m) const;

  // Minimum of the whitened residuals. The unknown `held` stays. Returns the sum of squares. `reduction` as of
  // least_squares().
  double minimise(Unknowns& unknowns, std::span<const double> noise = {}, std::optional<std::size_t> held = {},
                  double reduction = kWholeReduction) const;

  // Model less measured, and its derivatives, column by column; without noise's whitening.
  std::vector<double> residuals(const Unknowns& unknowns) const;
  std::vector<double> jacobian(const Unknowns& unknowns) const;

  // Model at one sample.
  struct Bent {
    bool touches = false;
    double depth_m = 0, force_n = 0;  // without the baseline
    double by_modulus_n = 0;          // derivative by the logarithm of the modulus
    double by_contact_n_per_m = 0;    // derivative by the contact point
    double by_work_n = 0;             // derivative by the logarithm of the work of adhesion
  };
  std::vector<Bent> all_bent(const Unknowns& unknowns) const;

 private:
  Bent bent(const Unknowns& unknowns, double modulus_pa, std::size_t sample) const;
  std::vector<Bent> all_held(const Unknowns& unknowns) const;
  void fill(const Unknowns& unknowns, const std::vector<Bent>& bent, std::span<double> residuals) const;
  void fill_jacobian(const std::vector<Bent>& bent, std::span<double> jacobian) const;

  FitSetup setup_;
  bool is_adhesive_;
  std::vector<double> z_m_, force_n_;
  std::vector<bool> sticks_;
  double origin_m_;  // place where the tilt is zero
};

}  // namespace afm::fits
