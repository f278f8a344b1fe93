// SPDX-License-Identifier: Apache-2.0
#include "curves/tapping/tapping_output.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "curves/curve_output.h"
#include "curves/plot_units.h"

namespace afm::curves {
namespace {

using json = nlohmann::ordered_json;
using physics::Branch;

constexpr std::string_view kAmplitudeConvention = "zero-to-peak";
constexpr std::string_view kPhaseConvention =
    "lag of the tip behind the drive: 90 degrees for a free lever at its resonance, more where the sample attracts on "
    "balance, less where it repels";
constexpr std::string_view kShiftConvention = "resonance with the sample minus resonance without";
constexpr std::string_view kForceConvention = "on the tip, positive away from the sample";
constexpr std::string_view kVirialConvention =
    "mean of force times deflection of the first harmonic: positive where the sample attracts on balance";
constexpr std::string_view kLossConvention =
    "energy lost in the sample per period; direct integration is off by up to 1e-4 k A0^2, so that without a loss it "
    "may "
    "be a little below zero";
constexpr std::string_view kHeightConvention =
    "z: the tip of the unbent lever, along the sample's outward normal from its undeformed surface";

double degrees(double rad) { return rad * 180.0 / std::numbers::pi; }

const char* name_of_branch(Branch branch) { return branch == Branch::Approach ? "approach" : "retract"; }
const char* name_of_method(physics::TapMethod method) {
  return method == physics::TapMethod::Averaged ? "averaged" : "direct";
}
const char* finder_of(const TapStateRow& row) { return row.swing ? "direct integration" : "averaging"; }
const char* name_of_state(const physics::SwingAverages& averages, bool repeats = true) {
  if (!repeats) return "restless";
  return averages.virial > physics::Energy() ? "attractive" : "repulsive";
}

// Columns of the sample's force in a swing, the same in every table.
constexpr std::string_view kAverageColumns =
    "mean_force_N,peak_force_N,lowest_height_m,contact_share,virial_J,energy_lost_J";

void append_averages(fmt::memory_buffer& text, const physics::SwingAverages& a) {
  fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}", a.mean.si + 0.0, a.peak.si + 0.0, a.lowest.si + 0.0,
                 a.contact_share, a.virial.si + 0.0, a.lost.si + 0.0);
}

json averages_json(const physics::SwingAverages& a) {
  return {{"mean_force_N", a.mean.si + 0.0},  {"peak_force_N", a.peak.si + 0.0}, {"lowest_height_m", a.lowest.si + 0.0},
          {"contact_share", a.contact_share}, {"virial_J", a.virial.si + 0.0},   {"energy_lost_J", a.lost.si + 0.0}};
}

json state_json(const physics::TapState& state) {
  return {{"amplitude_m", state.amplitude.si}, {"phase_deg", degrees(state.phase)}};
}

json conventions_json(bool tapping) {
  json result{{"amplitude", kAmplitudeConvention}};
  if (tapping) {
    result["phase"] = kPhaseConvention;
  } else {
    result["frequency_shift"] = kShiftConvention;
  }
  result["force"] = kForceConvention;
  result["virial"] = kVirialConvention;
  if (tapping) result["energy_lost"] = kLossConvention;
  result["height"] = kHeightConvention;
  return result;
}

std::string conventions_header(bool tapping) {
  std::string text = fmt::format("# amplitude: {}\n", kAmplitudeConvention);
  text += tapping ? fmt::format("# phase: {}\n", kPhaseConvention)
                  : fmt::format("# frequency shift: {}\n", kShiftConvention);
  text += fmt::format("# force: {}\n# virial: {}\n", kForceConvention, kVirialConvention);
  if (tapping) text += fmt::format("# energy lost: {}\n", kLossConvention);
  return text + fmt::format("# heights: {}\n", kHeightConvention);
}

std::string path_header(const physics::SweepPlan& plan) {
  return fmt::format("# from_m: {}\n# to_m: {}\n# step_m: {}\n", plan.from.si, plan.to.si, plan.step.si);
}

std::string drive_header(const TappingRun& run) {
  const physics::DrivenLever& lever = run.lever;
  std::string text = fmt::format("# free_amplitude_m: {}\n# drive_Hz: {}\n# viscosity_Pa_s: {}\n# method: {}\n",
                                 lever.free_amplitude.si, (lever.ratio * lever.resonance).si, run.viscosity.si,
                                 name_of_method(run.method));
  if (run.averages_lost_at) text += fmt::format("# averages_lost_at_m: {}\n", run.averages_lost_at->si);
  if (run.at) return text + fmt::format("# at_m: {}\n", run.at->si);
  text += path_header(run.path.plan);
  return run.path.speed ? text + fmt::format("# speed_m_per_s: {}\n", run.path.speed->si) : text;
}

