// SPDX-License-Identifier: Apache-2.0
#include "app/options/enum_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace afm::app {

Option choice_option(OptionList& command, const std::string& name, std::function<void(std::size_t row)> store,
                     const std::string& sort, const std::vector<std::string_view>& names,
                     const std::string& description) {
  const auto read = [store = std::move(store), sort, names](const std::string& text) -> core::Result<void> {
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) {
      return core::failure(core::ErrorCategory::WrongUsage,
                           fmt::format("\"{}\" is not {}; choose {}", text, sort, fmt::join(names, ", ")));
    }
    store(static_cast<std::size_t>(found - names.begin()));
    return {};
  };
  return command.add_parsed_option(name, read, description).type_name(fmt::format("{{{}}}", fmt::join(names, ",")));
}

}  // namespace afm::app
