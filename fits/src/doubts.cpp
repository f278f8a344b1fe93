// SPDX-License-Identifier: Apache-2.0
#include "doubts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "adhesive_branch.h"

namespace afm::fits {

namespace {

// Tabor's parameter at the borders of law_of_tabor().
constexpr double kMostDmt = 0.1, kLeastJkr = 5.0;

// Greatest force above the baseline.
double greatest_push_n(std::span<const Sample> samples, const ElasticFit& fit) {
  double greatest = 0.0;
  for (const Sample& sample : samples) {
    greatest = std::max(greatest, sample.force_n - baseline_n(fit, sample, samples.front()));
  }
  return greatest;
}

// Samples in a row at the greatest force, and those that a force usually lasts: more than one where a slow curve was
// digitised.
struct Standing {
  double at_greatest = 0, usually = 1;
};
Standing standing_of(std::span<const Sample> samples, double tolerance_n) {
  double greatest_n = samples.front().force_n;
  for (const Sample& sample : samples) greatest_n = std::max(greatest_n, sample.force_n);
  Standing standing;
  std::vector<double> lasts;
  double in_row = 0.0, last = 1.0;
  for (std::size_t t = 0; t < samples.size(); ++t) {
    in_row = samples[t].force_n >= greatest_n - tolerance_n ? in_row + 1.0 : 0.0;
    standing.at_greatest = std::max(standing.at_greatest, in_row);
    if (t == 0 || samples[t].force_n < 0.5 * greatest_n || in_row > 0.0) continue;  // pushed, not at the end
    if (std::abs(samples[t].force_n - samples[t - 1].force_n) <= tolerance_n) {
      last += 1.0;
    } else {
      lasts.push_back(std::exchange(last, 1.0));
    }
  }
  if (lasts.empty()) return standing;
  const auto middle = lasts.begin() + static_cast<std::ptrdiff_t>(lasts.size() / 2);
  std::nth_element(lasts.begin(), middle, lasts.end());
  standing.usually = *middle;
  return standing;
}

// Smallest step between two forces; of a digitised curve that of its converter.
double smallest_step_n(std::span<const Sample> samples) {
  constexpr double kSame = 1e-6;  // share of the range
  std::vector<double> forces;
  for (const Sample& sample : samples) forces.push_back(sample.force_n);
  std::sort(forces.begin(), forces.end());
  const double range_n = forces.back() - forces.front();
  double smallest = range_n;
  for (std::size_t i = 1; i < forces.size(); ++i) {
    const double step = forces[i] - forces[i - 1];
    if (step > kSame * range_n) smallest = std::min(smallest, step);
    if (step > 0.0 && step <= kSame * range_n && forces[i] - forces.front() > kSame * range_n) return 0.0;
  }
  return smallest;
}

class Judge {
 public:
  Judge(std::span<const Sample> samples, const FitSetup& setup, const CurveProblem& problem, const Ended& ended)
      : samples_(samples), setup_(setup), problem_(problem), ended_(ended) {}

  void judge(ElasticFit& fit) {
    // the pull of a tip that sticks depends on the sample, too
    const double push_n = std::max(greatest_push_n(samples_, fit), fit.adhesion ? fit.adhesion->pull_off_n : 0.0);
    const bool pushed = fit.in_contact > 0 && push_n > 0.0 && push_n >= 5.0 * fit.noise_n;
    add(fit, Doubt::NeverPushed, fit.noise_n > 0.0 ? push_n / fit.noise_n : 0.0, 5.0, !pushed);
    const Standing standing = standing_of(samples_, std::max(1e-9 * push_n, 0.5 * fit.noise_n));
    const double longest = std::max(4.0, 5.0 * standing.usually);
    add(fit, Doubt::Saturated, standing.at_greatest, longest, standing.at_greatest > longest);
    const double stiffer = fit.reduced_modulus_pa * push_of(setup_.indenter, fit.depth_m).slope / setup_.spring_n_per_m;
    add(fit, Doubt::LeverTooSoft, stiffer, 20.0, stiffer > 20.0);
    const double factor = fit.modulus_interval_pa.high / fit.modulus_interval_pa.low;
    add(fit, Doubt::Unknown, factor, 10.0, !(factor < 10.0));
    add(fit, Doubt::FewPoints, static_cast<double>(fit.in_contact), 50.0, fit.in_contact < 50);
    const double noise_depth_m = fit.noise_n / setup_.spring_n_per_m;
    add(fit, Doubt::Shallow, fit.depth_m / noise_depth_m, 3.0, fit.depth_m < 3.0 * noise_depth_m);
    if (!fit.adhesion) judge_adhesion(fit, push_n);
    const double strain = layer_strain(setup_.indenter, fit.depth_m);
    add(fit, Doubt::BeyondLayer, strain, 1.0, strain > 1.0);
    if (fit.rms_n > kRounding * push_n) {
      judge_level(fit);
      // steps larger than the noise make runs of their own
      const bool digitised = smallest_step_n(samples_) > fit.noise_n;
      add(fit, Doubt::NotRandom, fit.runs_p, 0.01, fit.runs_p < 0.01 && !digitised);
    }
    const double outside = 1.0 - static_cast<double>(fit.in_contact) / static_cast<double>(fit.points);
    add(fit, Doubt::ShortBaseline, outside, 0.1, outside < 0.1);
    if (fit.adhesion) judge_law(fit);
    for (const Found& found : fit.doubts) {
      const bool fatal = kDoubts.at(static_cast<std::size_t>(found.doubt)).fatal;
      fit.trust = fatal || fit.trust == Trust::No ? Trust::No : Trust::Doubtful;
    }
  }

