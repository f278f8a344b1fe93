// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/enumerators.h"
#include "curves/live_parameters.h"
#include "exhibit/models/height_colours.h"
#include "exhibit/panels/parameter_panel.h"
#include "exhibit/scan/scan_cause.h"
#include "exhibit/scenery/wall_marks.h"
#include "physics/quantity_text.h"
#include "scan/image_maps.h"

namespace afm::exhibit {

namespace {

// smallest ranges of the shades in tapping mode
constexpr double kLeastPhaseDeg = 2.0, kLeastErrorM = 0.05e-9, kLeastEnergyJ = 1e-20;
constexpr double kTipOfRelief = 1.5;  // shown height of the tip in units of the sample's range; the rest cannot touch

render::ColorGrid colored(const std::vector<double>& map, const Range& range, Srgb (*color)(double)) {
  constexpr auto kSide = static_cast<std::uint32_t>(LiveScan::kPixels);
  render::ColorGrid grid{.columns = kSide, .rows = kSide, .colors = {}};
  grid.colors.reserve(map.size());
  for (const double value : map) {
    const auto [r, g, b] = std::isfinite(value) ? color((value - range.low) / (range.high - range.low)) : Srgb{};
    grid.colors.push_back({r, g, b, static_cast<std::uint8_t>(std::isfinite(value) ? 255 : 0)});
  }
  return grid;
}

// A row of the image from left to right, in nanometres above `low_m`.
std::vector<glm::vec2> line_of(const std::vector<double>& map, std::size_t row, double side_nm, double low_m) {
  std::vector<glm::vec2> points;
  for (std::size_t column = 0; column < LiveScan::kPixels; ++column) {
    const double height_m = map[row * LiveScan::kPixels + column];
    if (!std::isfinite(height_m)) continue;
    const double x_nm = (static_cast<double>(column) + 0.5) / static_cast<double>(LiveScan::kPixels) * side_nm;
    points.emplace_back(x_nm, (height_m - low_m) * 1e9);
  }
  return points;
}

render::ProfilePlot newest_line(const LiveScan& scan, const Range& heights, const Phrases& phrases) {
  const double side_nm = scan.subject().side_m * 1e9, high_nm = (heights.high - heights.low) * 1e9;
  render::ProfilePlot plot{.title = phrases[Phrase::ScanNewestLine],
                           .low = {0.0, -0.06 * high_nm},
                           .high = {side_nm, 1.30 * high_nm},  // top with room for the legend
                           .lines = {}};
  const auto row = scan.newest_row();
  if (!row) return plot;
  plot.lines = {{.label = phrases[Phrase::ScanTraceShort],
                 .color = kTraceColor,
                 .dashed = false,
                 .points = line_of(scan.maps().height_m[0], *row, side_nm, heights.low)},
                {.label = phrases[Phrase::ScanRetraceShort],
                 .color = kRetraceColor,
                 .dashed = true,
                 .points = line_of(scan.maps().height_m[1], *row, side_nm, heights.low)}};
  return plot;
}

constexpr std::array<std::uint8_t, 4> kUnreached{70, 150, 235, 255};

void mark(const std::vector<std::uint8_t>& unreached, render::ColorGrid& grid) {
  for (std::size_t i = 0; i < grid.colors.size(); ++i) {
    if (unreached[i] == 0 || grid.colors[i][3] == 0) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      grid.colors[i][c] = static_cast<std::uint8_t>((grid.colors[i][c] + 2 * kUnreached[c]) / 3);
    }
  }
}

std::vector<glm::vec2> nanometres(const TipProfile& tip) {
  std::vector<glm::vec2> points(tip.points_m.size());
  std::transform(tip.points_m.begin(), tip.points_m.end(), points.begin(),
                 [](const glm::dvec2& point) { return glm::vec2(1e9 * point); });
  return points;
}

// Replaces the retrace by the sample and the newest line by the tips.
void add_truth(const ScanTruth& truth, const std::vector<double>& trace_m, const Range& heights, const Phrases& phrases,
               render::ImagePanel& panel) {
  const auto [low, high] = std::minmax_element(truth.reach.sample.height_m.begin(), truth.reach.sample.height_m.end());
  const Range common{std::min(heights.low, *low + heights.high - *high), heights.high};
  const Range sample{common.low - heights.high + *high, *high};
  panel.subtitle = phrases.text<Phrase::ScanTruthSubtitle>(fmt::format("{:.0f}", 100.0 * truth.reach.unreached_share));
  panel.heights[0].grid = colored(trace_m, common, height_colour);
  panel.heights[1] = {phrases[Phrase::ScanSample], colored(truth.reach.sample.height_m, sample, height_colour)};
  for (render::ImageMap& map : panel.heights) mark(truth.reach.unreached, map.grid);
  panel.bar_high_nm = (common.high - common.low) * 1e9;
  const double reach_nm = truth.true_tip.points_m.back().x * 1e9;
  double highest_nm = truth.true_tip.points_m.back().y * 1e9;
  for (const glm::dvec2& point : truth.revealed_tip.points_m) highest_nm = std::max(highest_nm, 1e9 * point.y);
  highest_nm = std::min(highest_nm, kTipOfRelief * (*high - *low) * 1e9);
  panel.profile = {.title = phrases[Phrase::ScanTipShape],
                   .low = {-reach_nm, -0.06 * highest_nm},
                   .high = {reach_nm, 1.35 * highest_nm},
                   .lines = {{.label = phrases[Phrase::ScanTipTrue],
                              .color = kTraceColor,
                              .dashed = false,
                              .points = nanometres(truth.true_tip)}}};
  if (truth.revealed_tip.points_m.empty()) return;
  panel.profile.lines.push_back({.label = phrases[Phrase::ScanTipFound],
                                 .color = kRetraceColor,
                                 .dashed = true,
                                 .points = nanometres(truth.revealed_tip)});
}

// The image painted by a hand: on the left the measured quantity, on the right the controlled one. Cells without a
// visit have no colour.
render::ImagePanel painted_panel(const LiveScan& scan, const std::string& sample, const Phrases& phrases) {
  const ScanMaps& maps = scan.maps();
  const bool feedback = scan.progress().hand->feedback;
  const double side_nm = scan.subject().side_m * 1e9;
  const Range heights = at_least(range_of(maps.height_m[0]), kLeastRangeM);
  const Range deflections = at_least(range_of(maps.height_m[1]), kLeastRangeM);
  const Range x = at_least(range_of(maps.lateral_n[0]), kLeastForceN);
  const Range y = at_least(range_of(maps.lateral_n[1]), kLeastForceN);
  const Range& seen = feedback ? heights : deflections;

  render::ImagePanel panel;
  panel.title = phrases.text<Phrase::ScanTitle>(sample);
  const std::string side = side_text(scan.subject().side_m), percent = fmt::format("{:.0f}", 100 * scan.seen_share());
  panel.subtitle =
      feedback ? phrases.text<Phrase::ScanByHand>(side, percent) : phrases.text<Phrase::ScanByHandOpen>(side, percent);
  panel.decimal_mark = phrases.decimal_mark();
  const render::ImageMap height{phrases[feedback ? Phrase::ScanHeight : Phrase::ScanHandHeight],
                                colored(maps.height_m[0], heights, height_colour)};
  const render::ImageMap deflection{phrases[Phrase::ScanDeflection],
                                    colored(maps.height_m[1], deflections, height_colour)};
  panel.heights = {feedback ? height : deflection, feedback ? deflection : height};
  panel.smaller = {{phrases.text<Phrase::ScanLateralX>(nanonewtons(x)), colored(maps.lateral_n[0], x, grey)},
                   {phrases.text<Phrase::ScanLateralY>(nanonewtons(y)), colored(maps.lateral_n[1], y, grey)}};
  const double high_nm = (seen.high - seen.low) * 1e9;
  panel.profile = {.title = phrases[Phrase::ScanNewestLine],
                   .low = {0.0, -0.06 * high_nm},
                   .high = {side_nm, 1.30 * high_nm},
                   .lines = {}};
  if (const auto row = scan.newest_row()) {
    panel.profile.lines = {{.label = panel.heights[0].title,
                            .color = kTraceColor,
                            .dashed = false,
                            .points = line_of(maps.height_m[feedback ? 0 : 1], *row, side_nm, seen.low)}};
    panel.line = (static_cast<double>(*row) + 0.5) / static_cast<double>(LiveScan::kPixels);
  }
  show_side(scan.subject().side_m, panel);
  show_heights(high_nm, panel);
  return panel;
}

// Phase in place of the retrace, which the newest line still shows; amplitude error and energy in place of forces.
void show_maps_of_swing(const ScanMaps& maps, const Phrases& phrases, render::ImagePanel& panel) {
  const Range phase = at_least(range_of(maps.phase_deg[0]), kLeastPhaseDeg);
  const Range errors = at_least(range_of(maps.error_n[0]), kLeastErrorM);
  const Range energy = at_least(range_of(maps.energy_j[0]), kLeastEnergyJ);
  const auto degrees = [](double deg) { return fmt::format("{:.0f}", deg); };
  panel.heights[1] = {phrases.text<Phrase::ScanPhase>(degrees(phase.low), degrees(phase.high)),
                      colored(maps.phase_deg[0], phase, grey)};
  panel.smaller = {{phrases.text<Phrase::ScanAmplitudeError>(fmt::format("{:.2g}", 0.5e9 * (errors.high - errors.low))),
                    colored(maps.error_n[0], errors, grey)},
                   {phrases.text<Phrase::ScanEnergy>(fmt::format("{:.2g}", 1e18 * energy.high)),
                    colored(maps.energy_j[0], energy, grey)}};
}

// Names of the rows in the order of ScanRow.
constexpr std::array<Phrase, 9> kRowNames{
    Phrase::ScanSetpoint,   Phrase::ScanGain,          Phrase::ScanRate,
    Phrase::TipRadius,      Phrase::ScanNoise,         Phrase::ScanDrift,
    Phrase::ScanSecondApex, Phrase::ScanFreeAmplitude, Phrase::ScanDriveFrequency};
static_assert(kRowNames.size() == core::kEnumerators<ScanRow>.size());

bool hand_uses_tip(physics::Phase phase, scene::ServoState state) {
  return phase == physics::Phase::Attached || state == scene::ServoState::Running || state == scene::ServoState::Arming;
}

}  // namespace

