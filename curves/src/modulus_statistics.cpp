// SPDX-License-Identifier: Apache-2.0
#include "curves/modulus_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "curves/svg_plot.h"
#include "physics/quantity_text.h"

namespace afm::curves {

namespace {

// Median of sorted values.
double median_of(const std::vector<double>& values) {
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::string pressure(double pa) { return physics::format_quantity(physics::Pressure(pa), physics::kPressureUnits, 4); }

// Steps of a histogram between two ends, in per cent of all values; those beyond are left out.
SvgLine steps_of(const std::vector<double>& places, double low, double high) {
  // the root of their number, within what a picture shows
  const std::size_t bins =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(places.size()))), 5, 60);
  std::vector<std::size_t> counts(bins, 0);
  for (const double place : places) {
    const double bin = (place - low) / (high - low) * static_cast<double>(bins);
    if (bin >= 0.0 && bin <= static_cast<double>(bins)) ++counts[std::min(static_cast<std::size_t>(bin), bins - 1)];
  }
  SvgLine line{"", std::string(distinct_color(0)), LineStyle::Solid, {{low, 0.0}}};
  for (std::size_t i = 0; i < bins; ++i) {
    const double share = 100.0 * static_cast<double>(counts[i]) / static_cast<double>(places.size());
    for (const std::size_t end : {i, i + 1}) {
      line.points.push_back({low + (high - low) * static_cast<double>(end) / static_cast<double>(bins), share});
    }
  }
  line.points.push_back({high, 0.0});
  return line;
}

SvgPlot histogram(const std::string& title, const std::string& x_label, const std::vector<double>& places,
                  std::pair<double, double> ends, double median) {
  auto [low, high] = ends;
  if (!(high > low)) {  // identical values
    const double half = std::max(0.05 * std::abs(low), 1e-3);
    low -= half;
    high += half;
  }
  SvgPlot plot;
  plot.title = title;
  plot.x_label = x_label;
  plot.y_label = "share of the curves, %";
  plot.lines.push_back(steps_of(places, low, high));
  double most = 0;
  for (const SvgPoint& point : plot.lines.front().points) most = std::max(most, point.y);
  plot.lines.push_back({"median", std::string(distinct_color(1)), LineStyle::Dashed, {{median, 0.0}, {median, most}}});
  plot.height = 420;
  return plot;
}

}  // namespace

ModulusFigures modulus_figures(std::vector<double> moduli_pa) {
  constexpr double kNormal = 1.4826;  // inverse of the 75 % quantile of the normal distribution
  std::sort(moduli_pa.begin(), moduli_pa.end());
  ModulusFigures figures;
  figures.median_pa = median_of(moduli_pa);
  double logarithms = 0;
  for (double& modulus : moduli_pa) {
    logarithms += std::log(modulus) / static_cast<double>(moduli_pa.size());
    modulus = std::abs(modulus - figures.median_pa);
  }
  std::sort(moduli_pa.begin(), moduli_pa.end());
  figures.deviation_pa = kNormal * median_of(moduli_pa);
  figures.geometric_mean_pa = std::exp(logarithms);
  return figures;
}

std::string modulus_histograms(std::vector<double> moduli_pa) {
  std::sort(moduli_pa.begin(), moduli_pa.end());
  const ModulusFigures figures = modulus_figures(moduli_pa);
  // a unit in which the median is between 1 and 1000
  const double power = std::floor(std::log10(figures.median_pa) / 3.0);
  constexpr std::array kUnits{"Pa", "kPa", "MPa", "GPa", "TPa"};
  const auto unit = static_cast<std::size_t>(std::clamp(power, 0.0, static_cast<double>(kUnits.size() - 1)));
  const double factor = std::pow(1000.0, -static_cast<double>(unit));
  std::vector<double> linear, logarithmic;
  for (const double modulus : moduli_pa) {
    linear.push_back(factor * modulus);
    logarithmic.push_back(std::log10(factor * modulus));
  }
  const std::size_t cut = linear.size() / 100;
  const std::array plots{histogram(fmt::format("{} curves: median {}, deviation {}", moduli_pa.size(),
                                               pressure(figures.median_pa), pressure(figures.deviation_pa)),
                                   fmt::format("modulus E, {}", kUnits[unit]), linear,
                                   {linear[cut], linear[linear.size() - 1 - cut]}, factor * figures.median_pa),
                         histogram(fmt::format("geometric mean {}", pressure(figures.geometric_mean_pa)),
                                   fmt::format("logarithm to base 10 of E in {}", kUnits[unit]), logarithmic,
                                   {logarithmic.front(), logarithmic.back()}, std::log10(factor * figures.median_pa))};
  return svg(plots);
}

}  // namespace afm::curves
