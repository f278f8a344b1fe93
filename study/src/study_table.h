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

// A table of text with tabs: one header row, then lines; n/a is given as an empty field.
struct TsvTable {
  std::string name;                                  // name of the file
  std::vector<std::vector<std::string_view>> lines;  // without the header, in the order of the wanted columns
  std::size_t cut_line = 0;                          // the number of a last line without its end, which is left out

  // Of a row of `lines`: the header is line 1.
  tl::unexpected<core::Error> bad(std::size_t row, const std::string& what) const;
};

// The columns may come in any order; each must be there once, and no other. At most 100000 lines. The views are into
// `bytes`.
core::Result<TsvTable> parse_tsv(std::string_view bytes, const std::string& name,
                                 std::span<const std::string_view> columns);

// A whole text as a number between two; nothing for anything else.
std::optional<double> parse_number(std::string_view text, double least, double most);

// Letters, digits, - _ . and + alone, at most 64.
bool is_word(std::string_view text);

}  // namespace afm::study
