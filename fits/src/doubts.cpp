// SPDX-License-Identifier: Apache-2.0
#include "doubts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include "adhesive_branch.h"
#include "physics/rows_of_enum.h"

namespace afm::fits {

namespace {

using Side = DoubtRow::Side;

// Largest force above the baseline.
double greatest_push_n(std::span<const Sample> samples, const ElasticFit& fit) {
  double greatest = 0.0;
  for (const Sample& sample : samples) {
    greatest = std::max(greatest, sample.force_n - baseline_n(fit, sample, samples.front()));
  }
  return greatest;
}

// Smallest step between two forces, of a range of forces; of a digitised curve that of its converter. 0 where forces
// differ by their rounding alone.
double smallest_step_n(std::span<const Sample> samples, double range_n) {
  constexpr double kSame = 1e-6;  // equality as a share of the range
  std::vector<double> forces;
  forces.reserve(samples.size());
  for (const Sample& sample : samples) forces.push_back(sample.force_n);
  std::sort(forces.begin(), forces.end());
  double smallest = range_n;
  for (std::size_t i = 1; i < forces.size(); ++i) {
    const double step = forces[i] - forces[i - 1];
    if (step > kSame * range_n) smallest = std::min(smallest, step);
    if (step > 0.0 && step <= kSame * range_n && forces[i] - forces.front() > kSame * range_n) return 0.0;
  }
  return smallest;
}

// Smallest step as above, but any step below `enough_n` suffices: mostly a few samples have one.
double step_n(std::span<const Sample> samples, double enough_n) {
  constexpr std::size_t kFew = 64;
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end(),
                                               [](const Sample& a, const Sample& b) { return a.force_n < b.force_n; });
  const double range_n = high->force_n - low->force_n;
  const double of_few = smallest_step_n(samples.first(std::min(kFew, samples.size())), range_n);
  return of_few < enough_n ? of_few : smallest_step_n(samples, range_n);
}

class Judge {
 public:
  Judge(std::span<const Sample> samples, const FitSetup& setup, const CurveProblem& problem, const Ended& ended)
      : samples_(samples), setup_(setup), problem_(problem), ended_(ended) {}

  void judge(ElasticFit& fit) {
    // the pull of a tip that sticks depends on the sample, too
    const double push_n = std::max(greatest_push_n(samples_, fit), fit.adhesion ? fit.adhesion->pull_off_n : 0.0);
    add(fit, Doubt::NeverPushed, fit.in_contact > 0 && push_n > 0.0 ? push_n / fit.noise_n : 0.0);
    add(fit, Doubt::Saturated, points_at_greatest_force(samples_, std::max(1e-9 * push_n, 0.5 * fit.noise_n)));
    const double contact_n_per_m = fit.reduced_modulus_pa * push_of(setup_.indenter, fit.depth_m).slope;
    add(fit, Doubt::LeverTooSoft, contact_n_per_m / setup_.spring_n_per_m);
    add(fit, Doubt::Unknown, fit.modulus_interval_pa.high / fit.modulus_interval_pa.low);
    add(fit, Doubt::FewPoints, static_cast<double>(fit.in_contact));
    // a force that never changes has neither depth nor noise
    add(fit, Doubt::Shallow, fit.depth_m > 0.0 ? fit.depth_m * setup_.spring_n_per_m / fit.noise_n : 0.0);
    if (!fit.adhesion) judge_adhesion(fit, push_n);
    if (row_of(fit.shape).has_radius) add(fit, Doubt::BeyondTip, fit.depth_m / setup_.indenter.radius_m);
    add(fit, Doubt::BeyondLayer, layer_strain(setup_.indenter, fit.depth_m));
    if (fit.rms_n > kRounding * push_n) judge_residuals(fit);
    add(fit, Doubt::ShortBaseline, 1.0 - static_cast<double>(fit.in_contact) / static_cast<double>(fit.points));
    if (fit.adhesion) {
      judge_pull_off(fit);
      judge_law(fit);
    }
    for (const Found& found : fit.doubts) {
      fit.trust = row_of(found.doubt).fatal || fit.trust == Trust::No ? Trust::No : Trust::Doubtful;
    }
  }

 private:
  // A figure that is not a number is doubtful.
  static void add(ElasticFit& fit, Doubt doubt, double figure, std::optional<Shape> advised = std::nullopt) {
    const DoubtRow& row = row_of(doubt);
    const bool within = row.side == Side::Above ? figure <= row.limit : figure >= row.limit;
    if (!within) fit.doubts.push_back({doubt, figure, advised});
  }

