// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/swing_panel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "curves/plot_units.h"
#include "panels/panel_conventions.h"
#include "physics/quantity_text.h"
#include "physics/tapping/driven_lever.h"
#include "physics/tapping/tap_surface.h"
#include "physics/tapping/tap_table.h"
#include "scene/shared/shared_segment.h"

namespace afm::exhibit {

namespace {

constexpr glm::vec3 kAttractiveColor{0.337F, 0.706F, 0.914F}, kRepulsiveColor{0.902F, 0.624F, 0.0F},
    kNowColor{0.00F, 0.78F, 0.56F}, kEdgeColor{0.80F, 0.47F, 0.65F}, kCircleColor{0.6F, 0.6F, 0.6F};
constexpr double kMargin = 0.08;  // fraction of the circle beside it
constexpr int kPointsOfCircle = 90;
constexpr double kWidest = 4.0;             // diameter of the largest circle shown as a whole, in free amplitudes
constexpr double kShownOfWider = 2.0;       // extent of the dial in free amplitudes, if the circle is wider
constexpr double kHeightsOfSwing = 2000.0;  // number of heights with separate portraits, per free amplitude

render::PlotPoint end_of(double amplitude_m, double phase_rad) {
  return {.place_nm = amplitude_m * std::cos(phase_rad) * curves::kNmPerM,
          .force_nn = amplitude_m * std::sin(phase_rad) * curves::kNmPerM};
}

// Adds a hand from the origin to a point, or as far as the axes reach.
void add_hand(const std::string& label, const glm::vec3& color, const render::PlotPoint& end,
              render::ForcePanel& panel) {
  const double across = std::abs(end.place_nm) / panel.place_max_nm;
  const double upwards = end.force_nn / (end.force_nn < 0.0 ? panel.force_min_nn : panel.force_max_nn);
  const double beyond = std::max({1.0, across, upwards});
  panel.curves.push_back({.label = label,
                          .color = color,
                          .faded = false,
                          .approach = {},
                          .retract = {{}, {end.place_nm / beyond, end.force_nn / beyond}}});
}

bool within_axes(const render::PlotPoint& point, const render::ForcePanel& panel) {
  return point.place_nm >= panel.place_min_nm && point.place_nm <= panel.place_max_nm &&
         point.force_nn >= panel.force_min_nn && point.force_nn <= panel.force_max_nn;
}

// Adds the parts of a line within the axes, in the same colour; the first one has the label.
void add_within_axes(const std::vector<render::PlotPoint>& line, render::PlotCurve look, render::ForcePanel& panel) {
  const auto end_part = [&] {
    if (look.retract.size() > 1) {
      panel.curves.push_back(look);
      look.label.clear();
    }
    look.retract.clear();
  };
  for (const render::PlotPoint& point : line) {
    if (within_axes(point, panel)) {
      look.retract.push_back(point);
    } else {
      end_part();
    }
  }
  end_part();
}

// Circle through the origin and the largest swing of this drive.
std::vector<render::PlotPoint> circle(double diameter_m) {
  std::vector<render::PlotPoint> line;
  for (int i = 0; i <= kPointsOfCircle; ++i) {
    const double phase = std::numbers::pi * i / kPointsOfCircle;
    line.push_back(end_of(diameter_m * std::sin(phase), phase));
  }
  return line;
}

// The part within the axes of a circle that is wider: from one side through the origin to the other.
std::vector<render::PlotPoint> arc_within(double diameter_m, const render::ForcePanel& panel) {
  constexpr int kHalvings = 50, kPointsOfSide = kPointsOfCircle / 2;
  const auto at = [diameter_m](double phase) { return end_of(diameter_m * std::sin(phase), phase); };
  double inside = 0.0, outside = 0.5 * std::numbers::pi;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (inside + outside);
    (within_axes(at(middle), panel) ? inside : outside) = middle;
  }
  std::vector<render::PlotPoint> line;
  for (int i = -kPointsOfSide; i <= kPointsOfSide; ++i) {
    const double turn = inside * i / kPointsOfSide;
    // the left half lags by more than a right angle
    line.push_back(at(turn < 0.0 ? std::numbers::pi + turn : turn));
  }
  return line;
}

std::vector<render::PlotPoint> line_of(const std::vector<physics::SwingPoint>& edge) {
  std::vector<render::PlotPoint> line;
  line.reserve(edge.size());
  for (const physics::SwingPoint& point : edge) {
    line.push_back({.place_nm = point.u.si * curves::kNmPerM, .force_nn = point.v.si * curves::kNmPerM});
  }
  return line;
}

void add_state(const physics::TapState& state, const physics::DrivenLever& lever, const Phrases& phrases,
               render::ForcePanel& panel) {
  const bool attracted = std::sin(state.phase - lever.free_phase) > 0.0;
  const bool free = std::abs(state.amplitude / lever.free_amplitude - 1.0) < kFreeSwing;
  const Phrase name = free ? Phrase::SwingFree : attracted ? Phrase::SwingAttractive : Phrase::SwingRepulsive;
  add_hand(phrases[name], attracted || free ? kAttractiveColor : kRepulsiveColor,
           end_of(state.amplitude.si, state.phase), panel);
}

}  // namespace