json drive_json(const TappingRun& run) {
  const physics::DrivenLever& lever = run.lever;
  const physics::Frequency drive = lever.ratio * lever.resonance;
  const physics::Energy air = std::numbers::pi * lever.ratio / lever.quality_factor * lever.spring_constant *
                              lever.free_amplitude * lever.free_amplitude;
  return {{"free_amplitude_m", lever.free_amplitude.si},
          {"frequency_Hz", drive.si},
          {"ratio_to_resonance", lever.ratio},
          {"base_amplitude_m", lever.base_amplitude.si},
          {"force_N", (lever.spring_constant * lever.base_amplitude).si},
          {"free_phase_deg", degrees(lever.free_phase)},
          {"free_air_loss_W", air.si * drive.si},
          {"relaxation_time_s", lever.relaxation().si},
          {"integral_gain_without_overshoot_per_s", 0.25 / lever.relaxation().si}};
}

json path_json(const physics::SweepPlan& plan) {
  return {{"from_m", plan.from.si}, {"to_m", plan.to.si}, {"step_m", plan.step.si}};
}

json jump_json(const physics::TapJump& jump, bool moving) {
  json result{{"branch", name_of_branch(jump.branch)},
              {"kind", moving ? "phase passes that of the free lever" : "jump"},
              {"z_m", jump.z.si}};
  result["z_before_m"] = jump.z_before.si;
  result["z_after_m"] = jump.z_after.si;
  result["before"] = state_json(jump.before);
  result["after"] = state_json(jump.after);
  return result;
}

json island_json(const physics::TapIsland& island) {
  json result{{"meaning", "a stable state exists that this path does not reach"},
              {"lowest_z_m", island.lowest_z.si},
              {"highest_z_m", island.highest_z.si},
              {"z_m", island.z.si},
              {"state", name_of_state(island.example.averages)}};
  result.update(state_json(island.example.state));
  return result;
}

// Distance between the jumps, if there is one in each direction.
json width_json(const std::vector<physics::TapJump>& jumps) {
  if (jumps.size() != 2 || jumps[0].branch == jumps[1].branch) return nullptr;
  return jumps[1].z.si - jumps[0].z.si;
}

// Heights at which the swing does not repeat, in the order of the path: neighbours are one range.
json restless_json(const std::vector<physics::TapPoint>& points) {
  json ranges = json::array();
  const physics::TapPoint* before = nullptr;
  for (const physics::TapPoint& point : points) {
    const bool goes_on = before != nullptr && !before->repeats && before->branch == point.branch;
    before = &point;
    if (point.repeats) continue;
    if (!goes_on) ranges.push_back({{"branch", name_of_branch(point.branch)}, {"from_z_m", point.z.si}});
    ranges.back()["to_z_m"] = point.z.si;
  }
  return ranges;
}

// Results of direct integration only: the higher harmonics and their effects.
json harmonics_json(const physics::DirectSwing& swing, const physics::DrivenLever& lever) {
  json amplitudes = json::array();
  for (std::size_t n = 1; n < swing.harmonics.size(); ++n) amplitudes.push_back(swing.harmonics[n].si);
  const double w0 = lever.angular_resonance();
  const double air = lever.spring_constant.si / (w0 * lever.quality_factor) * swing.mean_square_velocity_si * 2.0 *
                     std::numbers::pi / lever.angular_drive();
  return {{"harmonics_m", std::move(amplitudes)},
          {"rms_deflection_m", std::sqrt(swing.mean_square.si)},
          {"virial_of_all_harmonics_J", swing.full_virial.si + 0.0},
          {"energy_lost_to_air_J", air}};
}

json states_json(const TappingRun& run) {
  json states = json::array();
  for (const TapStateRow& row : run.states) {
    json state = state_json(row.tap.state);
    if (row.start.empty()) {
      state["stable"] = row.tap.stable;
      state["found_by"] = finder_of(row);
    } else {
      state["start"] = row.start;
    }
    state["state"] = name_of_state(row.tap.averages, !row.swing || row.tap.stable);
    state["mean_deflection_m"] = row.tap.deflection.si + 0.0;
    state.update(averages_json(row.tap.averages));
    state["energy_cleveland_J"] = row.cleveland.si + 0.0;
    if (row.swing) state.update(harmonics_json(*row.swing, run.lever));
    states.push_back(std::move(state));
  }
  return states;
}