render::ImagePanel image_panel(const LiveScan& scan, const std::string& sample, const Phrases& phrases) {
  if (scan.is_painted()) return painted_panel(scan, sample, phrases);
  const ScanMaps& maps = scan.maps();
  const Range heights = at_least(range_of(maps.height_m[0], maps.height_m[1]), kLeastRangeM);
  const Range errors = at_least(range_of(maps.error_n[0], {}), kLeastForceN);
  const Range lateral = at_least(range_of(maps.lateral_n[0], {}), kLeastForceN);

  render::ImagePanel panel;
  panel.title = phrases.text<Phrase::ScanTitle>(sample);
  panel.subtitle =
      phrases.text<Phrase::ScanSubtitle>(side_text(scan.subject().side_m), value_text(scan.choice(), ScanRow::Rate),
                                         fmt::format("{}", scan.row() + 1), fmt::format("{}", LiveScan::kPixels));
  if (scan.is_tapped()) {
    const physics::Length a0(scan.choice().free_amplitude_m);
    panel.subtitle +=
        ", " + phrases.text<Phrase::ScanInTapping>(physics::format_quantity(a0, physics::kLengthUnits, 3));
  } else if (scan.subject().tapped) {
    panel.subtitle += ", " + phrases[Phrase::ScanInContact];
  }
  panel.decimal_mark = phrases.decimal_mark();
  panel.heights = {render::ImageMap{phrases[Phrase::ScanTrace], colored(maps.height_m[0], heights, height_colour)},
                   render::ImageMap{phrases[Phrase::ScanRetrace], colored(maps.height_m[1], heights, height_colour)}};
  panel.smaller = {
      {phrases.text<Phrase::ScanError>(nanonewtons(errors)), colored(maps.error_n[0], errors, grey)},
      {phrases.text<Phrase::ScanLateral>(nanonewtons(lateral)), colored(maps.lateral_n[0], lateral, grey)}};
  if (scan.is_tapped()) show_maps_of_swing(maps, phrases, panel);
  panel.profile = newest_line(scan, heights, phrases);
  show_side(scan.subject().side_m, panel);
  panel.line = (static_cast<double>(scan.row()) + 0.5) / static_cast<double>(LiveScan::kPixels);
  show_heights((heights.high - heights.low) * 1e9, panel);
  if (scan.truth()) add_truth(*scan.truth(), maps.height_m[0], heights, phrases, panel);
  return panel;
}