  // Advises the law of Tabor's parameter, with this modulus and the work of adhesion between those of JKR and DMT.
  void judge_adhesion(ElasticFit& fit, double push_n) const {
    const Indenter& indenter = setup_.indenter;
    std::optional<Shape> advised;
    if (setup_.pull_off_n > 0.0 && indenter.radius_m > 0.0 && indenter.layer_m == 0.0) {
      const physics::Length radius(indenter.radius_m);
      const physics::SurfaceEnergy work(setup_.pull_off_n / (1.75 * std::numbers::pi * indenter.radius_m));
      advised =
          law_of_tabor(tabor_of({radius, physics::Pressure(fit.reduced_modulus_pa), work}, indenter.atomic_distance_m));
    }
    add(fit, Doubt::Adhesive, setup_.pull_off_n > 0.0 ? setup_.pull_off_n / push_n : 0.0, advised);
  }

  void judge_law(ElasticFit& fit) const {
    const double tabor = fit.adhesion->tabor;
    if (fit.shape == Shape::Dmt) add(fit, Doubt::BeyondDmt, tabor, law_of_tabor(tabor));
    if (fit.shape == Shape::Jkr) add(fit, Doubt::BelowJkr, tabor, law_of_tabor(tabor));
  }

  // The noise moves the hardest of many pulls, and the place at which a lever lets go.
  void judge_pull_off(ElasticFit& fit) const {
    constexpr double kMoved = 4.0;  // allowed shift in standard deviations
    const double moved_n = kMoved * fit.noise_n, moved_m = moved_n / setup_.spring_n_per_m;
    const double off_n = std::abs(fit.adhesion->pull_off_n - setup_.pull_off_n);
    add(fit, Doubt::PullOffForce, std::max(off_n - moved_n, 0.0) / setup_.pull_off_n);
    if (!setup_.pull_off_z_m) return;
    const double off_m = std::abs(fit.adhesion->pull_off_z_m - *setup_.pull_off_z_m);
    const double way_m = std::abs(fit.adhesion->pull_off_z_m - fit.contact_z_m);
    add(fit, Doubt::PullOffPlace, std::max(off_m - moved_m, 0.0) / way_m);
  }

  void judge_residuals(ElasticFit& fit) {
    judge_level(fit);
    const double digit_n = step_n(samples_, fit.noise_n);
    // steps larger than the noise make runs of their own
    if (digit_n <= fit.noise_n) add(fit, Doubt::NotRandom, fit.runs_p);
    const double rounding_n = digit_n / std::sqrt(12.0);
    add(fit, Doubt::Misfit, fit.rms_n / std::max(most_noise_n(fit), rounding_n));
  }

  // Noise before contact, three standard deviations of its estimate larger: points that are correlated by rho from one
  // to the next count as (1 - rho^2)/(1 + rho^2) independent ones.
  double most_noise_n(const ElasticFit& fit) const {
    constexpr double kChance = 3.0, kMostCorrelated = 0.999;
    const CurveModel& model = problem_.model(ended_.unknowns);
    std::vector<double> free;
    free.reserve(model.touch.size());
    for (std::size_t t = 0; t < model.touch.size(); ++t) {
      if (model.touch[t] == 0) free.push_back(model.residual_n[t]);
    }
    if (free.size() < kFewest || !(fit.noise_n > 0.0)) return fit.noise_n;
    const double squares = std::inner_product(free.begin(), free.end(), free.begin(), 0.0);
    const double products = std::inner_product(free.begin() + 1, free.end(), free.begin(), 0.0);
    const double rho = std::clamp(products / squares, 0.0, kMostCorrelated);
    const double independent = static_cast<double>(free.size()) * (1.0 - rho * rho) / (1.0 + rho * rho);
    return fit.noise_n * (1.0 + kChance / std::sqrt(2.0 * independent));
  }

  // The modulus of half the depth, by the same noise; it may differ by three of its standard deviations.
  void judge_level(ElasticFit& fit) {
    std::vector<Sample> shallow;
    shallow.reserve(samples_.size());
    std::size_t pushed = 0;
    const CurveModel& model = problem_.model(ended_.unknowns);
    for (std::size_t t = 0; t < samples_.size(); ++t) {
      if (model.depth_m[t] > 0.5 * fit.depth_m) continue;
      shallow.push_back(samples_[t]);
      if (model.touch[t] != 0) ++pushed;
    }
    constexpr std::size_t kFewestPushed = 10;
    if (pushed < kFewestPushed || shallow.size() < 2 * kFewest) return;
    const CurveProblem half(shallow, setup_);
    Ended ended{ended_.unknowns, ended_.noise, ended_.filtered, 0.0};
    ended.squares = half.minimise(ended.unknowns, ended.noise);
    if (!is_usable(ended.unknowns, ended.squares)) return;
    fit.half_depth_modulus_pa = std::exp(ended.unknowns[kModulus]) * (fit.modulus_pa / fit.reduced_modulus_pa);
    const double apart = std::abs(ended.unknowns[kModulus] - ended_.unknowns[kModulus]);
    add(fit, Doubt::NotLevel, apart / deviation_of(kModulus, half, ended));
  }