template <class Run>
json base_json(const Run& run, const char* mode) {
  json result = law_json(run.setup, run.model, run.place);
  result["mode"] = mode;
  result["conventions"] = conventions_json(mode == std::string_view("tapping"));
  json& parameters = result["parameters"] = parameters_json(run.setup);
  parameters["viscosity_Pa_s"] = run.viscosity.si;
  return result;
}

template <class Run>
std::string title_of_run(const Run& run, const char* what) {
  return fmt::format("{}, {}", run.setup.heading(), what);
}

std::string header_of(const FrequencyShiftRun& run) {
  return fmt::format("{}# amplitude_m: {}\n# viscosity_Pa_s: {}\n{}", setup_header(run.setup, run.model, run.place),
                     run.amplitude.si, run.viscosity.si,
                     run.at ? fmt::format("# at_m: {}\n", run.at->si) : path_header(run.plan));
}

std::string header_of(const TappingRun& run) {
  return setup_header(run.setup, run.model, run.place) + drive_header(run);
}

}  // namespace

std::string tapping_csv(const TappingRun& run) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# TouchAFM tapping curve\n{}{}", header_of(run), conventions_header(true));
  if (run.at) {
    fmt::format_to(out, "amplitude_m,phase_deg,mean_deflection_m,{},energy_cleveland_J,state,{}\n", kAverageColumns,
                   run.method == physics::TapMethod::Averaged ? "stable,found_by" : "start");
    for (const TapStateRow& row : run.states) {
      fmt::format_to(out, "{},{},{},", row.tap.state.amplitude.si, degrees(row.tap.state.phase),
                     row.tap.deflection.si + 0.0);
      append_averages(text, row.tap.averages);
      const std::string last = run.method == physics::TapMethod::Direct
                                   ? row.start
                                   : fmt::format("{},{}", row.tap.stable ? "yes" : "no", finder_of(row));
      fmt::format_to(out, ",{},{},{}\n", row.cleveland.si + 0.0,
                     name_of_state(row.tap.averages, !row.swing || row.tap.stable), last);
    }
    return fmt::to_string(text);
  }
  fmt::format_to(out, "z_m,amplitude_m,phase_deg,mean_deflection_m,{},energy_cleveland_J,branch,state\n",
                 kAverageColumns);
  for (const physics::TapPoint& point : run.curve.points) {
    fmt::format_to(out, "{},{},{},{},", point.z.si + 0.0, point.state.amplitude.si, degrees(point.state.phase),
                   point.deflection.si + 0.0);
    append_averages(text, point.averages);
    fmt::format_to(out, ",{},{},{}\n", point.cleveland.si + 0.0, name_of_branch(point.branch),
                   name_of_state(point.averages, point.repeats));
  }
  return fmt::to_string(text);
}

