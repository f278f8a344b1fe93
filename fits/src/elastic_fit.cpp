// SPDX-License-Identifier: Apache-2.0
#include "fits/elastic_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "adhesive_branch.h"
#include "bootstrap.h"
#include "correlated_noise.h"
#include "curve_problem.h"
#include "doubts.h"
#include "profile.h"
#include "systematic.h"

namespace afm::fits {

namespace {

struct Span {
  double low = 0, high = 0;
};
Span heights_of(std::span<const Sample> samples) {
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end(),
                                               [](const Sample& a, const Sample& b) { return a.z_m < b.z_m; });
  return {low->z_m, high->z_m};
}

// Means of neighbours, so that the search for the best start costs little.
std::vector<Sample> thinned(std::span<const Sample> samples) {
  constexpr std::size_t kLeft = 256;
  if (samples.size() <= 2 * kLeft) return {samples.begin(), samples.end()};
  std::vector<Sample> means;
  for (std::size_t i = 0; i < kLeft; ++i) {
    const std::size_t begin = i * samples.size() / kLeft, end = (i + 1) * samples.size() / kLeft;
    Sample mean{0.0, 0.0, samples[begin].sticks};
    if (samples[end - 1].sticks != mean.sticks) continue;
    for (std::size_t t = begin; t < end; ++t) {
      mean.z_m += samples[t].z_m / static_cast<double>(end - begin);
      mean.force_n += samples[t].force_n / static_cast<double>(end - begin);
    }
    means.push_back(mean);
  }
  return means;
}

double force_range_n(std::span<const Sample> samples) {
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end(),
                                               [](const Sample& a, const Sample& b) { return a.force_n < b.force_n; });
  return high->force_n - low->force_n;
}

// Contact points of the analysis and three more; of some close to each other the first, since all lead to one minimum.
std::vector<double> starts_between(double low_m, double high_m, const std::vector<double>& given) {
  constexpr double kSame = 1.0 / 40.0;  // smallest distance of two starts, as a share of the way
  std::vector<double> starts;
  starts.reserve(given.size() + 3);
  const auto add = [&](double start) {
    const auto same = [&](double other) { return std::abs(other - start) < kSame * (high_m - low_m); };
    if (std::none_of(starts.begin(), starts.end(), same)) starts.push_back(start);
  };
  for (const double start : given) add(start);
  for (const double share : {0.25, 0.5, 0.75}) add(std::lerp(low_m, high_m, share));
  return starts;
}

// True if neighbours differ as in white noise, by twice their squares (von Neumann 1941): no curve is left in them.
bool are_random(const std::vector<double>& residuals) {
  constexpr double kLeast = 1.5;
  double squares = 0.0, differences = 0.0;
  for (std::size_t t = 1; t < residuals.size(); ++t) {
    squares += residuals[t] * residuals[t];
    differences += (residuals[t] - residuals[t - 1]) * (residuals[t] - residuals[t - 1]);
  }
  return differences > kLeast * squares;
}

std::optional<Unknowns> best_start(std::span<const Sample> samples, const FitSetup& setup) {
  const std::vector<Sample> few = thinned(samples);
  const CurveProblem problem(few, setup);
  const auto [low_m, high_m] = heights_of(few);
  const std::vector<double> starts = starts_between(low_m, high_m, setup.starts);
  struct Start {
    double squares;
    Unknowns unknowns;
  };
  std::vector<Start> tried;
  tried.reserve(starts.size());
  for (const double start : starts) {
    auto unknowns = problem.start_at(start);
    if (!unknowns) continue;
    const double squares = problem.gram(*unknowns, {}).squares();
    tried.push_back({std::isfinite(squares) ? squares : std::numeric_limits<double>::max(), std::move(*unknowns)});
  }
  std::sort(tried.begin(), tried.end(), [](const Start& a, const Start& b) { return a.squares < b.squares; });
  std::optional<Unknowns> best;
  double least = std::numeric_limits<double>::infinity();
  bool is_noise = false;
  for (Start& start : tried) {
    // one that begins far above noise will not end below it
    constexpr double kFarAbove = 10.0;
    if (is_noise && start.squares > kFarAbove * least) break;
    // the fit to all samples goes on from there
    constexpr double kRough = 1e-4;
    const double squares = problem.minimise(start.unknowns, {}, {}, kRough);
    if (!is_usable(start.unknowns, squares) || !(squares < least)) continue;
    least = squares;
    best = std::move(start.unknowns);
    is_noise = are_random(problem.residuals(*best));
  }
  return best;
}

double squares_of(const std::vector<double>& residuals) {
  return std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
}

