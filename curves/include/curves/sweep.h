// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/contact_setup.h"
#include "curves/curve_run.h"

namespace afm::curves {

// A parameter with `count` values from `from` to `to`, both included, or with any values.
struct SweepAxis {
  const ContactParameter* parameter = nullptr;
  double from = 0.0;  // first value, SI
  double to = 0.0;    // last value, SI
  std::uint64_t count = 0;
  bool logarithmic = false;
  std::vector<double> values{};  // `count` values, SI; empty: determined by the members above

  double value(std::uint64_t index) const;
};

// Largest number of points of a sweep. A larger number is probably a mistake.
inline constexpr std::uint64_t kLargestParameterSweep = 1'000'000;

// Parses "spring-constant=0.01N/m:1N/m:50", with ":log" at the end for equal ratios. WrongUsage quotes the text and
// explains the fault; the caller adds the option's name. `more`: parameters beside those of the contact, which outlive
// the axis; their functions are not called.
core::Result<SweepAxis> parse_sweep_axis(const std::string& text, const ModelName& model,
                                         std::span<const ContactParameter> more = {});

// Results of one cycle at one point of a sweep; forces signed. Without hysteresis the jumps are null.
struct SweepRow {
  std::array<double, 2> at{};  // value on each axis, SI
  std::string model;
  std::string regime;  // regime of the contact; empty, and tabor and maugis NaN, without a position on the map
  double tabor = 0.0;
  double maugis = 0.0;
  double snap_in_z_m = 0.0;  // Z of the jump to contact; this and the next two NaN without a jump
  double snap_in_force_before_n = 0.0;
  double snap_in_force_after_n = 0.0;
  double pull_off_z_m = 0.0;  // Z of the jump off contact; this and the next NaN without a jump
  double pull_off_force_n = 0.0;
  double loop_energy_j = 0.0;
  double critical_stiffness_n_per_m = 0.0;  // critical stiffness; infinite if the hysteresis never vanishes
  std::string refusal;                      // reason why these values have no such curve; all others are then unknown
};

// Computes every point of one axis or of the grid of two, the last axis running fastest, on all cores. The rows are
// always in the grid's order. Dynamic models record a curve at each point, with the path's step and speed. Logs its
// progress if it takes longer than a second. Fails if no point has a curve, and once `stop` is requested.
core::Result<std::vector<SweepRow>> run_sweep(const ContactSetup& setup, const std::vector<SweepAxis>& axes,
                                              const PathOptions& path, const std::stop_token& stop = {});

// Parameters of the axes.
std::vector<const ContactParameter*> swept_parameters(const std::vector<SweepAxis>& axes);

// CSV in SI: a # header with every number that is not swept, then one line per point.
std::string sweep_csv(const ContactSetup& setup, const std::vector<SweepAxis>& axes, const std::vector<SweepRow>& rows);
nlohmann::ordered_json sweep_json(const ContactSetup& setup, const std::vector<SweepAxis>& axes,
                                  const std::vector<SweepRow>& rows);

}  // namespace afm::curves
