// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/options/command_line.h"
#include "core/result.h"
#include "curves/curve_file.h"
#include "curves/fitting/curve_fit.h"

namespace afm::app {

struct NamedOption {
  Option option;
  std::string name;
};

// Converts "70nm/V" to metres per volt. WrongUsage if the text is malformed or the value not positive.
core::Result<double> parse_sensitivity(std::string_view text);

// Converts "0.06N/m". WrongUsage if the text is malformed or outside the range for a contact.
core::Result<physics::Stiffness> parse_spring_constant(std::string_view text);

// Adds --sensitivity, which writes into `reading` while the parser lives. Returns it with its name.
NamedOption add_sensitivity_option(OptionList& command, curves::CurveReading& reading);

// Same for --columns.
NamedOption add_columns_option(OptionList& command, curves::CurveReading& reading);

// Adds --spring-constant and --sensitivity, which write into `reading` while the parser lives. Returns them with their
// names.
std::vector<NamedOption> add_calibration_options(OptionList& command, curves::CurveReading& reading);

// Same for --fit, whose help begins with `help`, and for its sizes and limits.
std::vector<NamedOption> add_shape_options(OptionList& command, curves::FitOptions& options, const std::string& help);

}  // namespace afm::app
