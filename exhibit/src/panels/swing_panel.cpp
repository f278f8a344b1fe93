// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/swing_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "curves/plot_units.h"
#include "physics/tapping/driven_lever.h"
#include "scene/shared/shared_segment.h"

namespace afm::exhibit {

namespace {

constexpr glm::vec3 kAttractiveColor{0.337F, 0.706F, 0.914F}, kRepulsiveColor{0.902F, 0.624F, 0.0F},
    kNowColor{0.00F, 0.78F, 0.56F}, kCircleColor{0.6F, 0.6F, 0.6F};
constexpr double kMargin = 0.08;  // share of the circle beside it
constexpr int kPointsOfCircle = 90;
constexpr double kAtResonance = 1e-6;  // largest distance of the drive, as a share of it

render::PlotPoint end_of(double amplitude_m, double phase_rad) {
  return {.place_nm = amplitude_m * std::cos(phase_rad) * curves::kNmPerM,
          .force_nn = amplitude_m * std::sin(phase_rad) * curves::kNmPerM};
}

render::PlotCurve hand(const std::string& label, const glm::vec3& color, const render::PlotPoint& end) {
  return {.label = label, .color = color, .faded = false, .approach = {}, .retract = {{}, end}};
}

// The circle through the origin and the free swing.
render::PlotCurve circle(double diameter_m) {
  render::PlotCurve curve{.label = "", .color = kCircleColor, .faded = true, .approach = {}, .retract = {}};
  for (int i = 0; i <= kPointsOfCircle; ++i) {
    const double phase = std::numbers::pi * i / kPointsOfCircle;
    curve.retract.push_back(end_of(diameter_m * std::sin(phase), phase));
  }
  return curve;
}

bool has_no_loss(const scene::SharedContact& parameters) {
  const bool latches = parameters.law == physics::Law::Jkr || parameters.law == physics::Law::MaugisDugdale;
  return !latches && parameters.viscosity_pa_s == 0.0 && parameters.has_meniscus == 0;
}

}  // namespace

render::ForcePanel swing_panel(const curves::SampleModel& model, const scene::TipState& tip, const Phrases& phrases) {
  const physics::DrivenLever lever = scene::tapping_lever(model.parameters);
  const double diameter_m = lever.quality_factor * lever.base_amplitude.si / lever.ratio;
  render::ForcePanel panel;
  panel.title = phrases[Phrase::DialTitle];
  panel.words = {.approach = {},
                 .retract = {},
                 .place_axis = "A cos (nm)",
                 .force_axis = "A sin (nm)",
                 .decimal_mark = phrases.decimal_mark()};
  const double reach_nm = (0.5 + kMargin) * diameter_m * curves::kNmPerM;
  panel.place_min_nm = -reach_nm;
  panel.place_max_nm = reach_nm;
  panel.force_min_nn = -2.0 * kMargin * diameter_m * curves::kNmPerM;
  panel.force_max_nn = (1.0 + 2.0 * kMargin) * diameter_m * curves::kNmPerM;
  panel.curves.push_back(circle(diameter_m));

  const physics::Length z(tip.tip.z_m);
  const bool attracts = z >= model.figures().z_jtc, repels = z <= model.figures().z_joc;
  panel.stage = phrases[attracts && repels ? Phrase::DialBoth : Phrase::DialOne];
  const auto add_state = [&](const physics::BranchTable& branch, bool attractive) {
    const double share = std::clamp(1.0 - branch.force(z) / model.tables->tapped_full, 0.0, 1.0);
    const double phase = attractive ? std::numbers::pi - std::asin(share) : std::asin(share);
    panel.curves.push_back(hand(phrases[attractive ? Phrase::SwingAttractive : Phrase::SwingRepulsive],
                                attractive ? kAttractiveColor : kRepulsiveColor,
                                end_of(share * lever.free_amplitude.si, phase)));
  };
  if (std::abs(lever.ratio - 1.0) < kAtResonance && has_no_loss(model.parameters)) {
    if (attracts) add_state(model.tables->free, true);
    if (repels) add_state(model.tables->attached, false);
  }
  if (tip.swing.amplitude_m > 0.0) {
    panel.cursor = end_of(tip.swing.amplitude_m, tip.swing.phase_rad);
    panel.curves.push_back(hand(phrases[Phrase::DialNow], kNowColor, *panel.cursor));
  }
  return panel;
}

}  // namespace afm::exhibit