  std::span<const Sample> samples_;
  const FitSetup& setup_;
  const CurveProblem& problem_;
  const Ended& ended_;
};

}  // namespace

constexpr std::array<DoubtRow, 17> kDoubts{{
    {Doubt::NeverPushed, true, Side::Below, 5.0, "the sample is hardly pushed: greatest push over the noise"},
    {Doubt::Saturated, true, Side::Above, 5.0,
     "the greatest force stays constant, as at a detector's limit: its points over those of a usual force"},
    {Doubt::LeverTooSoft, false, Side::Above, 20.0,
     "the lever bends instead of the sample: contact stiffness over the lever's"},
    {Doubt::Unknown, true, Side::Above, 10.0, "the interval spans a large factor"},
    {Doubt::FewPoints, false, Side::Below, 50.0, "few points in contact"},
    {Doubt::Shallow, false, Side::Below, 3.0, "depth over that of the noise"},
    {Doubt::Adhesive, false, Side::Above, 0.05,
     "the tip sticks, but the shape has no adhesion: hardest pull over the greatest push"},
    {Doubt::BeyondTip, false, Side::Above, 1.0, "deeper than the tip is round: depth over its radius"},
    {Doubt::BeyondLayer, false, Side::Above, 1.0, "deeper than the layer's formula allows: strain over its limit"},
    {Doubt::NotLevel, false, Side::Above, 3.0,
     "the modulus depends on the depth: half the depth differs, in standard deviations"},
    {Doubt::NotRandom, false, Side::Below, 0.01, "the curve has another shape: probability of the residuals' runs"},
    {Doubt::Misfit, false, Side::Above, 1.5,
     "the model leaves the curve: rms of residuals over the largest likely noise"},
    {Doubt::ShortBaseline, false, Side::Below, 0.1, "little recorded before contact: share of the points"},
    {Doubt::PullOffForce, false, Side::Above, 0.2,
     "the model pulls off with another force: difference over the recorded one"},
    {Doubt::PullOffPlace, false, Side::Above, 0.25,
     "the model pulls off at another place: difference over its distance from the contact point"},
    {Doubt::BeyondDmt, false, Side::Above, 0.1, "Tabor's parameter is above that of DMT"},
    {Doubt::BelowJkr, false, Side::Below, 5.0, "Tabor's parameter is below that of JKR"},
}};
static_assert(physics::has_row_for_each(kDoubts, &DoubtRow::doubt));

namespace {

// The run in which a middle one of all points lies: between two digits there are many short ones.
double run_of_middle_point(std::vector<double> runs) {
  std::sort(runs.begin(), runs.end());
  const double half = 0.5 * std::accumulate(runs.begin(), runs.end(), 0.0);
  double points = 0.0;
  return *std::find_if(runs.begin(), runs.end(), [&](double run) { return (points += run) >= half; });
}

// Half of a usual change of the force from one point to the next, magnitude.
double half_a_step_n(std::span<const Sample> samples) {
  if (samples.size() < 2) return 0.0;
  std::vector<double> steps(samples.size() - 1);
  std::transform(samples.begin() + 1, samples.end(), samples.begin(), steps.begin(),
                 [](const Sample& here, const Sample& before) { return std::abs(here.force_n - before.force_n); });
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return 0.5 * *middle;
}

}  // namespace

// A usual force lasts more than one point where a slow curve was digitised.
double points_at_greatest_force(std::span<const Sample> samples, double tolerance_n) {
  double greatest_n = samples.front().force_n;
  for (const Sample& sample : samples) greatest_n = std::max(greatest_n, sample.force_n);
  // a noise that a bad fit has found is no measure of what is equal
  const double equal_n = std::max(1e-9 * greatest_n, std::min(tolerance_n, half_a_step_n(samples)));
  std::vector<double> runs;  // numbers of successive points at a pushing force below the largest
  double at_greatest = 0.0, in_row = 0.0, run = 0.0;
  for (std::size_t t = 0; t < samples.size(); ++t) {
    in_row = samples[t].force_n >= greatest_n - equal_n ? in_row + 1.0 : 0.0;
    at_greatest = std::max(at_greatest, in_row);
    const bool pushed = samples[t].force_n >= 0.5 * greatest_n && in_row == 0.0;
    if (pushed && run > 0.0 && std::abs(samples[t].force_n - samples[t - 1].force_n) <= equal_n) {
      run += 1.0;
      continue;
    }
    if (run > 0.0) runs.push_back(run);
    run = pushed ? 1.0 : 0.0;
  }
  if (run > 0.0) runs.push_back(run);
  return runs.empty() ? at_greatest : at_greatest / run_of_middle_point(runs);
}

const DoubtRow& row_of(Doubt doubt) { return kDoubts.at(static_cast<std::size_t>(doubt)); }

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