render::ControlPanel scan_panel(const LiveScan& scan, const std::string& title, const Phrases& phrases) {
  render::ControlPanel panel;
  panel.title = phrases.text<Phrase::ScanTitle>(title);
  panel.status = scan_guidance(scan, phrases);
  for (const ScanRow row : scan.rows()) {
    const std::string value = value_text(scan.choice(), row), usual = value_text(scan.usual(), row);
    const bool amplitude = row == ScanRow::Setpoint && scan.is_tapped();
    panel.rows.push_back({.name = phrases[amplitude ? Phrase::ScanAmplitude : kRowNames[core::index_of(row)]],
                          .value = value.empty() ? phrases[Phrase::ScanOneApex] : phrases.number(value),
                          .changed = value != usual});
  }
  panel.notes = {phrases[Phrase::ScanNoteKeys], phrases[Phrase::ScanNoteTruth]};
  panel.buttons = {phrases[Phrase::ButtonReset], phrases[Phrase::ButtonClose]};
  return panel;
}

std::string scan_guidance(const LiveScan& scan, const Phrases& phrases) {
  static_assert(after(Phrase::CauseNone, core::kEnumerators<physics::ScanArtefact>.size()) == Phrase::Keys);
  const physics::ScanArtefact cause = cause_of(scan);
  // a lower amplitude holds a tip better, a lower force worse
  if (scan.is_tapped() && cause == physics::ScanArtefact::LostContact) return phrases[Phrase::CauseLostSwing];
  if (scan.is_tapped() && cause == physics::ScanArtefact::Parachuting) return phrases[Phrase::CauseSwingInFlight];
  return phrases[after(Phrase::CauseNone, core::index_of(cause))];
}

