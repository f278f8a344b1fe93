// SPDX-License-Identifier: Apache-2.0
#include "app/options/parsed_option.h"

#include <CLI/CLI.hpp>
#include <utility>

namespace afm::app {

CLI::Option* parsed_option(CLI::App& command, const std::string& name,
                           std::function<core::Result<void>(const std::string& text)> read,
                           const std::string& description) {
  const auto parse = [name, read = std::move(read)](const std::string& text) {
    if (const auto done = read(text); !done) throw CLI::ValidationError(name, done.error().message);
  };
  return command.add_option_function<std::string>(name, parse, description);
}

}  // namespace afm::app
