// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/options/command.h"
#include "app/options/curve_fit_options.h"
#include "curves/fitting/curve_fit.h"

namespace afm::app {

// Adds --fit and its options, which write into `options` while the parser lives. Returns them with their names.
std::vector<NamedOption> add_fit_options(OptionList& command, curves::FitOptions& options);

}  // namespace afm::app
