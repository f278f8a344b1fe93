// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/options/command_line.h"

namespace afm::app {

// Adds --uncertainty, which collects its values into `texts`. `example` is of the form "radius=5%".
Option uncertainty_option(OptionList& command, std::vector<std::string>& texts, std::string_view example,
                          const std::string& description);

}  // namespace afm::app
