// SPDX-License-Identifier: Apache-2.0
#include "exhibit/parameter_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "curves/plot_units.h"
#include "panel_conventions.h"
#include "physics/quantity_text.h"

namespace afm::exhibit {

namespace {

constexpr glm::vec3 kPredictionColor{0.80F, 0.82F, 0.86F};

std::string length(physics::Length value) {
  return curves::typographic(format_quantity(value, physics::kLengthUnits, kDigits));
}
std::string pull(physics::Force value) {
  return curves::typographic(format_quantity(-value, physics::kForceUnits, kDigits));
}

std::vector<std::string> notes(const curves::LiveParameters& parameters) {
  const physics::CycleFigures& figures = parameters.model().figures();
  const physics::LawChoice& suited = parameters.model().contact;
  std::vector<std::string> lines;
  if (figures.hysteretic) {
    lines.push_back(fmt::format("Snap-in {} at {}", pull(figures.force_after_jtc), length(figures.z_jtc)));
    lines.push_back(fmt::format("Pull-off {} at {}", pull(figures.force_before_joc), length(figures.z_joc)));
    lines.push_back("Loop " + format_quantity(figures.loop_energy, physics::kEnergyUnits, kDigits));
  } else {
    lines.emplace_back("No jump: the lever is stiffer than the force is steep");
  }
  lines.push_back(
      fmt::format("Tabor {:.3g}, {} regime: {} suits", suited.tabor, name_of(suited.regime), name_of(suited.law)));
  if (std::isfinite(figures.critical_stiffness.si)) {
    lines.push_back("No hysteresis from k = " +
                    format_quantity(figures.critical_stiffness, physics::kStiffnessUnits, kDigits));
  } else {
    lines.emplace_back("Hysteresis with any lever");
  }
  return lines;
}

const char* text_of(ChangeState state) {
  switch (state) {
    case ChangeState::Waiting:
      return "changed: lift the tip to feel it";
    case ChangeState::Applied:
      return "changed, and felt like this";
    case ChangeState::Refused:
      return "this cannot be felt on the device";
    case ChangeState::AsLoaded:
      break;
  }
  return "as in the material file";
}

double strongest_pull_n(const physics::ForceCurve& curve) {
  double force = 0.0;
  for (const physics::CurveSample& sample : curve.samples)
    force = std::max(force, std::abs(std::min(sample.force.si, 0.0)));
  return force;
}

}  // namespace

render::ControlPanel parameter_panel(const curves::LiveParameters& parameters, const std::string& title,
                                     ChangeState state) {
  render::ControlPanel panel;
  panel.title = title;
  panel.status = parameters.refusal().empty() ? text_of(state) : parameters.refusal();
  for (std::size_t i = 0; i < curves::LiveParameters::kRows; ++i) {
    const auto row = static_cast<curves::LiveParameters::Row>(i);
    panel.rows.push_back(
        {.name = parameters.name(row), .value = parameters.value(row), .changed = parameters.changed(row)});
  }
  panel.notes = notes(parameters);
  panel.buttons = {"Reset", "Close"};
  return panel;
}

void add_prediction(const curves::LiveParameters& parameters, render::ForcePanel& panel) {
  const physics::CycleFigures& figures = parameters.model().figures();
  render::PlotCurve predicted{
      .label = "predicted", .color = kPredictionColor, .faded = true, .approach = {}, .retract = {}};
  for (const physics::CurveSample& sample : parameters.curve().samples) {
    auto& branch = sample.branch == physics::Branch::Approach ? predicted.approach : predicted.retract;
    branch.push_back({.z_nm = sample.z.si * curves::kNmPerM, .force_nn = sample.force.si * curves::kNnPerN});
  }
  panel.curves.insert(panel.curves.begin(), std::move(predicted));

  const double reach_nm = curves::cycle_reach_m(parameters.model()) * curves::kNmPerM;
  const double deepest_nn = std::abs(parameters.curve().samples.back().force.si) * curves::kNnPerN;
  const double pull_nn = strongest_pull_n(parameters.curve()) * curves::kNnPerN;
  const double span_nn = pull_nn > 0.0 ? pull_nn : std::max(deepest_nn, 1e-3);
  panel.z_min_nm = -curves::kReachBelow * reach_nm;
  panel.z_max_nm = curves::kReachAbove * reach_nm;
  panel.force_min_nn = -kForceBelow * span_nn;
  panel.force_max_nn = kForceAbove * span_nn;
  panel.markers.clear();
  if (!figures.hysteretic) return;
  using Kind = render::PlotMarker::Kind;
  const double z_jtc = figures.z_jtc.si * curves::kNmPerM, z_joc = figures.z_joc.si * curves::kNmPerM;
  const double f_attr = -figures.force_after_jtc.si * curves::kNnPerN,
               f_ad = -figures.force_before_joc.si * curves::kNnPerN;
  panel.markers = {{Kind::VerticalLine, z_jtc, fmt::format("Z_jtc {:.3g} nm", z_jtc)},
                   {Kind::VerticalLine, z_joc, fmt::format("Z_joc {:.3g} nm", z_joc)},
                   {Kind::HorizontalLine, -f_attr, fmt::format("F_attr {:.3g} nN", f_attr)},
                   {Kind::HorizontalLine, -f_ad, fmt::format("F_ad {:.3g} nN", f_ad)}};
}

}  // namespace afm::exhibit