bool hand_uses_tip(const scene::TipState& tip) { return hand_uses_tip(tip.phase, tip.servo_state); }

void show_scan(const LiveScan& scan, Moment& moment) {
  WallState& wall = moment.wall;
  wall.scan = true;
  moment.scan = &scan;
  if (scan.is_painted()) return;  // scan whose tip belongs to the hand
  const glm::dvec3 apex_m = scan.apex_m();
  constexpr int kSamples = 64;
  const double half_m = 0.5 * scan.subject().shown_side_m();
  double highest_m = apex_m.z;
  for (int i = 0; i <= kSamples; ++i) {
    highest_m = std::max(highest_m, scan.surface_m(half_m * (2.0 * i / kSamples - 1.0), apex_m.y));
  }
  wall.scan_line = {glm::dvec3(-half_m, apex_m.y, highest_m), glm::dvec3(half_m, apex_m.y, highest_m)};
  if (!scan.progress().hand && hand_uses_tip(moment.phase, moment.servo_state)) return;
  wall.swing = {};
  wall.surface = {.xy_m = {apex_m.x, apex_m.y}, .height_m = apex_m.z};
  if (const physics::TappingDetector* tapping = scan.scanner().loop().tapping()) {
    // the mean force bends a tapping lever too little to be seen
    const double amplitude_m = tapping->amplitude_m();
    wall.swing = {.amplitude_m = amplitude_m, .phase_rad = tapping->phase_rad()};
    wall.tip = {.z_m = amplitude_m, .force_n = 0.0, .height_m = amplitude_m, .deflection_m = 0.0};
    return;
  }
  const double deflection_m = -scan.force_n() / settings_of(scan.choice(), 0.0).spring_constant.si;
  wall.tip = {.z_m = deflection_m, .force_n = scan.force_n(), .height_m = 0.0, .deflection_m = deflection_m};
}

}  // namespace afm::exhibit
