// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "python/errors.h"

namespace afm::python {

// The row of a table with that name. ValueError, with all names, if there is none; `sort` names the kind of row: "law".
template <class Table>
const auto& row_named(const Table& table, std::string_view name, std::string_view sort) {
  std::string names;
  for (const auto& row : table) {
    if (row.name == name) return row;
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  refuse(fmt::format("unknown {} \"{}\"; choose {}", sort, name, names));
}

}  // namespace afm::python
