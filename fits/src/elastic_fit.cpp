// SPDX-License-Identifier: Apache-2.0
#include "fits/elastic_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "correlated_noise.h"
#include "curve_problem.h"

namespace afm::fits {

namespace {

constexpr double kChiSquare95 = 3.841458820694124;  // one degree of freedom
constexpr std::size_t kFewest = 10;
constexpr double kRounding = 1e-6;  // share of the push; smaller residuals are rounding, and say nothing of the shape

// A fit that has ended: unknowns, noise, and the sum of the whitened squares.
struct Ended {
  Unknowns unknowns;
  std::vector<double> noise;
  bool filtered = false;  // the noise was found, and used
  double squares = std::numeric_limits<double>::infinity();
};

bool is_usable(const Unknowns& unknowns, double squares) {
  return std::isfinite(squares) && std::isnormal(std::exp(unknowns[kModulus])) &&
         std::all_of(unknowns.begin(), unknowns.end(), [](double value) { return std::isfinite(value); });
}

struct Span {
  double low = 0, high = 0;
};
Span heights_of(std::span<const Sample> samples) {
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end(),
                                               [](const Sample& a, const Sample& b) { return a.z_m < b.z_m; });
  return {low->z_m, high->z_m};
}

// Means of neighbours, so that looking for the best start costs little.
std::vector<Sample> thinned(std::span<const Sample> samples) {
  constexpr std::size_t kLeft = 256;
  if (samples.size() <= 2 * kLeft) return {samples.begin(), samples.end()};
  std::vector<Sample> means;
  for (std::size_t i = 0; i < kLeft; ++i) {
    const std::size_t begin = i * samples.size() / kLeft, end = (i + 1) * samples.size() / kLeft;
    Sample mean;
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

std::optional<Unknowns> best_start(std::span<const Sample> samples, const FitSetup& setup) {
  const std::vector<Sample> few = thinned(samples);
  const CurveProblem problem(few, setup);
  const auto [low_m, high_m] = heights_of(few);
  std::vector<double> starts(setup.starts);
  for (const double share : {0.25, 0.5, 0.75}) starts.push_back(std::lerp(low_m, high_m, share));
  std::optional<Unknowns> best;
  double least = std::numeric_limits<double>::infinity();
  for (const double start : starts) {
    auto unknowns = problem.start_at(start);
    if (!unknowns) continue;
    const double squares = problem.minimise(*unknowns);
    if (!is_usable(*unknowns, squares) || !(squares < least)) continue;
    least = squares;
    best = unknowns;
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
  constexpr double kLeftCurve = 4.0;  // largest ratio of the sums of squares
  const bool left = !is_usable(ended.unknowns, ended.squares) ||
                    squares_of(problem.residuals(ended.unknowns)) > kLeftCurve * white_noise.squares;
  return left ? white_noise : ended;
}

// Standard deviation of the logarithm of the modulus, from the whitened Jacobian: where the profile begins.
double deviation_of_modulus(const CurveProblem& problem, const Ended& ended) {
  std::vector<double> jacobian = problem.jacobian(ended.unknowns);
  const std::size_t n = problem.size(), count = problem.unknown_count();
  const std::size_t left = n - ended.noise.size();
  for (std::size_t c = 0; c < count; ++c) whiten(ended.noise, std::span(jacobian).subspan(c * n, n));
  // what the other columns leave of the modulus's, by Gram and Schmidt from the last column
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

// End of the interval on one side: where the likelihood, maximised over the other unknowns, has fallen by half the 95 %
// quantile of chi square. The root of the fall is nearly linear in the way, and is stepped to along that line, once
// there is an end on either side between them.
struct ProfileEnd {
  double log_modulus = 0;         // infinite if no end was found
  std::optional<Unknowns> lower;  // a better minimum that was met on the way
};
ProfileEnd profile_end(const CurveProblem& problem, const Ended& ended, double deviation, double side) {
  constexpr int kSteps = 16;
  constexpr double kFarthest = 5.0, kClose = 1e-3, kLower = 1e-6;
  const ProfileEnd none{side * std::numeric_limits<double>::infinity(), std::nullopt};
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
    const double squares = problem.minimise(unknowns, ended.noise, ended.unknowns[kModulus] + side * way);
    if (!is_usable(unknowns, squares)) return none;
    if (squares < ended.squares * (1.0 - kLower)) return {none.log_modulus, unknowns};
    const Place here{way, std::sqrt(std::max(free * std::log(squares / ended.squares), 0.0))};
    if (here.root < target) {
      near = here;
    } else {
      far = here;
    }
    if (!far && way >= kFarthest) return none;
    const double slope = far ? (far->root - near.root) / (far->way - near.way) : here.root / here.way;
    const double next = slope > 0.0 ? std::min(near.way + (target - near.root) / slope, kFarthest) : kFarthest;
    if (std::abs(next - way) < kClose * way && next < kFarthest) {
      return {ended.unknowns[kModulus] + side * next, std::nullopt};
    }
    way = next;
  }
  return far ? ProfileEnd{ended.unknowns[kModulus] + side * way, std::nullopt} : none;
}

double baseline_n(const ElasticFit& fit, const Sample& sample, const Sample& first) {
  return fit.level_n + fit.tilt_n_per_m * (sample.z_m - first.z_m);
}

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
    const double push_n = greatest_push_n(samples_, fit);
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
    add(fit, Doubt::Adhesive, setup_.pull_off_n / push_n, 0.05, setup_.pull_off_n > 0.05 * push_n);
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
    for (const Found& found : fit.doubts) {
      const bool fatal = kDoubts.at(static_cast<std::size_t>(found.doubt)).fatal;
      fit.trust = fatal || fit.trust == Trust::No ? Trust::No : Trust::Doubtful;
    }
  }

 private:
  static void add(ElasticFit& fit, Doubt doubt, double figure, double limit, bool found) {
    if (found) fit.doubts.push_back({doubt, figure, limit});
  }

  // The modulus of half the depth, by the same noise; it may differ by three of its standard deviations.
  void judge_level(ElasticFit& fit) {
    std::vector<Sample> shallow;
    std::size_t pushed = 0;
    for (std::size_t t = 0; t < samples_.size(); ++t) {
      const double depth_m = problem_.depth_m(ended_.unknowns, t);
      if (depth_m > 0.5 * fit.depth_m) continue;
      shallow.push_back(samples_[t]);
      if (depth_m > 0.0) ++pushed;
    }
    constexpr std::size_t kFewestPushed = 10;
    if (pushed < kFewestPushed || shallow.size() < 2 * kFewest) return;
    const CurveProblem half(shallow, setup_);
    Ended ended{ended_.unknowns, ended_.noise, ended_.filtered, 0.0};
    ended.squares = half.minimise(ended.unknowns, ended.noise);
    if (!is_usable(ended.unknowns, ended.squares)) return;
    fit.half_depth_modulus_pa = std::exp(ended.unknowns[kModulus]) * (fit.modulus_pa / fit.reduced_modulus_pa);
    const double apart = std::abs(ended.unknowns[kModulus] - ended_.unknowns[kModulus]);
    const double deviation = deviation_of_modulus(half, ended);
    add(fit, Doubt::NotLevel, apart / deviation, 3.0, apart > 3.0 * deviation);
  }

  std::span<const Sample> samples_;
  const FitSetup& setup_;
  const CurveProblem& problem_;
  const Ended& ended_;
};

}  // namespace

const std::array<DoubtRow, 11> kDoubts{{
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

std::optional<ElasticFit> fit(std::span<const Sample> samples, const FitSetup& setup, std::string& why) {
  const auto finite = [](const Sample& s) { return std::isfinite(s.z_m) && std::isfinite(s.force_n); };
  if (samples.size() < kFewest) {
    why = "it has fewer than 10 points of an approach";
    return std::nullopt;
  }
  if (!std::all_of(samples.begin(), samples.end(), finite)) {
    why = "a height or a force is not a number";
    return std::nullopt;
  }
  const auto [low_m, high_m] = heights_of(samples);
  if (!(high_m > low_m)) {
    why = "all its heights are the same";
    return std::nullopt;
  }
  const auto start = best_start(samples, setup);
  if (!start) {
    why = "the lever is nowhere pushed up: turned forces, or no contact";
    return std::nullopt;
  }
  const CurveProblem problem(samples, setup);
  Ended ended = minimum(problem, *start, setup.white);
  std::array<ProfileEnd, 2> ends;
  constexpr int kMostRestarts = 4;
  for (int restart = 0; restart < kMostRestarts; ++restart) {
    const double from_data_m = ended.unknowns[kContact] - std::clamp(ended.unknowns[kContact], low_m, high_m);
    if (!is_usable(ended.unknowns, ended.squares) || std::abs(from_data_m) > high_m - low_m) {
      why = "no modulus fits: the sample is not pushed, or the curve is no contact's";
      return std::nullopt;
    }
    const double deviation = deviation_of_modulus(problem, ended);
    // of a curve without noise there is no likelihood
    if (std::sqrt(ended.squares / static_cast<double>(samples.size())) < kRounding * force_range_n(samples)) {
      const double way = std::sqrt(kChiSquare95) * deviation, middle = ended.unknowns[kModulus];
      ends = {ProfileEnd{middle - way, std::nullopt}, ProfileEnd{middle + way, std::nullopt}};
      break;
    }
    ends = {profile_end(problem, ended, deviation, -1.0), profile_end(problem, ended, deviation, 1.0)};
    const auto& lower = ends[0].lower ? ends[0].lower : ends[1].lower;
    if (!lower) break;
    ended = minimum(problem, *lower, setup.white);
  }
  ElasticFit found;
  const double from_reduced = 1.0 - setup.poisson * setup.poisson;
  found.reduced_modulus_pa = std::exp(ended.unknowns[kModulus]);
  found.modulus_pa = from_reduced * found.reduced_modulus_pa;
  found.modulus_interval_pa = {from_reduced * std::exp(ends[0].log_modulus),
                               from_reduced * std::exp(ends[1].log_modulus)};
  found.contact_z_m = ended.unknowns[kContact];
  found.level_n = ended.unknowns[kLevel];
  if (setup.tilt) found.tilt_n_per_m = ended.unknowns[kTilt];
  std::vector<double> residuals = problem.residuals(ended.unknowns);
  double before_contact = 0.0;
  for (std::size_t t = 0; t < samples.size(); ++t) {
    const double depth_m = problem.depth_m(ended.unknowns, t);
    found.depth_m = std::max(found.depth_m, depth_m);
    if (depth_m > 0.0) ++found.in_contact;
    found.model_n.push_back(problem.force_n(ended.unknowns, t));
    if (!(depth_m > 0.0)) before_contact += residuals[t] * residuals[t];
  }
  found.points = samples.size();
  found.rms_n = std::sqrt(squares_of(residuals) / static_cast<double>(samples.size()));
  const std::size_t outside = samples.size() - found.in_contact;
  found.noise_n = outside < kFewest ? found.rms_n : std::sqrt(before_contact / static_cast<double>(outside));
  if (ended.filtered) found.noise_order = ended.noise.size();
  const std::size_t left = whiten(ended.noise, residuals);
  found.runs_p = runs_probability(std::span(residuals).first(left), std::min(outside, left));
  Judge(samples, setup, problem, ended).judge(found);
  return found;
}

}  // namespace afm::fits
