// SPDX-License-Identifier: Apache-2.0
#include "fits/thermal_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "oscillator_problem.h"
#include "physics/rows_of_enum.h"
#include "profile.h"

namespace afm::fits {

constexpr std::array<SpectrumDoubtRow, 5> kSpectrumDoubts{
    {{SpectrumDoubt::OtherShape, "it is not one oscillator on a constant floor; chi square of neighbours"},
     {SpectrumDoubt::TooCoarse, "few points in the width of the resonance"},
     {SpectrumDoubt::Unknown, "the area is hardly known; its relative standard deviation"},
     {SpectrumDoubt::FewerAverages, "the scatter is that of fewer averages; share of those given"},
     {SpectrumDoubt::Correlated, "neighbours are correlated more than by a window; growth of the variances"}}};
static_assert(physics::has_row_for_each(kSpectrumDoubts, &SpectrumDoubtRow::doubt));

namespace {

constexpr std::size_t kFewestPoints = 20;
constexpr double kNoResonance = 0.5;  // deviation of the area from which there is no resonance, relative

std::string refusal_of_spectrum(std::span<const SpectrumPoint> spectrum) {
  if (spectrum.size() < kFewestPoints) return "it has fewer than 20 points";
  double before_hz = 0.0;
  for (const SpectrumPoint& point : spectrum) {
    if (!std::isfinite(point.frequency_hz) || !(point.frequency_hz > before_hz)) return "its frequencies do not rise";
    if (!std::isfinite(point.density) || !(point.density > 0.0)) return "a density is not positive";
    before_hz = point.frequency_hz;
  }
  return "";
}

// Means over a moving window of 2 `half` + 1 points.
std::vector<double> smoothed(std::span<const SpectrumPoint> spectrum, std::size_t half) {
  std::vector<double> sums{0.0};
  for (const SpectrumPoint& point : spectrum) sums.push_back(sums.back() + point.density);
  std::vector<double> means;
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const std::size_t begin = i - std::min(i, half), end = std::min(i + half + 1, spectrum.size());
    means.push_back((sums[end] - sums[begin]) / static_cast<double>(end - begin));
  }
  return means;
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct Start {
  Oscillator oscillator;
  double deviance;
};

// Peaks of the smoothed spectrum with sharp and blunt resonances, the likeliest first.
std::vector<Start> starts_of(const OscillatorProblem& problem, std::span<const SpectrumPoint> spectrum) {
  std::vector<Start> starts;
  for (const std::size_t half : {0U, 2U, 10U, 50U}) {
    if (2 * half + 1 > spectrum.size() / 4) break;
    const std::vector<double> means = smoothed(spectrum, half);
    const auto peak = std::max_element(means.begin(), means.end());
    const double peak_hz = spectrum[static_cast<std::size_t>(peak - means.begin())].frequency_hz;
    const double floor = quantile(means, 0.1);
    for (const double quality : {1.0, 3.0, 10.0, 40.0, 150.0, 600.0}) {
      // of a blunt resonance the peak lies below f0
      const double resonance_hz = peak_hz / std::sqrt(std::max(1.0 - 0.5 / (quality * quality), 0.5));
      const double area = (*peak - 0.5 * floor) * std::numbers::pi * resonance_hz / (2.0 * quality);
      const Oscillator oscillator{resonance_hz, quality, area, 0.5 * floor};
      starts.push_back({oscillator, problem.deviance(oscillator)});
    }
  }
  std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.deviance < b.deviance; });
  return starts;
}

// True if the resonance lies within the frequencies, and rises above the floor.
bool is_oscillator(const Oscillator& oscillator, std::span<const SpectrumPoint> spectrum) {
  constexpr double kLeastRise = 1e-6;
  const double rise = density_at(oscillator, oscillator.resonance_hz) - oscillator.floor;
  return rise > kLeastRise * std::abs(oscillator.floor) && std::isnormal(oscillator.area) &&
         std::isnormal(oscillator.quality_factor) && std::isfinite(oscillator.floor) &&
         oscillator.resonance_hz > spectrum.front().frequency_hz &&
         oscillator.resonance_hz < spectrum.back().frequency_hz;
}

std::optional<Oscillator> likeliest(const OscillatorProblem& problem, std::span<const SpectrumPoint> spectrum) {
  constexpr std::size_t kTried = 5;
  std::vector<Start> starts = starts_of(problem, spectrum);
  if (starts.size() > kTried) starts.resize(kTried);
  std::optional<Oscillator> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Start& start : starts) {
    std::vector<double> unknowns = problem.unknowns_of(start.oscillator);
    const double deviance = problem.minimise(unknowns);
    const Oscillator found = problem.oscillator_of(unknowns);
    if (!std::isfinite(deviance) || !is_oscillator(found, spectrum) || !(deviance < least)) continue;
    least = deviance;
    best = found;
  }
  return best;
}

double sum_of_products(std::span<const double> deviations, std::size_t lag) {
  return std::inner_product(deviations.begin() + static_cast<std::ptrdiff_t>(lag), deviations.end(), deviations.begin(),
                            0.0);
}

// Growth of a variance by correlated neighbours: 1 + 2 sum of the correlations that are more than chance. A Hann window
// correlates two on either side.
double neighbour_factor_of(std::span<const double> deviations) {
  constexpr std::size_t kFarthest = 3;
  constexpr double kChance = 3.0;  // correlation that is more than chance, in standard deviations
  const double squares = sum_of_products(deviations, 0);
  double factor = 1.0;
  for (std::size_t lag = 1; lag <= kFarthest && squares > 0.0; ++lag) {
    const double correlation = sum_of_products(deviations, lag) / squares;
    if (correlation > kChance / std::sqrt(static_cast<double>(deviations.size()))) factor += 2.0 * correlation;
  }
  return factor;
}

