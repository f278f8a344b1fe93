// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "app/analyse/fit_options.h"
#include "app/options/command_line.h"
#include "core/result.h"
#include "curves/curve_file.h"

namespace afm::app {

// Converts "70nm/V" to metres per volt. WrongUsage if the text is malformed or the value not positive.
core::Result<double> parse_sensitivity(std::string_view text);

// Adds the options for how a curve is read. They write into `reading` while the parser lives.
std::vector<NamedOption> add_reading_options(OptionList& command, curves::CurveReading& reading);

}  // namespace afm::app
