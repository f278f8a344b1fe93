// SPDX-License-Identifier: Apache-2.0
#include "curves/tapping/tapping_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "curves/tapping/tapping_run.h"
#include "over_all_cores.h"
#include "physics/quantity_text.h"
#include "tapping/tap_regimes.h"

namespace afm::curves {
namespace {

using core::wrong_usage;

constexpr std::string_view kFreeAmplitude = "free-amplitude", kHeight = "z";

double degrees_of(const physics::TapState& state) { return state.phase * 180.0 / std::numbers::pi; }

// Parameters of a map beside the numbers of the contact: not fields of a setup.
ContactParameter length_beside(std::string_view option, std::string_view json_key) {
  return {.option = option,
          .json_key = json_key,
          .source_keys = {},
          .help = {},
          .sort = physics::kLengthUnits.sort,
          .units = physics::kLengthUnits.units,
          .infinity = physics::Infinity::Refused,
          .get = [](const ContactSetup&) { return std::optional<double>(); },
          .set = [](ContactSetup&, double) {}};
}

std::span<const ContactParameter> parameters_beside() {
  static const std::array rows{length_beside(kFreeAmplitude, "free_amplitude_m"), length_beside(kHeight, "z_m")};
  return rows;
}

// The setup and the texts at a point; a work of adhesion that follows from --contact-gap follows the point.
core::Result<std::pair<ContactSetup, TappingOptions>> at_point(const TappingSweep& sweep,
                                                               const std::array<double, 2>& at) {
  std::pair<ContactSetup, TappingOptions> point{sweep.setup, sweep.choice.numbers};
  auto& [setup, numbers] = point;
  for (std::size_t a = 0; a < sweep.axes.size(); ++a) {
    const ContactParameter& parameter = *sweep.axes[a].parameter;
    if (parameter.option == kFreeAmplitude) {
      numbers.free_amplitude = fmt::format("{}m", at[a]);
    } else if (parameter.option == kHeight) {
      numbers.at = fmt::format("{}m", at[a]);
    } else {
      override_parameter(setup, parameter, at[a], format_parameter(parameter, at[a]), "--sweep");
    }
  }
  if (sweep.choice.contact_gap.empty()) return point;
  const auto gap = physics::parse_quantity(sweep.choice.contact_gap, physics::kLengthUnits);
  const auto work = work_of_adhesion_for(setup, gap.value.value());
  if (!work) return tl::unexpected(work.error());
  override_parameter(setup, *find_contact_parameter("work-of-adhesion"), work->si,
                     physics::format_quantity(*work, physics::kSurfaceEnergyUnits), "--contact-gap");
  return point;
}

// Sets the states at a height.
void take_states(const TappingRun& run, TapSweepRow& row) {
  constexpr std::size_t kAttractive = 0, kRepulsive = 1;
  std::array<const physics::RestingTap*, 2> states{};
  for (const TapStateRow& state : run.states) {
    if (!state.tap.stable) continue;
    const std::size_t kind = state.tap.averages.virial < physics::Energy() ? kRepulsive : kAttractive;
    if (states.at(kind) == nullptr) states.at(kind) = &state.tap;
  }
  for (const physics::RestingTap* state : states) {
    row.values.push_back(state == nullptr ? kNoValue : state->state.amplitude.si);
    row.values.push_back(state == nullptr ? kNoValue : degrees_of(state->state));
    row.values.push_back(state == nullptr ? kNoValue : state->averages.peak.si);
  }
  const bool attracts = states[kAttractive] != nullptr, repels = states[kRepulsive] != nullptr;
  if (!attracts && !repels) {
    row.refusal = "no swing is stable at this height";
    return;
  }
  const std::size_t regime = attracts && repels ? 2 : repels ? 1 : 0;
  row.regime = kRegimesAtHeight.at(regime).word;
}

// Sets the results of the curve down and up.
void take_curve(const TappingRun& run, TapSweepRow& row) {
  const physics::TapJump *in = nullptr, *off = nullptr;
  for (const physics::TapJump& jump : run.curve.jumps) {
    const bool repels = jump.after.phase < jump.before.phase;
    if (jump.branch == physics::Branch::Approach && repels && in == nullptr) in = &jump;
    if (jump.branch == physics::Branch::Retract && !repels && off == nullptr) off = &jump;
  }
  for (const physics::TapJump* jump : {in, off}) {
    row.values.push_back(jump == nullptr ? kNoValue : jump->z.si);
    for (const physics::TapState physics::TapJump::* side : {&physics::TapJump::before, &physics::TapJump::after}) {
      row.values.push_back(jump == nullptr ? kNoValue : (jump->*side).amplitude.si);
      row.values.push_back(jump == nullptr ? kNoValue : degrees_of(jump->*side));
    }
  }
  row.values.push_back(in != nullptr && off != nullptr ? (off->z - in->z).si : kNoValue);
  row.values.push_back(static_cast<double>(run.curve.islands.size()));
  // the phase of the free lever, with the error of a swing at rest
  const double free = run.lever.free_phase;
  const auto passes = [&](double sign) {
    constexpr double kClearly = 0.02;  // smallest clear difference of phases, rad
    return std::any_of(run.curve.points.begin(), run.curve.points.end(),
                       [&](const physics::TapPoint& point) { return sign * (point.state.phase - free) > kClearly; });
  };
  const bool attracts = passes(1.0), repels = passes(-1.0);
  const std::size_t regime = in != nullptr || off != nullptr ? 3 : attracts && repels ? 2 : repels ? 1 : 0;
  row.regime = kRegimesOfCurve.at(regime).word;
}

TapSweepRow sweep_row(const TappingSweep& sweep, const std::array<double, 2>& at) {
  TapSweepRow row{.at = at, .regime = {}, .values = {}, .refusal = {}};
  const auto point = at_point(sweep, at);
  const auto run = point ? run_tapping(point->first, {}, point->second) : tl::unexpected(point.error());
  if (!run) {
    row.refusal = run.error().message;
    row.values.assign(columns_of(sweep).size(), kNoValue);
  } else if (sweep.at_heights) {
    take_states(*run, row);
  } else {
    take_curve(*run, row);
  }
  return row;
}

core::Result<void> check_choice(const TappingChoice& choice) {
  if (choice.mode != "tapping") return wrong_usage("--sweep has no effect on --mode fm; remove it");
  if (!choice.numbers.at.empty()) {
    return wrong_usage("--at has no effect with --sweep; sweep the height: --sweep z=FROM:TO:COUNT");
  }
  if (choice.numbers.method == "direct") return wrong_usage("--method direct has no effect with --sweep; remove it");
  return {};
}

core::Result<std::vector<SweepAxis>> axes_of(const ContactSetup& setup, std::span<const std::string> texts) {
  if (texts.size() > 2) return wrong_usage("a sweep varies at most two parameters");
  std::vector<SweepAxis> axes;
  std::uint64_t count = 1;
  for (const std::string& text : texts) {
    auto axis = parse_sweep_axis(text, setup.model, parameters_beside());
    if (!axis) return wrong_usage("--sweep " + axis.error().message);
    if (!axes.empty() && axes.front().parameter == axis->parameter) {
      return wrong_usage(fmt::format("--sweep {}: this parameter is swept already", axis->parameter->option));
    }
    count *= axis->count;
    axes.push_back(std::move(*axis));
  }
  if (count > kLargestParameterSweep) {
    return wrong_usage(fmt::format("the sweep has {} points; at most {} may be", count, kLargestParameterSweep));
  }
  return axes;
}

}  // namespace

std::string swept_free_amplitude(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || text.substr(0, equals) != kFreeAmplitude) return {};
  return text.substr(equals + 1, text.find(':', equals) - equals - 1);
}

