// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "confined/confined_child.h"
#include "core/result.h"
#include "core/whole_file.h"
#include "curves/curve_error.h"
#include "curves/unread_kinds.h"

namespace afm::curves {

inline constexpr const char* kNotSurvived = "it is damaged: its reader could not survive it";

// The whole file. BadInputFile if it is larger than 256 MiB.
core::Result<std::string> bytes_of_file(const std::string& path);

// Reason for the exception that is being handled, for a person; rethrows faults of our own.
std::string reason_of_failure();

// Runs `read` in a child that can open nothing. `hand_over` converts its result to bytes, and `take_over` converts them
// back. `confined` false: runs it here.
template <class Read, class HandOver, class TakeOver>
auto read_confined(bool confined, const Read& read, const HandOver& hand_over, const TakeOver& take_over,
                   const ChildTime& time = kFileTime) {
  if (!confined) return read();
  return take_over(in_confined_child([&] { return hand_over(read()); }, kNotSurvived, time));
}

// The formats of one kind of file, which are known by their content. A Row has bool (*begins)(std::string_view bytes)
// and its `files`, as the table lists them.
template <class Row, std::size_t Count>
struct FormatTable {
  const char* kind;                                           // kind of file, "curve"
  std::string_view (*other_kind_of)(std::string_view bytes);  // kind of a file of another table, or empty
  const char* files;                                          // names of all formats, as refusals list them
  std::size_t longest_beginning;                              // number of bytes that `begins` needs
  std::array<Row, Count> rows;  // rows by precedence: the first whose `begins` is true applies

  // Returns whether `files` contains the text of every row.
  constexpr bool names_all() const {
    return std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
      return std::string_view(files).find(row.files) != std::string_view::npos;
    });
  }

  // Row for a content; null: no known format.
  constexpr const Row* row_of(std::string_view bytes) const {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.begins(bytes); });
    return found != rows.end() ? &*found : nullptr;
  }

  // Refusal of a file of another kind, which is named as far as its beginning shows.
  std::string refusal_of(std::string_view bytes) const {
    std::string true_kind = unread_kind_of(bytes, bytes.size());
    if (true_kind.empty()) true_kind = other_kind_of(bytes);
    if (true_kind.empty()) return fmt::format("it is no {} of a known kind; known are {}", kind, files);
    return fmt::format("it is {}; known are {}", true_kind, files);
  }

  // The row of a regular file by its beginning. Null: of no known format, or no file that can be read.
  const Row* row_of_file(const std::string& path) const {
    const auto beginning = core::read_beginning(path, longest_beginning);
    return beginning ? row_of(without_byte_order_mark(*beginning)) : nullptr;
  }

  // The result of `read`, or BadInputFile with the name of the file for what it throws.
  template <class Read>
  auto named(const std::string& name, const Read& read) const -> core::Result<decltype(read())> {
    try {
      return read();
    } catch (...) {
      return core::failure(core::ErrorCategory::BadInputFile,
                           fmt::format("cannot read the {} {}: {}", kind, name, reason_of_failure()));
    }
  }

  // The result of a `read` that gets the row of the content and the bytes without a byte order mark.
  template <class Read>
  auto parse(std::string_view bytes, const std::string& name, const Read& read) const
      -> core::Result<decltype(read(rows.front(), bytes))> {
    return named(name, [&] {
      const std::string_view text = without_byte_order_mark(bytes);
      const Row* const row = row_of(text);
      if (row == nullptr) throw CurveError(refusal_of(bytes));
      return read(*row, text);
    });
  }
};

}  // namespace afm::curves
