// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace afm::curves {

// Iterates over the lines of a text, without their LF, CRLF or CR.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  bool next(std::string_view& line);
  std::size_t number() const { return number_; }  // number of the current line, from 1
  // True if the current line is the last, and has no line end: a file that was cut ends so.
  bool is_open() const { return open_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
  bool open_ = false;
};

// Throws CurveError for a line with another number of fields than the heading: CutShort, if it is open.
[[noreturn]] void refuse_fields(const Lines& lines, std::size_t fields, std::size_t of_heading);

std::string_view trimmed(std::string_view text);

// The parts between the separators; an empty text has one empty part. Reuses `parts`.
void split(std::string_view text, char separator, std::vector<std::string_view>& parts);

// True if a comma lies between two digits, as in "0,05".
bool has_decimal_comma(std::string_view text);

// Sentence on a number with a decimal comma, which is refused: its digits behind the comma would be lost, or be another
// number.
std::string decimal_comma_in(std::string_view name, std::string_view text);

// Takes the number at the front of the text, with the sign + that other programs write, or without. Empty if there is
// none or it is no finite one: the text is then unchanged.
std::optional<double> take_decimal(std::string_view& text);

// A finite decimal number that fills the whole field except for blanks. Throws CurveError with the place; line 0: none.
double number_in(std::string_view field, std::string_view column, const Lines& lines);

// Index of a column in the table's heading. Throws CurveError if there is none.
std::size_t column_in(const std::vector<std::string_view>& heading, std::string_view name);

}  // namespace afm::curves