std::string frequency_shift_csv(const FrequencyShiftRun& run) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# TouchAFM frequency shift curve\n{}{}", header_of(run), conventions_header(false));
  fmt::format_to(out, "z_m,frequency_shift_Hz,small_amplitude_shift_Hz,{}\n", kAverageColumns);
  for (const physics::FrequencyShiftPoint& point : run.curve.points) {
    fmt::format_to(out, "{},{},{},", point.z.si + 0.0, point.shift.si + 0.0, point.small_amplitude_shift.si + 0.0);
    append_averages(text, point.averages);
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

nlohmann::ordered_json tapping_conventions() { return conventions_json(true); }

nlohmann::ordered_json tapping_json(const TappingRun& run) {
  json result = base_json(run, "tapping");
  result["drive"] = drive_json(run);
  result["method"] = name_of_method(run.method);
  if (run.averages_lost_at) result["averages_lost_at_m"] = run.averages_lost_at->si;
  if (run.at) {
    result["at_m"] = run.at->si;
    result["states"] = states_json(run);
    add_sources(result, run.setup);
    return result;
  }
  json& parameters = result["parameters"];
  parameters.update(path_json(run.path.plan));
  if (run.path.speed) parameters["speed_m_per_s"] = run.path.speed->si;
  json& jumps = result["jumps"] = json::array();
  for (const physics::TapJump& jump : run.curve.jumps) jumps.push_back(jump_json(jump, run.path.speed.has_value()));
  result["hysteresis_width_m"] = width_json(run.curve.jumps);
  result["work_on_hand_by_mean_force_J"] = run.curve.work_on_hand.si + 0.0;
  result["loop_of_amplitude_reduction_m2"] = run.curve.reduction_loop.si + 0.0;
  // searched only where all states are known and the tip is at rest
  if (run.method == physics::TapMethod::Averaged && !run.path.speed) {
    json& islands = result["islands"] = json::array();
    for (const physics::TapIsland& island : run.curve.islands) islands.push_back(island_json(island));
  } else {
    result["islands"] = nullptr;
  }
  result["restless"] = restless_json(run.curve.points);
  add_sources(result, run.setup);
  return result;
}

nlohmann::ordered_json frequency_shift_json(const FrequencyShiftRun& run) {
  json result = base_json(run, "fm");
  json& parameters = result["parameters"];
  parameters["amplitude_m"] = run.amplitude.si;
  if (run.at) {
    const physics::FrequencyShiftPoint& point = run.curve.points.front();
    result["at_m"] = run.at->si;
    result["frequency_shift_Hz"] = point.shift.si + 0.0;
    result["small_amplitude_shift_Hz"] = point.small_amplitude_shift.si + 0.0;
    result.update(averages_json(point.averages));
    add_sources(result, run.setup);
    return result;
  }
  parameters.update(path_json(run.plan));
  json& turns = result["turns"] = json::array();
  for (const physics::FrequencyShiftTurn& turn : run.curve.turns) {
    turns.push_back({{"z_m", turn.z.si}, {"frequency_shift_Hz", turn.shift.si}});
  }
  result["feedback_unstable_below_m"] = run.curve.turns.empty() ? json() : json(run.curve.turns.front().z.si);
  add_sources(result, run.setup);
  return result;
}

std::vector<SvgPlot> tapping_plots(const TappingRun& run) {
  std::vector<SvgPlot> plots(2);
  plots[0].title = title_of_run(run, "tapping");
  plots[0].about = header_of(run);
  plots[0].y_label = "amplitude A, zero-to-peak (nm)";
  plots[1].y_label = "phase lag (degrees)";
  for (std::size_t i = 0; i < plots.size(); ++i) {
    SvgLine approach{"approach", std::string(distinct_color(0)), LineStyle::Dashed, {}};
    SvgLine retract{"retract", std::string(distinct_color(0)), LineStyle::Solid, {}};
    for (const physics::TapPoint& point : run.curve.points) {
      const double y = i == 0 ? point.state.amplitude.si * kNmPerM : degrees(point.state.phase);
      SvgLine& line = point.branch == Branch::Approach ? approach : retract;
      line.points.push_back({point.z.si * kNmPerM, y});
    }
    plots[i].x_label = "piezo displacement Z (nm)";
    plots[i].lines = {std::move(approach), std::move(retract)};
  }
  for (const physics::TapJump& jump : run.curve.jumps) {
    const bool in = jump.branch == Branch::Approach;
    plots[0].marks.push_back({{jump.z.si * kNmPerM, jump.after.amplitude.si * kNmPerM},
                              fmt::format("{:.4g} nm", jump.z.si * kNmPerM),
                              "#1d2329",
                              in ? SvgMark::Side::Left : SvgMark::Side::Right});
  }
  return plots;
}

std::vector<SvgPlot> frequency_shift_plots(const FrequencyShiftRun& run) {
  std::vector<SvgPlot> plots(1);
  plots[0].title = title_of_run(run, "frequency modulation");
  plots[0].about = header_of(run);
  plots[0].x_label = "mean height Z (nm)";
  plots[0].y_label = "frequency shift (Hz)";
  SvgLine line{"", std::string(distinct_color(0)), LineStyle::Solid, {}};
  for (const auto& point : run.curve.points) line.points.push_back({point.z.si * kNmPerM, point.shift.si});
  plots[0].lines = {std::move(line)};
  for (const auto& turn : run.curve.turns) {
    plots[0].marks.push_back({{turn.z.si * kNmPerM, turn.shift.si},
                              fmt::format("turns at {:.4g} nm", turn.z.si * kNmPerM),
                              "#1d2329",
                              SvgMark::Side::Right});
  }
  return plots;
}

}  // namespace afm::curves
