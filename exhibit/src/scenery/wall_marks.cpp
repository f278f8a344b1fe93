// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scenery/wall_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "exhibit/scenery/wall_layout.h"

namespace afm::exhibit {

namespace {

using glm::dmat4;
using glm::dvec3;

constexpr double kSmallestBend = 0.02;  // layout units; smaller bends are hidden by the lines' thickness

scene::NodeIndex another(scene::Scene& scene, scene::NodeIndex of, std::string name, scene::NodeIndex parent) {
  scene::Node node = scene.nodes[of];
  node.name = std::move(name);
  node.parent = parent;
  scene.nodes.push_back(node);
  return static_cast<scene::NodeIndex>(scene.nodes.size() - 1);
}

}  // namespace

ScaleBar scale_bar(double m_per_unit, double longest) {
  const double limit_m = m_per_unit * longest;
  double decade = std::pow(10.0, std::floor(std::log10(limit_m)));
  if (decade > limit_m) decade /= 10.0;
  const double factor = 5.0 * decade <= limit_m ? 5.0 : 2.0 * decade <= limit_m ? 2.0 : 1.0;
  const double length_m = factor * decade;
  static constexpr std::array<std::pair<double, const char*>, 5> kUnits{
      {{1.0, "m"}, {1e-3, "mm"}, {1e-6, "\u00b5m"}, {1e-9, "nm"}, {1e-12, "pm"}}};
  const auto* unit = kUnits.begin();
  while (unit + 1 != kUnits.end() && length_m < unit->first * (1.0 - 1e-9)) ++unit;
  return {length_m, length_m / m_per_unit, fmt::format("{:.3g} {}", length_m / unit->first, unit->second)};
}

WallMarks::WallMarks(ModelBuilder& build, scene::Scene& scene, scene::NodeIndex layout, scene::NodeIndex sample) {
  build.model("marks.glb", "marks", layout);
  ruler_.line = build.node("marks/line");
  push_ = {build.node("marks/push"), build.node("marks/push-head")};
  pull_ = {build.node("marks/pull"), build.node("marks/pull-head")};
  if (build.error()) return;
  scene.nodes[ruler_.line].parent = layout;
  for (const scene::NodeIndex node : {push_.line, push_.head, pull_.line, pull_.head})
    scene.nodes[node].parent = sample;
  const auto pale = [&](const char* name, scene::NodeIndex parent) {
    return another(scene, ruler_.line, fmt::format("marks/{}", name), parent);
  };
  ruler_.low = pale("low", layout);
  ruler_.high = pale("high", layout);
  gap_ = {pale("gap", layout), pale("gap-low", layout), pale("gap-high", layout)};
  unbent_ = pale("unbent", sample);
  scan_line_ = another(scene, push_.line, "marks/scan", sample);
}

void WallMarks::Bar::place(const dvec3& from, const dvec3& to, std::vector<dmat4>& local) const {
  const dvec3 reach(kRulerTick, 0.0, 0.0);
  local[line] = stretched(from, to, kRulerRadius);
  local[low] = stretched(from - reach, from + reach, kRulerRadius);
  local[high] = stretched(to - reach, to + reach, kRulerRadius);
}

void WallMarks::place_ruler(const ScaleBar& bar, std::vector<dmat4>& local) const {
  ruler_.place(kRulerFoot, kRulerFoot + dvec3(0.0, bar.drawn, 0.0), local);
}

void WallMarks::place_gap(const dvec3& low, const dvec3& high, std::vector<dmat4>& local) const {
  gap_.place(low, high, local);
}

void WallMarks::place_unbent(const dvec3& clamp, const dvec3& end, std::vector<dmat4>& local) const {
  local[unbent_] = stretched(clamp, end, kUnbentRadius);
}

void WallMarks::hide_unbent(std::vector<dmat4>& local) const { local[unbent_] = dmat4(0.0); }

void WallMarks::place_scan_line(const dvec3& from, const dvec3& to, std::vector<dmat4>& local) const {
  local[scan_line_] = stretched(from, to, kScanLineRadius);
}

void WallMarks::place_force(const dvec3& unbent_end, const dvec3& end, std::vector<dmat4>& local) const {
  for (const scene::NodeIndex node : {push_.line, push_.head, pull_.line, pull_.head}) local[node] = dmat4(0.0);
  const double length = glm::distance(unbent_end, end);
  if (length <= kSmallestBend) return;
  const Arrow& arrow = end.z > unbent_end.z ? push_ : pull_;
  const double head = std::min(kForceHeadLength, 0.6 * length);
  const dvec3 neck = end - (end - unbent_end) * (head / length);
  local[arrow.line] = stretched(unbent_end, neck, kForceRadius);
  local[arrow.head] = stretched(neck, end, kForceHeadRadius * head / kForceHeadLength);
}

std::vector<scene::NodeIndex> WallMarks::lever_nodes() const {
  return {unbent_, push_.line, push_.head, pull_.line, pull_.head};
}

}  // namespace afm::exhibit
