// SPDX-License-Identifier: Apache-2.0
#include "exhibit/friction/friction_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "curves/live_parameters.h"
#include "curves/plot_units.h"
#include "panels/panel_conventions.h"
#include "physics/quantity_text.h"

namespace afm::exhibit {

namespace {

using Run = std::vector<physics::LateralPoint>;

constexpr glm::vec3 kRightColor{0.337F, 0.706F, 0.914F}, kLeftColor{0.902F, 0.624F, 0.0F},
    kNowColor{0.00F, 0.78F, 0.56F};
constexpr double kLoopMargin = 0.08;  // share of the axes around the curves
constexpr double kShownPeriods = 3.0,
                 kPeriodsBeside = 1.0;   // shown periods of a lattice, and those to the left of the tip's own
constexpr double kManyPeriods = 6.0;     // longest stroke shown as a whole
constexpr double kLeastForceNn = 0.002;  // half range of the force, so that rounding is not drawn as friction

render::PlotPoint plotted(const physics::LateralPoint& point) {
  return {.place_nm = point.place.si * curves::kNmPerM, .force_nn = point.force.si * curves::kNnPerN};
}

std::vector<render::PlotPoint> plotted(const Run& run, std::size_t begin, std::size_t end) {
  std::vector<render::PlotPoint> points;
  for (std::size_t i = begin; i <= end; ++i) points.push_back(plotted(run[i]));
  return points;
}

// Draws the stroke to the left dashed, the one to the right solid.
void add_strokes(const Run& run, const physics::FrictionLoop& loop, const Phrases& phrases,
                 std::vector<render::PlotCurve>& curves) {
  std::vector<render::PlotPoint> right = plotted(run, loop.begin, loop.turn), left = plotted(run, loop.turn, loop.end);
  if (run[loop.turn].place < run[loop.begin].place) std::swap(left, right);
  curves.push_back({.label = phrases[Phrase::FrictionRight],
                    .color = kRightColor,
                    .faded = false,
                    .approach = {},
                    .retract = std::move(right)});
  curves.push_back({.label = phrases[Phrase::FrictionLeft],
                    .color = kLeftColor,
                    .faded = false,
                    .approach = std::move(left),
                    .retract = {}});
}

// Places along a stroke, or along a part of it.
struct Stroke {
  double low_nm = std::numeric_limits<double>::infinity(), high_nm = -low_nm;

