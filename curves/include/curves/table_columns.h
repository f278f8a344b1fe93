// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "core/result.h"

namespace afm::curves {

// Content of a column of a plain table. Height: that of the lever's base; tip position: base plus deflection, the
// "separation" of other programs. Retract: the way back, at the heights of the way in, in reverse order, unless there
// are retract heights.
enum class ColumnKind {
  Height,
  TipPosition,
  Force,
  Deflection,
  RetractHeight,
  RetractTipPosition,
  RetractForce,
  RetractDeflection,
  Segment,
  Time,
  Nothing
};

struct TableColumn {
  ColumnKind kind = ColumnKind::Nothing;
  double si_per_unit = 1;  // factor to SI; V for a deflection in volts; negative if the sign is reversed
  bool volts = false;
};

// Columns of a table from the left.
using TableColumns = std::vector<TableColumn>;

// Parses "height:um force:nN": the columns' names with their units, separated by blanks; "-" is a column that is not
// read, and "deflection:-V" one whose sign is reversed. WrongUsage, with the names and units that are known, for
// anything else, and unless there are one height or tip position and one force or deflection.
core::Result<TableColumns> parse_table_columns(std::string_view text);

}  // namespace afm::curves