core::Result<TappingSweep> run_tapping_sweep(const ContactSetup& setup, const TappingChoice& choice,
                                             std::span<const std::string> axes) {
  if (const auto checked = check_choice(choice); !checked) return tl::unexpected(checked.error());
  auto parsed = axes_of(setup, axes);
  if (!parsed) return tl::unexpected(parsed.error());
  TappingSweep sweep{.setup = setup, .choice = choice, .axes = std::move(*parsed), .at_heights = false, .rows = {}};
  sweep.choice.numbers.method = "averaged";
  sweep.at_heights = std::any_of(sweep.axes.begin(), sweep.axes.end(),
                                 [](const SweepAxis& axis) { return axis.parameter->option == kHeight; });
  std::uint64_t count = 1;
  for (const SweepAxis& axis : sweep.axes) count *= axis.count;
  sweep.rows.resize(count);
  const std::uint64_t fastest = sweep.axes.back().count;
  over_all_cores(count, {}, [&](std::uint64_t i) {
    std::array<double, 2> at{sweep.axes.front().value(sweep.axes.size() == 1 ? i : i / fastest), 0.0};
    if (sweep.axes.size() == 2) at[1] = sweep.axes[1].value(i % fastest);
    sweep.rows[i] = sweep_row(sweep, at);
  });
  const bool none =
      std::all_of(sweep.rows.begin(), sweep.rows.end(), [](const TapSweepRow& row) { return !row.refusal.empty(); });
  if (none) return wrong_usage("no point of the sweep has a swing; the first: " + sweep.rows.front().refusal);
  return sweep;
}

}  // namespace afm::curves