 private:
  static void add(ElasticFit& fit, Doubt doubt, double figure, double limit, bool found) {
    if (found) fit.doubts.push_back({doubt, figure, limit, std::nullopt});
  }

  // Advises the law of Tabor's parameter, with this modulus and the work of adhesion between those of JKR and DMT.
  void judge_adhesion(ElasticFit& fit, double push_n) const {
    if (!(setup_.pull_off_n > 0.05 * push_n)) return;
    Found found{Doubt::Adhesive, setup_.pull_off_n / push_n, 0.05, std::nullopt};
    const Indenter& indenter = setup_.indenter;
    if (indenter.radius_m > 0.0 && indenter.layer_m == 0.0) {
      const physics::Length radius(indenter.radius_m);
      const physics::SurfaceEnergy work(setup_.pull_off_n / (1.75 * std::numbers::pi * indenter.radius_m));
      found.advised =
          law_of_tabor(tabor_of({radius, physics::Pressure(fit.reduced_modulus_pa), work}, indenter.atomic_distance_m));
    }
    fit.doubts.push_back(found);
  }

  void judge_law(ElasticFit& fit) const {
    const double tabor = fit.adhesion->tabor;
    const Shape law = law_of_tabor(tabor);
    if (law == fit.shape || fit.shape == Shape::Maugis) return;
    fit.doubts.push_back({Doubt::OtherLaw, tabor, fit.shape == Shape::Dmt ? kMostDmt : kLeastJkr, law});
  }

  // The modulus of half the depth, by the same noise; it may differ by three of its standard deviations.
  void judge_level(ElasticFit& fit) {
    std::vector<Sample> shallow;
    std::size_t pushed = 0;
    const std::vector<CurveProblem::Bent> bent = problem_.all_bent(ended_.unknowns);
    for (std::size_t t = 0; t < samples_.size(); ++t) {
      if (bent[t].depth_m > 0.5 * fit.depth_m) continue;
      shallow.push_back(samples_[t]);
      if (bent[t].touches) ++pushed;
    }
    constexpr std::size_t kFewestPushed = 10;
    if (pushed < kFewestPushed || shallow.size() < 2 * kFewest) return;
    const CurveProblem half(shallow, setup_);
    Ended ended{ended_.unknowns, ended_.noise, ended_.filtered, 0.0};
    ended.squares = half.minimise(ended.unknowns, ended.noise);
    if (!is_usable(ended.unknowns, ended.squares)) return;
    fit.half_depth_modulus_pa = std::exp(ended.unknowns[kModulus]) * (fit.modulus_pa / fit.reduced_modulus_pa);
    const double apart = std::abs(ended.unknowns[kModulus] - ended_.unknowns[kModulus]);
    const double deviation = deviation_of(kModulus, half, ended);
    add(fit, Doubt::NotLevel, apart / deviation, 3.0, apart > 3.0 * deviation);
  }

  std::span<const Sample> samples_;
  const FitSetup& setup_;
  const CurveProblem& problem_;
  const Ended& ended_;
};

}  // namespace

const std::array<DoubtRow, 12> kDoubts{{
    {Doubt::NeverPushed, true, "the sample is hardly pushed: greatest push over the noise"},
    {Doubt::Saturated, true, "the greatest force is that of several points: the detector's end"},
    {Doubt::LeverTooSoft, false, "the lever bends instead of the sample: contact stiffness over the lever's"},
    {Doubt::Unknown, true, "the interval spans a large factor"},
    {Doubt::FewPoints, false, "few points in contact"},
    {Doubt::Shallow, false, "depth over that of the noise"},
    {Doubt::Adhesive, false, "the tip sticks, and the shape does not: hardest pull over the greatest push"},
    {Doubt::BeyondLayer, false, "deeper than the layer's formula allows: strain over its limit"},
    {Doubt::NotLevel, false, "the modulus depends on the depth: half the depth differs, in standard deviations"},
    {Doubt::NotRandom, false, "the curve has another shape: probability of the residuals' runs"},
    {Doubt::ShortBaseline, false, "little recorded before contact: share of the points"},
    {Doubt::OtherLaw, false, "Tabor's parameter is that of another law of adhesion"},
}};

std::string_view name_of(Trust trust) {
  switch (trust) {
    case Trust::Trusted:
      return "trusted";
    case Trust::Doubtful:
      return "doubtful";
    case Trust::No:
      break;
  }
  return "no";
}

double baseline_n(const ElasticFit& fit, const Sample& sample, const Sample& first) {
  return fit.level_n + fit.tilt_n_per_m * (sample.z_m - first.z_m);
}

void judge(std::span<const Sample> samples, const FitSetup& setup, const CurveProblem& problem, const Ended& ended,
           ElasticFit& fit) {
  Judge(samples, setup, problem, ended).judge(fit);
}

}  // namespace afm::fits
