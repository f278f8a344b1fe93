// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "core/result.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace afm::app {

// An option whose text is read while the command line is parsed: what `read` refuses is wrong usage of that option.
CLI::Option* parsed_option(CLI::App& command, const std::string& name,
                           std::function<core::Result<void>(const std::string& text)> read,
                           const std::string& description);

}  // namespace afm::app
