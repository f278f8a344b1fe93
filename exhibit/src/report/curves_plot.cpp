// SPDX-License-Identifier: Apache-2.0
#include "exhibit/report/curves_plot.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "curves/svg_plot.h"
#include "exhibit/state/cycle_curve.h"
#include "scene/shared/shared_blocks.h"

namespace afm::exhibit {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Window {
  double z_min_nm = -kInfinity;
  double z_max_nm = kInfinity;
  double force_min_nn = -kInfinity;
};

// Points of a curve; those outside the window break the line.
std::vector<curves::SvgPoint> points_within(const std::vector<render::PlotPoint>& points, const Window& window) {
  constexpr double kBreak = std::numeric_limits<double>::quiet_NaN();
  std::vector<curves::SvgPoint> result;
  result.reserve(points.size());
  for (const render::PlotPoint& p : points) {
    const bool inside =
        p.place_nm >= window.z_min_nm && p.place_nm <= window.z_max_nm && p.force_nn >= window.force_min_nn;
    result.push_back(inside ? curves::SvgPoint{p.place_nm, p.force_nn} : curves::SvgPoint{kBreak, kBreak});
  }
  return result;
}

curves::SvgPlot plot_within(std::span<const LabelledSession> sessions, Phrase title, const Window& window,
                            const Phrases& phrases) {
  curves::SvgPlot plot;
  plot.title = phrases[title];
  plot.decimal_mark = phrases.decimal_mark();
  plot.x_label = phrases[Phrase::ReportZAxis];
  const bool taps = scene::taps(sessions.front().session->parameters);
  plot.y_label = phrases[taps ? Phrase::ReportAmplitudeAxis : Phrase::ReportForceAxis];
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    const auto& [name, session] = sessions[i];
    const render::PlotCurve curve = curve_until(*session, session->samples.back().time_ns).plot(name, {});
    plot.lines.push_back({phrases.text<Phrase::ReportApproach>(phrases.word(name)),
                          std::string(curves::distinct_color(i)), curves::LineStyle::Dashed,
                          points_within(curve.approach, window)});
    plot.lines.push_back({phrases.text<Phrase::ReportRetract>(phrases.word(name)),
                          std::string(curves::distinct_color(i)), curves::LineStyle::Solid,
                          points_within(curve.retract, window)});
  }
  return plot;
}

// Window around the smallest loop, if it is hard to see next to the largest.
std::optional<Window> window_of_smallest(std::span<const LabelledSession> sessions) {
  const scene::TipEvent* smallest = nullptr;
  double largest_m = 0.0;
  for (const LabelledSession& labelled : sessions) {
    const scene::TipEvent* off = labelled.session->find(physics::EventKind::JumpOffContact);
    if (off == nullptr) continue;
    if (smallest == nullptr || off->z_m < smallest->z_m) smallest = off;
    largest_m = std::max(largest_m, off->z_m);
  }
  constexpr double kHardToSee = 3.0;
  if (smallest == nullptr || !(largest_m > kHardToSee * smallest->z_m)) return std::nullopt;
  const double z_nm = smallest->z_m * 1e9;
  return Window{.z_min_nm = -0.5 * z_nm, .z_max_nm = 1.6 * z_nm, .force_min_nn = 1.3 * smallest->force_before_n * 1e9};
}

}  // namespace

std::string curves_svg(std::span<const LabelledSession> sessions, const Phrases& phrases) {
  std::string plots = curves::svg(plot_within(sessions, Phrase::ReportAllCurves, {}, phrases));
  if (const auto near = window_of_smallest(sessions)) {
    plots += "\n" + curves::svg(plot_within(sessions, Phrase::ReportNearCurves, *near, phrases));
  }
  return plots;
}

}  // namespace afm::exhibit