const physics::TapPortrait& SwingDial::portrait(const curves::SampleModel& model, double z_m, double reach_m) {
  const double step_m = model.parameters.free_amplitude_m / kHeightsOfSwing;
  if (tables_ != model.tables) {
    const scene::SharedContact& sample = model.parameters;
    surface_ = std::make_shared<const physics::TapSurface>(sample.law, sample.contact, scene::law_options(sample),
                                                           physics::Viscosity(sample.viscosity_pa_s));
    tables_ = model.tables;
    height_.reset();
  }
  // under the hand the base goes no deeper
  const auto height = static_cast<std::int64_t>(std::ceil(std::max(z_m, model.tables->pressed_to.si) / step_m));
  if (height_ == height) return portrait_;
  height_ = height;
  const physics::Length z(static_cast<double>(height) * step_m);
  if (model.tables->taps) {
    portrait_ = {.states = model.tables->taps->states_at(z), .edges = {}};
    return portrait_;
  }
  portrait_ = physics::tap_portrait(surface_, scene::tapping_lever(model.parameters), z, physics::Length(reach_m));
  return portrait_;
}

render::ForcePanel SwingDial::panel(const curves::SampleModel& model, const scene::TipState& tip,
                                    const Phrases& phrases) {
  const physics::DrivenLever lever = scene::tapping_lever(model.parameters);
  const double diameter_m = lever.quality_factor * lever.base_amplitude.si / lever.ratio;
  const double a0_m = lever.free_amplitude.si;
  const bool whole = diameter_m <= kWidest * a0_m;
  const double shown_nm = (whole ? diameter_m : kShownOfWider * a0_m) * curves::kNmPerM;
  render::ForcePanel panel;
  panel.title = phrases[Phrase::DialTitle];
  panel.words = {.approach = {},
                 .retract = {},
                 .place_axis = "A cos (nm)",
                 .force_axis = "A sin (nm)",
                 .decimal_mark = phrases.decimal_mark()};
  panel.place_max_nm = (0.5 + kMargin) * shown_nm;
  panel.place_min_nm = -panel.place_max_nm;
  panel.force_min_nn = -2.0 * kMargin * shown_nm;
  panel.force_max_nn = (1.0 + 2.0 * kMargin) * shown_nm;
  const auto look = [](const std::string& label, const glm::vec3& color, bool faded) {
    return render::PlotCurve{.label = label, .color = color, .faded = faded, .approach = {}, .retract = {}};
  };
  // of a circle that is shown in part the legend has the diameter
  const std::string size = physics::format_quantity(physics::Length(diameter_m), physics::kLengthUnits, 3);
  const std::string name = whole ? "" : "\u00d8 " + size;
  add_within_axes(whole ? circle(diameter_m) : arc_within(diameter_m, panel), look(name, kCircleColor, true), panel);

  const double reach_m = std::hypot(panel.place_max_nm, panel.force_max_nn) / curves::kNmPerM;
  const physics::TapPortrait& portrait = this->portrait(model, tip.tip.z_m, reach_m);
  panel.stage = phrases[portrait.states.size() > 1 ? Phrase::DialBoth : Phrase::DialOne];
  std::string label = phrases[Phrase::DialEdge];
  for (const std::vector<physics::SwingPoint>& edge : portrait.edges) {
    const std::size_t before = panel.curves.size();
    add_within_axes(line_of(edge), look(label, kEdgeColor, false), panel);
    if (panel.curves.size() > before) label.clear();
  }
  for (const physics::TapState& state : portrait.states) add_state(state, lever, phrases, panel);
  if (tip.swing.amplitude_m > 0.0) {
    panel.cursor = end_of(tip.swing.amplitude_m, tip.swing.phase_rad);
    add_hand(phrases[Phrase::DialNow], kNowColor, *panel.cursor, panel);
  }
  return panel;
}

}  // namespace afm::exhibit