// White first, then with the noise that is left, until its coefficients stay. Where another shape was pressed in, the
// residuals are no noise: a filter that takes them for it lets the model leave the curve, and is not used.
Ended minimum(const CurveProblem& problem, const Unknowns& start, bool white) {
  const int rounds = white ? 0 : 3;
  Ended white_noise{start, {}, false, 0.0};
  white_noise.squares = problem.minimise(white_noise.unknowns);
  Ended ended = white_noise;
  ended.filtered = !white;
  for (int round = 0; round < rounds; ++round) {
    auto noise = noise_coefficients(problem.residuals(ended.unknowns), problem.jacobian(ended.unknowns));
    double change = noise.size() == ended.noise.size() ? 0.0 : 1.0;
    for (std::size_t j = 0; change == 0.0 && j < noise.size(); ++j) {
      if (std::abs(noise[j] - ended.noise[j]) > 1e-3) change = 1.0;
    }
    if (change == 0.0) break;
    ended.noise = std::move(noise);
    ended.squares = problem.minimise(ended.unknowns, ended.noise);
  }
  constexpr double kLeftCurve = 4.0;  // largest ratio of the sums of squares that leaves no curve
  const bool left = !is_usable(ended.unknowns, ended.squares) ||
                    squares_of(problem.residuals(ended.unknowns)) > kLeftCurve * white_noise.squares;
  return left ? white_noise : ended;
}

// Reason why no fit is attempted; empty if one is.
std::string refusal_of(std::span<const Sample> samples, const FitSetup& setup) {
  const auto finite = [](const Sample& s) { return std::isfinite(s.z_m) && std::isfinite(s.force_n); };
  if (samples.size() < kFewest) return "it has fewer than 10 points of an approach";
  if (!std::all_of(samples.begin(), samples.end(), finite)) return "a height or a force is not a number";
  const auto [low_m, high_m] = heights_of(samples);
  if (!(high_m > low_m)) return "all its heights are the same";
  if (!row_of(setup.indenter.shape).is_adhesive) return "";
  if (setup.against == Against::Tip) return "a law of adhesion is fitted against Z alone";
  if (!(setup.pull_off_n > 0.0)) return "its retract has no pull; take a shape without adhesion";
  const auto sticking = static_cast<std::size_t>(
      std::count_if(samples.begin(), samples.end(), [](const Sample& sample) { return sample.sticks; }));
  return sticking < kFewest || samples.size() - sticking < kFewest
             ? "fewer than 10 points of a tip that sticks, or of one that is free: a law of adhesion needs both"
             : "";
}

// False for a contact point farther from the data than the data are long.
bool is_contact(const Ended& ended, std::span<const Sample> samples) {
  const auto [low_m, high_m] = heights_of(samples);
  const double contact_m = ended.unknowns[kContact];
  return is_usable(ended.unknowns, ended.squares) &&
         std::abs(contact_m - std::clamp(contact_m, low_m, high_m)) <= high_m - low_m;
}

