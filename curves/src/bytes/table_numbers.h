// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "curves/table_columns.h"

namespace afm::curves {

// Numbers of a plain table in SI, one list for each column; that of a column that is not read is empty.
struct TableNumbers {
  std::vector<std::vector<double>> columns;
  std::vector<std::string> remarks;  // remarks on headings with other units and on a line of counts
};

// Throws CurveError, with the line, for anything that is ambiguous: decimal commas between commas, or both decimal
// marks.
TableNumbers table_numbers(std::string_view bytes, const TableColumns& columns);

}  // namespace afm::curves
