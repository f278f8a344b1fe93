// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace afm::curves {

// Remark on a table that undo_spreadsheet() restored.
inline constexpr const char* kSavedBySpreadsheet = "a spreadsheet saved it again, which may have rounded its numbers";

// A table between commas as it was before a spreadsheet saved it again: without the quotes and the empty cells of its
// heading, and with commas and decimal points where a spreadsheet of another language wrote semicolons and decimal
// commas. `column` is a name in the line of the columns. Lines keep their numbers. Empty: there is nothing to undo.
std::optional<std::string> undo_spreadsheet(std::string_view bytes, std::string_view column);

}  // namespace afm::curves