// Chi square of the means of neighbouring groups, over the number of groups.
constexpr std::size_t kGroups = 16;
double group_chi_square(std::span<const double> deviations, double variance) {
  double sum = 0.0;
  for (std::size_t group = 0; group < kGroups; ++group) {
    const std::size_t begin = group * deviations.size() / kGroups, end = (group + 1) * deviations.size() / kGroups;
    const double off = std::accumulate(deviations.begin() + static_cast<std::ptrdiff_t>(begin),
                                       deviations.begin() + static_cast<std::ptrdiff_t>(end), 0.0);
    sum += off * off / (static_cast<double>(end - begin) * variance);
  }
  return sum / static_cast<double>(kGroups);
}

void judge_spectrum(std::span<const SpectrumPoint> spectrum, std::span<const double> deviations,
                    std::optional<double> given, ThermalFit& fit) {
  constexpr double kMostChiSquare = 39.25 / static_cast<double>(kGroups);  // 0.999 quantile over the number of groups
  constexpr double kFewestInWidth = 4.0, kMostDeviation = 0.1, kUsualScatter = 0.25, kChance = 4.0;
  constexpr double kMostCorrelated = 2.5;  // largest factor of a window; a Hann window has 1.94
  const auto doubt = [&fit](bool found, SpectrumDoubt which, double figure, double limit) {
    if (found) fit.doubts.push_back({which, figure, limit});
  };
  const double variance = fit.neighbour_factor / fit.averages;
  const double chi_square = variance > 0.0 ? group_chi_square(deviations, variance) : 0.0;
  doubt(chi_square > kMostChiSquare, SpectrumDoubt::OtherShape, chi_square, kMostChiSquare);

  const double half_width_hz = 0.5 * fit.oscillator.resonance_hz / fit.oscillator.quality_factor;
  const double in_width = static_cast<double>(std::count_if(spectrum.begin(), spectrum.end(), [&](const auto& point) {
    return std::abs(point.frequency_hz - fit.oscillator.resonance_hz) <= half_width_hz;
  }));
  doubt(in_width < kFewestInWidth, SpectrumDoubt::TooCoarse, in_width, kFewestInWidth);
  doubt(!(fit.area_deviation <= kMostDeviation), SpectrumDoubt::Unknown, fit.area_deviation, kMostDeviation);
  doubt(fit.neighbour_factor > kMostCorrelated, SpectrumDoubt::Correlated, fit.neighbour_factor, kMostCorrelated);
  if (!given || !fit.seen_averages) return;
  const double chance = std::sqrt((2.0 + 6.0 / *given) / static_cast<double>(spectrum.size()));
  const double share = *fit.seen_averages / *given, limit = 1.0 / (1.0 + std::max(kUsualScatter, kChance * chance));
  doubt(share < limit, SpectrumDoubt::FewerAverages, share, limit);
}

}  // namespace

std::optional<ThermalFit> fit_thermal(std::span<const SpectrumPoint> spectrum, std::optional<double> averages,
                                      std::string& why) {
  why = refusal_of_spectrum(spectrum);
  if (!why.empty()) return std::nullopt;
  std::vector<double> densities;
  for (const SpectrumPoint& point : spectrum) densities.push_back(point.density);
  const OscillatorProblem problem(spectrum, quantile(std::move(densities), 0.1));
  const auto best = likeliest(problem, spectrum);
  if (!best) {
    why = "no resonance within its frequencies fits";
    return std::nullopt;
  }
  ThermalFit fit;
  fit.oscillator = *best;
  fit.points = spectrum.size();
  fit.low_hz = spectrum.front().frequency_hz;
  fit.high_hz = spectrum.back().frequency_hz;
  const std::vector<double> deviations = problem.deviations(*best);
  const double scatter = sum_of_products(deviations, 0) / static_cast<double>(fit.points - kOscillatorUnknowns);
  constexpr double kNoScatter = 1e-18;
  if (scatter > kNoScatter) fit.seen_averages = 1.0 / scatter;
  fit.averages = averages.value_or(fit.seen_averages.value_or(std::numeric_limits<double>::infinity()));
  if (fit.seen_averages) fit.neighbour_factor = neighbour_factor_of(deviations);

  const auto variances = problem.variances(*best);
  const auto way = [&](OscillatorUnknown which) {
    return std::sqrt(kChiSquare95 * variances[which] * fit.neighbour_factor / fit.averages);
  };
  const auto around = [&way](double value, OscillatorUnknown which) {
    return Interval{value * std::exp(-way(which)), value * std::exp(way(which))};
  };
  fit.resonance_hz = around(best->resonance_hz, kResonance);
  fit.quality_factor = around(best->quality_factor, kQuality);
  fit.area = around(best->area, kArea);
  const double floor_way = way(kFloor) * problem.floor_scale();
  fit.floor = {best->floor - floor_way, best->floor + floor_way};
  fit.area_deviation = way(kArea) / std::sqrt(kChiSquare95);
  if (!(fit.area_deviation < kNoResonance)) {
    why = "no resonance rises above its noise";
    return std::nullopt;
  }
  judge_spectrum(spectrum, deviations, averages, fit);
  return fit;
}

}  // namespace afm::fits
