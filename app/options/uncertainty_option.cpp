// SPDX-License-Identifier: Apache-2.0
#include "app/options/uncertainty_option.h"

#include <fmt/format.h>

namespace afm::app {

Option uncertainty_option(OptionList& command, std::vector<std::string>& texts, std::string_view example,
                          const std::string& description) {
  return command.add_option("--uncertainty", texts, description)
      .one_value_each()
      .type_name(fmt::format("KEY=VALUE such as {}", example));
}

}  // namespace afm::app