  double length_nm() const { return high_nm - low_nm; }
};

// Shows whole periods around a place, so that the teeth keep their places while the tip moves.
Stroke zoom_to(double place_nm, double period_nm, render::ForcePanel& panel) {
  const double low_nm = (std::floor(place_nm / period_nm) - kPeriodsBeside) * period_nm;
  const Stroke shown{.low_nm = low_nm, .high_nm = low_nm + kShownPeriods * period_nm};
  const auto outside = [&](const render::PlotPoint& point) {
    return point.place_nm < shown.low_nm || point.place_nm > shown.high_nm;
  };
  for (render::PlotCurve& curve : panel.curves) {
    std::erase_if(curve.approach, outside);
    std::erase_if(curve.retract, outside);
  }
  return shown;
}

Stroke stroke_of(const render::ForcePanel& panel) {
  Stroke stroke;
  for (const render::PlotCurve& curve : panel.curves) {
    for (const auto* points : {&curve.approach, &curve.retract}) {
      for (const render::PlotPoint& point : *points) {
        stroke.low_nm = std::min(stroke.low_nm, point.place_nm);
        stroke.high_nm = std::max(stroke.high_nm, point.place_nm);
      }
    }
  }
  return stroke;
}

// Sets the axes; `along`: the places to show, at least those of the curves.
void fit_axes(Stroke along, render::ForcePanel& panel) {
  double &left = along.low_nm, &right = along.high_nm, low = -kLeastForceNn, high = kLeastForceNn;
  for (const render::PlotCurve& curve : panel.curves) {
    for (const auto* points : {&curve.approach, &curve.retract}) {
      for (const render::PlotPoint& point : *points) {
        left = std::min(left, point.place_nm);
        right = std::max(right, point.place_nm);
        low = std::min(low, point.force_nn);
        high = std::max(high, point.force_nn);
      }
    }
  }
  if (!(left < right)) {
    left = -1.0;
    right = 1.0;
  }
  panel.place_min_nm = left - kLoopMargin * (right - left);
  panel.place_max_nm = right + kLoopMargin * (right - left);
  panel.force_min_nn = low - kLoopMargin * (high - low);
  panel.force_max_nn = high + kLoopMargin * (high - low);
}

void add_loop(const Run& run, const physics::FrictionLoop& loop, const Phrases& phrases, render::ForcePanel& panel) {
  const auto figure = [&](Phrase name, const std::string& text) {
    panel.figures.push_back({phrases[name], phrases.number(curves::typographic(text)), ""});
  };
  figure(Phrase::FrictionHalfWidth, format_quantity(loop.half_width, physics::kForceUnits, kDigits));
  figure(Phrase::FrictionOffset, format_quantity(loop.offset, physics::kForceUnits, kDigits));
  figure(Phrase::FrictionSlope, format_quantity(loop.slope, physics::kStiffnessUnits, kDigits));
  add_strokes(run, loop, phrases, panel.curves);
  for (const physics::Force mean : {loop.offset + loop.half_width, loop.offset, loop.offset - loop.half_width}) {
    panel.markers.push_back({render::PlotMarker::Kind::HorizontalLine, mean.si * curves::kNnPerN, ""});
  }
}

}  // namespace

render::ForcePanel friction_panel(const FrictionHistory& history, const physics::FrictionParameters& friction,
                                  const Phrases& phrases) {
  const physics::FrictionLaw law = friction.law;
  render::ForcePanel panel;
  panel.title = phrases[Phrase::FrictionTitle];
  panel.words = {.approach = {},
                 .retract = {},
                 .place_axis = "x (nm)",
                 .force_axis = "F_x (nN)",
                 .decimal_mark = phrases.decimal_mark()};
  if (law == physics::FrictionLaw::None) {
    panel.stage = phrases[Phrase::FrictionOff];
    fit_axes({}, panel);
    return panel;
  }
  const Run now = physics::along_main_line(history.contact());
  const auto growing = physics::last_friction_loop(now);
  const Run before = growing ? Run{} : physics::along_main_line(history.earlier());
  const auto earlier = growing ? std::nullopt : physics::last_friction_loop(before);
  if (growing) add_loop(now, *growing, phrases, panel);
  if (earlier) add_loop(before, *earlier, phrases, panel);
  const std::size_t drawn = growing ? growing->end : 0;
  if (drawn + 1 < now.size()) {
    panel.curves.push_back({.label = phrases[Phrase::FrictionNow],
                            .color = kNowColor,
                            .faded = false,
                            .approach = {},
                            .retract = plotted(now, drawn, now.size() - 1)});
  }
  panel.stage = growing || earlier ? phrases.text<Phrase::FrictionClosed>(physics::text_of(law).word)
                                   : phrases[Phrase::FrictionAdvice];
  if (history.attached() && !now.empty()) panel.cursor = plotted(now.back());
  const Stroke stroke = stroke_of(panel);
  Stroke shown = stroke;
  const double period_nm = friction.period.si * curves::kNmPerM;
  if (law == physics::FrictionLaw::Lattice && stroke.length_nm() > kManyPeriods * period_nm) {
    shown = zoom_to(panel.cursor ? panel.cursor->place_nm : 0.5 * (stroke.low_nm + stroke.high_nm), period_nm, panel);
    if (growing || earlier)
      panel.stage = phrases.text<Phrase::FrictionZoomed>(fmt::format("{:.0f}", kShownPeriods),
                                                         fmt::format("{:.0f}", stroke.length_nm() / period_nm));
  }
  fit_axes(shown, panel);
  return panel;
}

}  // namespace afm::exhibit
