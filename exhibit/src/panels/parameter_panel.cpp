// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/parameter_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/enumerators.h"
#include "curves/curve_map.h"
#include "curves/plot_units.h"
#include "panels/panel_conventions.h"
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

std::vector<std::string> notes(const curves::LiveParameters& parameters, const Phrases& phrases) {
  using enum Phrase;
  // for a single pixel the plot shows the jumps, and the picture needs the room
  if (parameters.model().felt_map) return {};
  if (const auto& pixel = parameters.model().pixel) {
    return pixel->measured.features.contact_doubtful ? std::vector{phrases[ContactDoubtful]}
                                                     : std::vector<std::string>();
  }
  const physics::CycleFigures& figures = parameters.model().figures();
  const physics::LawChoice& suited = parameters.model().contact;
  std::vector<std::string> lines;
  if (figures.hysteretic) {
    lines.push_back(phrases.text<NoteSnapIn>(pull(figures.force_after_jtc), length(figures.z_jtc)));
    lines.push_back(phrases.text<NotePullOff>(pull(figures.force_before_joc), length(figures.z_joc)));
    lines.push_back(phrases.text<NoteLoop>(format_quantity(figures.loop_energy, physics::kEnergyUnits, kDigits)));
  } else {
    lines.push_back(phrases[NoteNoJump]);
  }
  lines.push_back(phrases.text<NoteTabor>(fmt::format("{:.3g}", suited.tabor),
                                          phrases.word(std::string(name_of(suited.regime))),
                                          law_word(std::string(name_of(suited.law)), phrases)));
  lines.push_back(std::isfinite(figures.critical_stiffness.si)
                      ? phrases.text<NoteNoHysteresis>(
                            format_quantity(figures.critical_stiffness, physics::kStiffnessUnits, kDigits))
                      : phrases[HysteresisAlways]);
  return lines;
}

// Names in the order of LiveParameters::Row, and of ChangeState.
constexpr std::array<Phrase, curves::LiveParameters::kRows> kNames{
    Phrase::TipRadius,      Phrase::SpringConstant, Phrase::HamakerConstant, Phrase::WorkOfAdhesion,
    Phrase::ReducedModulus, Phrase::ForceLaw,       Phrase::PixelColumn,     Phrase::PixelRow};
static_assert(after(Phrase::ParametersLoaded, core::kEnumerators<ChangeState>.size()) == Phrase::NoSuchParameters);

std::string value_text(const curves::LiveParameters& parameters, curves::LiveParameters::Row row,
                       const Phrases& phrases) {
  using Row = curves::LiveParameters::Row;
  const scene::SharedContact& now = parameters.model().parameters;
  if (row == Row::ReducedModulus && !std::isfinite(now.contact.reduced_modulus.si)) return phrases[Phrase::Rigid];
  if (row == Row::Law) {
    const std::string law = law_word(curves::law_name(now), phrases);
    return parameters.automatic_law() ? phrases.text<Phrase::AutomaticLaw>(law) : law;
  }
  return phrases.number(parameters.value(row));
}

// Outcome of the last change.
Phrase status_of(const curves::LiveParameters& parameters, ChangeState state) {
  const bool of_map = parameters.model().pixel != nullptr;
  if (parameters.model().felt_map) return Phrase::MapFelt;
  if (!parameters.refusal().empty()) return of_map ? Phrase::NoSuchPixel : Phrase::NoSuchParameters;
  if (of_map && state == ChangeState::AsLoaded) return Phrase::PixelLoaded;
  return after(Phrase::ParametersLoaded, core::index_of(state));
}

double strongest_pull_n(const physics::ForceCurve& curve) {
  double force = 0.0;
  for (const physics::CurveSample& sample : curve.samples)
    force = std::max(force, std::abs(std::min(sample.force.si, 0.0)));
  return force;
}

}  // namespace

render::ControlPanel parameter_panel(const curves::LiveParameters& parameters, const std::string& title,
                                     ChangeState state, const Phrases& phrases, const std::string& drawn_by) {
  render::ControlPanel panel;
  panel.title = title;
  panel.status = phrases[status_of(parameters, state)];
  for (const curves::LiveParameters::Row row : parameters.rows()) {
    panel.rows.push_back({.name = phrases[kNames[core::index_of(row)]],
                          .value = value_text(parameters, row, phrases),
                          .changed = parameters.changed(row)});
  }
  panel.notes = notes(parameters, phrases);
  if (!drawn_by.empty() && !parameters.model().pixel)
    panel.notes.push_back(phrases.text<Phrase::NoteDrawnBy>(drawn_by));
  panel.buttons = {phrases[Phrase::ButtonReset], phrases[Phrase::ButtonClose]};
  return panel;
}

void add_forecast(const curves::LiveParameters& parameters, const Phrases& phrases, render::ForcePanel& panel) {
  render::PlotCurve predicted;
  predicted.label = phrases[Phrase::PlotPredicted];
  predicted.color = kPredictionColor;
  predicted.faded = true;
  const curves::SampleModel& model = parameters.model();
  const double a0_nm = model.parameters.free_amplitude_m * curves::kNmPerM;
  for (const physics::CurveSample& sample : parameters.curve().samples) {
    auto& branch = sample.branch == physics::Branch::Approach ? predicted.approach : predicted.retract;
    // tapping: the amplitude, from the push
    const double height =
        model.taps() ? a0_nm * (1.0 - sample.force / model.tables->tapped_full) : sample.force.si * curves::kNnPerN;
    branch.push_back({.place_nm = sample.z.si * curves::kNmPerM, .force_nn = height});
  }
  panel.curves.insert(panel.curves.begin(), std::move(predicted));
}

void add_prediction(const curves::LiveParameters& parameters, const Phrases& phrases, render::ForcePanel& panel) {
  add_forecast(parameters, phrases, panel);
  if (parameters.model().taps()) return;  // axes of a swing, without a forecast
  const physics::CycleFigures& figures = parameters.model().figures();
  const double reach_nm = curves::cycle_reach_m(parameters.model()) * curves::kNmPerM;
  const double deepest_nn = std::abs(parameters.curve().samples.back().force.si) * curves::kNnPerN;
  const double pull_nn = strongest_pull_n(parameters.curve()) * curves::kNnPerN;
  const double span_nn = pull_nn > 0.0 ? pull_nn : std::max(deepest_nn, 1e-3);
  panel.place_min_nm = -curves::kReachBelow * reach_nm;
  panel.place_max_nm = curves::kReachAbove * reach_nm;
  panel.force_min_nn = -kForceBelow * span_nn;
  panel.force_max_nn = kForceAbove * span_nn;
  panel.markers.clear();
  if (!figures.hysteretic) return;
  using Kind = render::PlotMarker::Kind;
  const double z_jtc = figures.z_jtc.si * curves::kNmPerM, z_joc = figures.z_joc.si * curves::kNmPerM;
  const double f_attr = -figures.force_after_jtc.si * curves::kNnPerN,
               f_ad = -figures.force_before_joc.si * curves::kNnPerN;
  panel.markers = {{Kind::VerticalLine, z_jtc, phrases.number(fmt::format("Z_jtc {:.3g} nm", z_jtc))},
                   {Kind::VerticalLine, z_joc, phrases.number(fmt::format("Z_joc {:.3g} nm", z_joc))},
                   {Kind::HorizontalLine, -f_attr, phrases.number(fmt::format("F_attr {:.3g} nN", f_attr))},
                   {Kind::HorizontalLine, -f_ad, phrases.number(fmt::format("F_ad {:.3g} nN", f_ad))}};
}

}  // namespace afm::exhibit
