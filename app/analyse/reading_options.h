// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/options/command_line.h"
#include "app/options/curve_fit_options.h"
#include "curves/curve_file.h"

namespace afm::app {

// Adds the options for how a curve is read. They write into `reading` while the parser lives.
std::vector<NamedOption> add_reading_options(OptionList& command, curves::CurveReading& reading);

}  // namespace afm::app
