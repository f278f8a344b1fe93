// SPDX-License-Identifier: Apache-2.0
#include "curves/adhesion_map_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace afm::curves {
namespace {

using physics::Regime;
using physics::regime_of;

constexpr double kTaborLow = 1e-3, kTaborHigh = 1e3;
constexpr double kLoadLow = 1e-2, kLoadHigh = 1e5;  // range of loads in units of pi W R
constexpr int kPoints = 160;

double between(double low, double high, int index) { return low * std::pow(high / low, double(index) / kPoints); }

// Place where `is_below` changes from true to false, by bisection on the logarithm; `high` if it never does.
template <class Predicate>
double border(double low, double high, const Predicate& is_below) {
  if (is_below(high)) return high;
  for (int i = 0; i < 40; ++i) {
    const double middle = std::sqrt(low * high);
    (is_below(middle) ? low : high) = middle;
  }
  return low;
}

// Load above which adhesion is negligible.
double hertz_load(double tabor) {
  return border(kLoadLow, kLoadHigh, [&](double load) { return regime_of(tabor, load) != Regime::Hertz; });
}

SvgLine hertz_border() {
  SvgLine line{"", "#3c434b", LineStyle::Solid, {}};
  for (int i = 0; i <= kPoints; ++i) {
    const double tabor = between(kTaborLow, kTaborHigh, i);
    line.points.push_back({tabor, hertz_load(tabor)});
  }
  return line;
}

// Right border of a regime, at each load below Hertz'.
SvgLine right_border_of(Regime last) {
  SvgLine line{"", "#3c434b", LineStyle::Solid, {}};
  for (int i = 0; i <= kPoints; ++i) {
    const double load = between(kLoadLow, kLoadHigh, i);
    const auto is_hertz = [&](double tabor) { return regime_of(tabor, load) == Regime::Hertz; };
    // a load may be Hertz' for a stiff contact but not for a soft one
    const double from = is_hertz(kTaborLow) ? 1.000001 * border(kTaborLow, kTaborHigh, is_hertz) : kTaborLow;
    if (is_hertz(from) || regime_of(from, load) > last) break;
    line.points.push_back(
        {border(from, kTaborHigh, [&](double tabor) { return regime_of(tabor, load) <= last; }), load});
  }
  return line;
}

SvgMark label(double tabor, double load, const char* text) {
  return {{tabor, load}, text, "#5a626c", SvgMark::Side::Centre};
}

}  // namespace

SvgPlot adhesion_map_plot(const std::string& title, const physics::LawChoice& place,
                          const physics::ContactParameters& contact, physics::Force pull_off) {
  SvgPlot plot;
  plot.title = title;
  plot.x_label = "Tabor parameter \u03bc = (R W\u00b2/(E*\u00b2 z\u2080\u00b3))^(1/3)";
  plot.y_label = "|load|/(\u03c0 W R)";
  plot.x_scale = plot.y_scale = AxisScale::Logarithmic;
  plot.lines = {hertz_border(), right_border_of(Regime::Rigid), right_border_of(Regime::Dmt),
                right_border_of(Regime::Maugis)};
  plot.marks = {label(1.0, 2e4, "Hertz: adhesion is negligible"), label(4e-3, 0.1, "rigid (Bradley)"),
                label(0.05, 0.3, "DMT"), label(0.7, 0.3, "Maugis-Dugdale"), label(70.0, 0.3, "JKR")};

  const physics::Force unit = std::numbers::pi * (2.0 * contact.mean_surface_energy) * contact.tip_radius;
  const double load = std::abs(pull_off / unit);
  const SvgPoint here{std::clamp(place.tabor, kTaborLow, kTaborHigh), std::clamp(load, kLoadLow, kLoadHigh)};
  plot.marks.push_back({here, fmt::format("this contact: \u03bc = {:.3g}", place.tabor), "#d55e00",
                        here.x > 1.0 ? SvgMark::Side::Left : SvgMark::Side::Right});
  return plot;
}

}  // namespace afm::curves
