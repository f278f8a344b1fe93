// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "curves/contact_setup.h"
#include "curves/svg_plot.h"
#include "curves/sweep.h"
#include "curves/tapping/tapped_hand.h"

namespace afm::curves {

// One point of a map of regimes.
struct TapSweepRow {
  std::array<double, 2> at{};  // value on each axis, SI
  std::string regime;          // word of regimes_of()
  std::vector<double> values;  // values in SI and degrees, in the order of columns_of(); NaN: no such value
  std::string refusal;         // reason why these values have no such swing; all other members are then unknown
};

// A lever that taps, averaged and at rest, over one or two parameters: the contact's, `free-amplitude`, and `z`. With
// `z` a point has the states at that height, otherwise the jumps of a slow curve down and up (run_tapping()).
struct TappingSweep {
  ContactSetup setup;
  TappingChoice choice;
  std::vector<SweepAxis> axes;
  bool at_heights = false;
  std::vector<TapSweepRow> rows;  // rows in the grid's order, the last axis running fastest
};

// First value of a text "free-amplitude=from:to:count"; empty for any other text.
std::string swept_free_amplitude(const std::string& text);

// Computes every point on all cores, and logs its progress if it takes longer than a second. `setup` is driven_setup()
// of `choice`. WrongUsage, naming the option, for texts that are no axes, for options without effect, for too many
// points, and if no point has a swing.
core::Result<TappingSweep> run_tapping_sweep(const ContactSetup& setup, const TappingChoice& choice,
                                             std::span<const std::string> axes);

// CSV in SI, with phases in degrees: a # header with every number that is not swept, the conventions and the regimes,
// then a row a point.
std::string tapping_sweep_csv(const TappingSweep& sweep);
nlohmann::ordered_json tapping_sweep_json(const TappingSweep& sweep);

// Two axes: a dot for each point in the colour of its regime. One: the heights of the jumps, or the amplitudes of the
// states.
SvgPlot tapping_sweep_plot(const TappingSweep& sweep);

}  // namespace afm::curves