struct Minimum {
  Ended ended;
  // infinite where an end was not found
  Interval log_modulus{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Interval log_work = log_modulus;
};

// Interval of an unknown; a better minimum that was met on the way.
struct Profiled {
  Interval interval;
  std::optional<Unknowns> lower;
};
Profiled profiled(std::size_t unknown, const CurveProblem& problem, const Ended& ended, double rounding_n) {
  const double deviation = deviation_of(unknown, problem, ended);
  // of a curve without noise there is no likelihood
  if (std::sqrt(ended.squares / static_cast<double>(problem.size())) < rounding_n) {
    const double way = std::sqrt(kChiSquare95) * deviation, middle = ended.unknowns[unknown];
    return {{middle - way, middle + way}, std::nullopt};
  }
  const ProfileEnd low = profile_end(unknown, problem, ended, deviation, -1.0);
  const ProfileEnd high = profile_end(unknown, problem, ended, deviation, 1.0);
  return {{low.value, high.value}, low.lower ? low.lower : high.lower};
}

// Minimum with its interval, if requested; a better minimum found on the way becomes the start of another fit. Empty
// without a contact.
std::optional<Minimum> minimum_with_interval(const CurveProblem& problem, std::span<const Sample> samples,
                                             const Unknowns& start, const FitSetup& setup) {
  constexpr int kMostRestarts = 4;
  const bool white = setup.white;
  const double rounding_n = kRounding * force_range_n(samples);
  Minimum found{.ended = minimum(problem, start, white)};
  for (int restart = 0; restart <= kMostRestarts; ++restart) {
    if (!is_contact(found.ended, samples)) return std::nullopt;
    if (!setup.interval) break;
    Profiled last = profiled(kModulus, problem, found.ended, rounding_n);
    found.log_modulus = last.interval;
    if (problem.is_adhesive() && !last.lower) {
      last = profiled(problem.work(), problem, found.ended, rounding_n);
      found.log_work = last.interval;
    }
    const auto& lower = last.lower;
    if (!lower || restart == kMostRestarts) break;
    found = {.ended = minimum(problem, *lower, white)};
  }
  return found;
}

// Depths, forces and residuals at the minimum.
void describe(std::span<const Sample> samples, const CurveProblem& problem, const Ended& ended, ElasticFit& fit) {
  const CurveModel& model = problem.model(ended.unknowns);
  std::vector<double> residuals(model.residual_n);
  double before_contact = 0.0;
  fit.model_n.reserve(residuals.size());
  for (std::size_t t = 0; t < residuals.size(); ++t) {
    fit.depth_m = std::max(fit.depth_m, model.depth_m[t]);
    fit.model_n.push_back(samples[t].force_n + residuals[t]);
    if (model.touch[t] != 0) {
      ++fit.in_contact;
    } else {
      before_contact += residuals[t] * residuals[t];
    }
  }
  fit.points = residuals.size();
  fit.rms_n = std::sqrt(squares_of(residuals) / static_cast<double>(fit.points));
  const std::size_t outside = fit.points - fit.in_contact;
  fit.noise_n = outside < kFewest ? fit.rms_n : std::sqrt(before_contact / static_cast<double>(outside));
  if (ended.filtered) fit.noise_order = ended.noise.size();
  fit.noise = ended.noise;
  const std::size_t left = whiten(ended.noise, residuals);
  // of a law of adhesion free points of the retract come last, too
  fit.runs_p = runs_probability(std::span(residuals).first(left), std::min(model.first_touch, left));
}

Adhesion adhesion_of(const Minimum& best, const CurveProblem& problem, const FitSetup& setup) {
  const Unknowns& unknowns = best.ended.unknowns;
  const Indenter& indenter = setup.indenter;
  Adhesion adhesion;
  adhesion.work_j_per_m2 = std::exp(unknowns[problem.work()]);
  adhesion.work_interval = {std::exp(best.log_work.low), std::exp(best.log_work.high)};
  const physics::AdhesiveContact contact{physics::Length(indenter.radius_m),
                                         physics::Pressure(std::exp(unknowns[kModulus])),
                                         physics::SurfaceEnergy(adhesion.work_j_per_m2)};
  const AdhesiveBranch branch(indenter.shape, contact, indenter.atomic_distance_m, setup.spring_n_per_m);
  adhesion.pull_off_n = branch.pull_off_n();
  adhesion.pull_off_z_m = unknowns[kContact] - branch.let_go_way_m();
  adhesion.tabor = tabor_of(contact, indenter.atomic_distance_m);
  return adhesion;
}

std::optional<ElasticFit> fit_shape(std::span<const Sample> samples, const FitSetup& setup, std::string& why) {
  const auto start = best_start(samples, setup);
  if (!start) {
    why = "the force never rises: its sign may be turned, or there is no contact";
    return std::nullopt;
  }
  const CurveProblem problem(samples, setup);
  const auto best = minimum_with_interval(problem, samples, *start, setup);
  if (!best) {
    why = "no modulus fits: the sample is not pushed, or the curve is no contact's";
    return std::nullopt;
  }
  ElasticFit found;
  found.shape = setup.indenter.shape;
  const double from_reduced = 1.0 - setup.poisson * setup.poisson;
  const Unknowns& unknowns = best->ended.unknowns;
  found.reduced_modulus_pa = std::exp(unknowns[kModulus]);
  found.modulus_pa = from_reduced * found.reduced_modulus_pa;
  found.modulus_interval_pa = {from_reduced * std::exp(best->log_modulus.low),
                               from_reduced * std::exp(best->log_modulus.high)};
  found.contact_z_m = unknowns[kContact];
  found.level_n = unknowns[kLevel];
  if (setup.tilt) found.tilt_n_per_m = unknowns[kTilt];
  if (problem.is_adhesive()) found.adhesion = adhesion_of(*best, problem, setup);
  describe(samples, problem, best->ended, found);
  judge(samples, setup, problem, best->ended, found);
  return found;
}

// Starts from Maugis' law, whose limits the others are, until the law stays; a curve between two laws is Maugis'.
std::optional<ElasticFit> fit_by_tabor(std::span<const Sample> samples, const FitSetup& setup, std::string& why) {
  constexpr std::size_t kMostRounds = 4;
  FitSetup tried(setup);
  tried.indenter.shape = Shape::Maugis;
  std::optional<ElasticFit> last;
  for (std::size_t round = 1;; ++round) {
    auto found = fit_shape(samples, tried, why);
    if (!found) return last;  // fallback to the law of the previous round
    const Shape law = law_of_tabor(found->adhesion->tabor);
    found->adhesion->rounds = round;
    if (law == tried.indenter.shape || round > kMostRounds) return found;
    last = std::move(found);
    tried.indenter.shape = round < kMostRounds ? law : Shape::Maugis;
  }
}

}  // namespace

std::optional<ElasticFit> fit(std::span<const Sample> samples, const FitSetup& setup, std::string& why) {
  why = refusal_of(samples, setup);
  if (!why.empty()) return std::nullopt;
  auto found = setup.indenter.shape == Shape::Auto ? fit_by_tabor(samples, setup, why) : fit_shape(samples, setup, why);
  if (found) found->systematic = systematic_of(samples, setup, *found);
  if (found && setup.bootstraps > 0) found->bootstrap = bootstrap_of(samples, setup, *found);
  return found;
}

}  // namespace afm::fits
