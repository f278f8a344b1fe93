// SPDX-License-Identifier: Apache-2.0
#include "app/curves_plot.h"

#include <limits>

#include "app/cycle_curve.h"
#include "app/svg_plot.h"

namespace afm::app {

namespace {

std::vector<SvgPoint> points_within(const std::vector<render::PlotPoint>& points, double z_max_nm,
                                    double force_min_nn) {
  constexpr double kBreak = std::numeric_limits<double>::quiet_NaN();
  std::vector<SvgPoint> result;
  result.reserve(points.size());
  for (const render::PlotPoint& p : points) {
    const bool inside = p.z_nm <= z_max_nm && p.force_nn >= force_min_nn;
    result.push_back(inside ? SvgPoint{p.z_nm, p.force_nn} : SvgPoint{kBreak, kBreak});
  }
  return result;
}

SvgPlot plot_within(const std::vector<RecordedSession>& sessions, const scene::MaterialLibrary& materials,
                    std::string title, double z_max_nm, double force_min_nn) {
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
                          points_within(curve.approach, z_max_nm, force_min_nn)});
    plot.lines.push_back({name + ", retract", std::string(distinct_color(i)), LineStyle::Solid,
                          points_within(curve.retract, z_max_nm, force_min_nn)});
  }
  return plot;
}

}  // namespace

std::string curves_svg(const std::vector<RecordedSession>& sessions, const scene::MaterialLibrary& materials) {
  constexpr double kEverything = std::numeric_limits<double>::infinity();
  constexpr double kNearNm = 22.0, kNearNn = -1.8;  // mica and silicon nitride whole, gold's jump to contact
  return svg(plot_within(sessions, materials, "Approach and retract", kEverything, -kEverything)) + "\n" +
         svg(plot_within(sessions, materials, "The same, near the surface", kNearNm, kNearNn));
}

}  // namespace afm::app
