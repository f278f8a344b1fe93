// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace afm::curves {

// Number of a field of a plain table, and how it is written.
struct TableNumber {
  double value = 0;
  bool has_point = false, has_comma = false;  // decimal marks found
  // True for "1,020", whose comma may also separate thousands; true for "990".
  bool may_have_thousands = false, is_whole = false;
};

// Fields of a line. A blank as separator is any number of blanks and tabs; commas within quotes separate nothing.
void split_line(std::string_view line, char separator, std::vector<std::string_view>& fields);

// Number in quotes or without, with a decimal comma where commas do not separate, or in quotes. Empty for anything
// else.
std::optional<TableNumber> table_number(std::string_view field, char separator);

// True for a line such as "1.0e+03 *", by which MATLAB's display multiplies the numbers below.
bool is_factor(std::string_view line);

}  // namespace afm::curves
