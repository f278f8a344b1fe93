// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "curves/lever/lever_calibration.h"
#include "curves/svg_plot.h"

namespace afm::curves {

// Results as lines with units; as JSON in SI, null for values that were not computed; the spectrum with its model on
// logarithmic axes.
std::string lever_text(const LeverOptions& options, const LeverCalibration& result);
nlohmann::ordered_json lever_json(const LeverOptions& options, const LeverCalibration& result);
SvgPlot lever_plot(const LeverCalibration& result);

}  // namespace afm::curves
