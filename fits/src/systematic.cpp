// SPDX-License-Identifier: Apache-2.0
#include "systematic.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "curve_problem.h"
#include "profile.h"

namespace afm::fits {

namespace {

// Logarithms of Young's modulus and of the work of adhesion.
struct Results {
  double modulus = 0, work = 0;
};

std::optional<Results> fit_again(const std::vector<Sample>& samples, const FitSetup& setup, const ElasticFit& before) {
  const CurveProblem problem(samples, setup);
  Unknowns unknowns{std::log(before.reduced_modulus_pa), before.contact_z_m, before.level_n};
  if (setup.tilt) unknowns.push_back(before.tilt_n_per_m);
  if (before.adhesion) unknowns.push_back(std::log(before.adhesion->work_j_per_m2));
  const double squares = problem.minimise(unknowns, before.noise);
  if (!is_usable(unknowns, squares)) return std::nullopt;
  return Results{unknowns[kModulus] + std::log1p(-setup.poisson * setup.poisson),
                 before.adhesion ? unknowns[problem.work()] : 0.0};
}

// Multiplies an input by `factor`, in samples and set-up.
void change(Given given, double factor, std::vector<Sample>& samples, FitSetup& setup) {
  double force_factor = 1.0;
  Indenter& indenter = setup.indenter;
  switch (given) {
    case Given::SpringConstant:
      force_factor = factor;
      setup.spring_n_per_m *= factor;
      break;
    case Given::Sensitivity:
      // F = k s V with k ~ 1/s^2 (Butt & Jaschke 1995)
      force_factor = 1.0 / factor;
      setup.spring_n_per_m /= factor * factor;
      break;
    case Given::Radius:
      indenter.radius_m *= factor;
      break;
    case Given::HalfAngle:
      indenter.half_angle_rad *= factor;
      break;
    case Given::Layer:
      indenter.layer_m *= factor;
      break;
    case Given::Poisson:
      setup.poisson *= factor;
      if (indenter.table) indenter.table = exact_table(indenter.shape, indenter.base, setup.poisson);
      break;
  }
  setup.zero_n *= force_factor;
  setup.pull_off_n *= force_factor;
  for (Sample& sample : samples) sample.force_n *= force_factor;
}

}  // namespace

std::vector<Systematic> systematic_of(std::span<const Sample> samples, const FitSetup& setup, const ElasticFit& fit) {
  constexpr double kStep = 5e-3, kMostPoisson = 0.5;
  std::vector<Systematic> all;
  for (const Uncertainty& uncertainty : setup.uncertainties) {
    const bool at_end = uncertainty.of == Given::Poisson && setup.poisson * (1.0 + kStep) > kMostPoisson;
    const std::array factors{1.0 - kStep, at_end ? 1.0 : 1.0 + kStep};
    std::array<Results, 2> results{};
    bool usable = true;
    for (std::size_t i = 0; i < factors.size(); ++i) {
      std::vector<Sample> changed(samples.begin(), samples.end());
      FitSetup other(setup);
      other.indenter.shape = fit.shape;
      change(uncertainty.of, factors[i], changed, other);
      const auto again = fit_again(changed, other, fit);
      usable = usable && again;
      results[i] = again.value_or(Results{});
    }
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    const auto share = [&](double Results::* result) {
      return usable ? error_share(uncertainty.share, factors, {results[0].*result, results[1].*result}) : unknown;
    };
    all.push_back({uncertainty, share(&Results::modulus), share(&Results::work)});
  }
  return all;
}

}  // namespace afm::fits
