// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/command_line.h"

namespace afm::app {

// Implementation of enum_option.
Option choice_option(OptionList& command, const std::string& name, std::function<void(std::size_t row)> store,
                     const std::string& sort, const std::vector<std::string_view>& names,
                     const std::string& description);

// Adds an option whose value is the `name` of a row of `table`; the row's `value` goes to `target`. Help and error list
// the names. `sort` describes them: "a stereo mode". The table must live as long as the command.
template <class Target, class Table, class Row, class Name, class Value>
Option enum_option(OptionList& command, const std::string& option, Target& target, const std::string& sort,
                   const Table& table, Name Row::* name, Value Row::* value, const std::string& description) {
  std::vector<std::string_view> names;
  names.reserve(std::size(table));
  for (const Row& row : table) names.emplace_back(row.*name);
  return choice_option(
      command, option, [&target, &table, value](std::size_t row) { target = table[row].*value; }, sort, names,
      description);
}

}  // namespace afm::app
