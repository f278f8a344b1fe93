// SPDX-License-Identifier: Apache-2.0
#include "app/curves_plot.h"

#include <limits>

#include "app/cycle_curve.h"
#include "app/svg_plot.h"

namespace afm::app {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Window {
  double z_min_nm = -kInfinity;
  double z_max_nm = kInfinity;
  double force_min_nn = -kInfinity;
};

// What lies outside breaks the line.
std::vector<SvgPoint> points_within(const std::vector<render::PlotPoint>& points, const Window& window) {
  constexpr double kBreak = std::numeric_limits<double>::quiet_NaN();
  std::vector<SvgPoint> result;
  result.reserve(points.size());
  for (const render::PlotPoint& p : points) {
    const bool inside = p.z_nm >= window.z_min_nm && p.z_nm <= window.z_max_nm && p.force_nn >= window.force_min_nn;
    result.push_back(inside ? SvgPoint{p.z_nm, p.force_nn} : SvgPoint{kBreak, kBreak});
  }
  return result;
}

SvgPlot plot_within(const std::vector<RecordedSession>& sessions, const scene::MaterialLibrary& materials,
                    std::string title, const Window& window) {
  SvgPlot plot;
  plot.title = std::move(title);
  plot.x_label = "Z, piezo displacement (nm)";
  plot.y_label = "force on the tip (nN)";
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    const RecordedSession& session = sessions[i];
    const render::PlotCurve curve = curve_until(session, session.samples.back().time_ns).plot(session.material, {});
    const scene::MaterialEntry* material = materials.find(session.material);
    const std::string name = material != nullptr ? material->title : session.material;
    plot.lines.push_back({name + ", approach", std::string(distinct_color(i)), LineStyle::Dashed,
                          points_within(curve.approach, window)});
    plot.lines.push_back(
        {name + ", retract", std::string(distinct_color(i)), LineStyle::Solid, points_within(curve.retract, window)});
  }
  return plot;
}

}  // namespace

std::string curves_svg(const std::vector<RecordedSession>& sessions, const scene::MaterialLibrary& materials) {
  // mica and silicon nitride whole, gold's jump to contact
  constexpr Window kNear{.z_min_nm = -7.0, .z_max_nm = 22.0, .force_min_nn = -1.8};
  return svg(plot_within(sessions, materials, "Approach and retract", {})) + "\n" +
         svg(plot_within(sessions, materials, "The same, near the surface", kNear));
}

}  // namespace afm::app
