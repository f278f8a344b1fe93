// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace afm::study {

// A tab-separated table: one header row, then lines; n/a becomes an empty field.
struct TsvTable {
  std::string name;                                  // name of the file
  std::vector<std::vector<std::string_view>> lines;  // fields without the header, in the order of the wanted columns
  std::size_t cut_line = 0;                          // number of the dropped last line without a line end; 0: none

  // Error for a row of `lines`: the header is line 1.
  tl::unexpected<core::Error> bad(std::size_t row, const std::string& what) const;
};

// Parses a table. The columns may be in any order; each must exist exactly once, and no other may exist. An older table
// may lack the last `newer` of them, whose fields are then empty. At most 100000 lines, with the line ends of Unix or
// Windows, with or without a byte order mark. The views refer to `bytes`.
core::Result<TsvTable> parse_tsv(std::string_view bytes, const std::string& name,
                                 std::span<const std::string_view> columns, std::size_t newer = 0);

// The whole text as a number within limits; empty for anything else.
std::optional<double> parse_number(std::string_view text, double least, double most);

// True for letters, digits, - _ . and + only, at most 64.
bool is_word(std::string_view text);

}  // namespace afm::study
