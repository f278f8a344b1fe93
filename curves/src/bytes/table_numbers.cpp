// SPDX-License-Identifier: Apache-2.0
#include "bytes/table_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "bytes/scaled_unit.h"
#include "bytes/table_field.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"
#include "curves/recorded_curve.h"
#include "curves/unread_kinds.h"

namespace afm::curves {

namespace {

// Separators in the order of trial: commas last, because they may be decimal ones. A blank: any number of blanks and
// tabs.
constexpr std::array kSeparators{'\t', ';', ' ', ','};

// SI unit without prefix of a column; empty: none.
std::string_view base_unit(const TableColumn& column) {
  switch (column.kind) {
    case ColumnKind::Height:
    case ColumnKind::TipPosition:
    case ColumnKind::RetractHeight:
    case ColumnKind::RetractTipPosition:
      return "m";
    case ColumnKind::Force:
    case ColumnKind::RetractForce:
      return "N";
    case ColumnKind::Deflection:
    case ColumnKind::RetractDeflection:
      return column.volts ? "V" : "m";
    case ColumnKind::Time:
      return "s";
    case ColumnKind::Segment:
    case ColumnKind::Nothing:
      break;
  }
  return {};
}

// Unit in the words above a column, "Height (um)", "Height / um", "height_um", or the words at its place.
std::string_view unit_in(std::string_view words) {
  const std::size_t open = words.find_last_of("(["), close = words.find_last_of(")]");
  if (open != std::string_view::npos && close != std::string_view::npos && close > open) {
    return words.substr(open + 1, close - open - 1);
  }
  const std::size_t mark = words.find_last_of("/,:;_ ");
  if (mark == std::string_view::npos) return {};
  const std::string_view last = words.substr(mark + 1);
  const bool follows_stroke = words.substr(0, mark + 1).find_last_not_of(' ') == words.substr(0, mark + 1).rfind('/');
  return last.size() > 1 || follows_stroke ? last : std::string_view();  // empty for "column V", one of many
}

// Unit that is named above a column, next to that of --columns.
enum class NamedUnit { None, Same, Another };

NamedUnit compared(std::string_view name, const TableColumn& column) {
  const ScaledUnit unit = scaled_unit(name);
  if (base_unit(column).empty() || (unit.unit != "m" && unit.unit != "N" && unit.unit != "V" && unit.unit != "s")) {
    return NamedUnit::None;
  }
  constexpr double kRounding = 1e-6;
  const bool same =
      unit.unit == base_unit(column) && std::abs(unit.factor / std::abs(column.si_per_unit) - 1.0) <= kRounding;
  return same ? NamedUnit::Same : NamedUnit::Another;
}

// Returns whether a column of the lever's base is called the position of the tip, as other programs write it.
bool names_tip(std::string_view words, const TableColumn& column) {
  if (column.kind != ColumnKind::Height && column.kind != ColumnKind::RetractHeight) return false;
  std::string lower(words);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower.find("separation") != std::string::npos || lower.find("tip position") != std::string::npos;
}

// Commas in the numbers of a column.
struct ColumnCommas {
  std::string_view separated;         // first field whose comma may separate thousands; empty: none
  bool other = false, whole = false;  // true: a comma that is a decimal one; a whole number without a comma

  void see(const TableNumber& number, std::string_view field) {
    if (number.may_have_thousands && separated.empty()) {
      separated = trimmed(field);
      if (separated.starts_with('"')) separated = separated.substr(1, separated.size() - 2);
    }
    other = other || (number.has_comma && !number.may_have_thousands);
    whole = whole || number.is_whole;
  }
};

// Reads lines into columns; a column that is not read stays empty.
class TableReader {
 public:
  explicit TableReader(const TableColumns& columns)
      : columns_(columns), table_(columns.size()), row_(columns.size()), commas_of_(columns.size()) {}

  void read(std::string_view line, std::size_t number) {
    if (rows_ == 0 && !finds_separator(line)) {
      see_heading(line);
      return;
    }
    const std::size_t bad = first_bad(line, separator_);
    if (bad < columns_.size() && is_padding()) {
      ++padding_;
      return;
    }
    if (padding_ > 0) {
      throw CurveError(fmt::format("line {} has numbers, and the {} before it none", number,
                                   padding_ == 1 ? "line" : fmt::format("{} lines", padding_)));
    }
    if (bad < columns_.size() && bad >= fields_.size()) {
      throw CurveError(
          fmt::format("line {} has {} columns, and --columns names {}", number, fields_.size(), columns_.size()));
    }
    if (bad < columns_.size()) {
      throw CurveError(fmt::format("line {}: column {} is \"{}\", not a finite number", number, bad + 1,
                                   trimmed(fields_[bad]).substr(0, 40)));
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i].kind != ColumnKind::Nothing) commas_of_[i].see(row_[i], fields_[i]);
    }
    if (more_fields_at_ == 0 && has_more_fields()) {
      more_fields_at_ = number;
      most_fields_ = fields_.size();
    }
    if (rows_ == 0) {
      check_heading();
      check_tip();
      see_first(number);
    }
    if (++rows_ > kMostCurvePoints) throw CurveError("it has more points than a curve may have");
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i].kind == ColumnKind::Nothing) continue;
      points_ = points_ || row_[i].has_point;
      commas_ = commas_ || row_[i].has_comma;
      table_[i].push_back(row_[i].value * columns_[i].si_per_unit);
    }
    if (points_ && commas_) {
      throw CurveError(
          fmt::format("line {}: its numbers have points and commas; which is the decimal mark? Write them without "
                      "separators of thousands",
                      number));
    }
  }

  // Call after the last line.
  void finish() {
    leave_out_counts();
    check_commas();
    if (padding_ > 0)
      remarks_.push_back(fmt::format("no numbers at its end: the last {} left out",
                                     padding_ == 1 ? "line is" : fmt::format("{} lines are", padding_)));
    if (more_fields_at_ == 0) return;
    // "0,5,1,2" has two numbers with decimal commas, or four
    if (separator_ != ',' || points_) {
      remarks_.push_back(fmt::format("line {} has {} columns, and --columns names {}: those behind them are not read",
                                     more_fields_at_, most_fields_, columns_.size()));
      return;
    }
    throw CurveError(
        fmt::format("line {} has {} fields between commas, and --columns names {}: are they decimal commas? Write - "
                    "for each field that is not read, or separate the columns by tabs or semicolons",
                    more_fields_at_, most_fields_, columns_.size()));
  }

  // Remembers a line above the numbers; of a long heading the last lines.
  void see_heading(std::string_view line) {
    constexpr std::size_t kMostLines = 16;
    if (rows_ > 0) return;
    if (headings_.size() == kMostLines) headings_.erase(headings_.begin());
    headings_.push_back(line);
  }

  bool has_rows() const { return rows_ > 0; }
  std::string_view heading() const { return headings_.empty() ? std::string_view() : headings_.back(); }
  std::vector<std::string> take_remarks() { return std::move(remarks_); }
  std::vector<std::vector<double>> take() { return std::move(table_); }

 private:
  // Returns whether it is a line of numbers, which determines the separator.
  bool finds_separator(std::string_view line) {
    const auto fits = [&](char separator) { return first_bad(line, separator) == columns_.size(); };
    const auto found = std::find_if(kSeparators.begin(), kSeparators.end(), fits);
    if (found == kSeparators.end()) return false;
    separator_ = *found;
    return true;
  }

  // Puts the numbers of a line into the row. Returns the first column that is no number; their count if there is none.
  std::size_t first_bad(std::string_view line, char separator) {
    split_line(line, separator, fields_);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i].kind == ColumnKind::Nothing && i < fields_.size()) continue;
      const auto number = i < fields_.size() ? table_number(fields_[i], separator) : std::nullopt;
      if (!number) return i;
      row_[i] = *number;
    }
    return columns_.size();
  }

  // Refuses whole numbers with commas before each third digit, beside others without: "1,020" above "990".
  void check_commas() const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (commas_of_[i].separated.empty() || commas_of_[i].other || !commas_of_[i].whole) continue;
      throw CurveError(
          fmt::format("column {} has \"{}\" and whole numbers without a comma: does it separate thousands? Write the "
                      "numbers without such separators",
                      i + 1, commas_of_[i].separated));
    }
  }

  void see_first(std::size_t number) {
    first_at_ = number;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i].kind != ColumnKind::Nothing) first_.push_back(row_[i].value);
    }
  }

  // Leaves out a first line that counts the lines or the numbers below it: whole numbers, a height far from the others.
  void leave_out_counts() {
    constexpr std::size_t kFewest = 5;
    constexpr double kFarther = 3.0;
    if (rows_ < kFewest) return;
    const auto below = static_cast<double>(rows_ - 1), numbers = below * static_cast<double>(columns_.size());
    const bool whole = std::all_of(first_.begin(), first_.end(),
                                   [](double value) { return value >= 0.0 && value == std::floor(value); });
    const bool counts =
        std::any_of(first_.begin(), first_.end(), [=](double value) { return value == below || value == numbers; });
    if (!whole || !counts) return;
    const auto height = std::find_if(columns_.begin(), columns_.end(), [](const TableColumn& column) {
      return column.kind == ColumnKind::Height || column.kind == ColumnKind::TipPosition;
    });
    if (height == columns_.end()) return;
    const std::vector<double>& heights = table_[static_cast<std::size_t>(height - columns_.begin())];
    double step = 0.0;
    for (std::size_t row = 2; row < heights.size(); ++row)
      step = std::max(step, std::abs(heights[row] - heights[row - 1]));
    if (std::abs(heights[1] - heights[0]) <= kFarther * step) return;
    for (std::vector<double>& column : table_) {
      if (!column.empty()) column.erase(column.begin());
    }
    remarks_.push_back(fmt::format("line {} counts the {} below it, and is no point", first_at_, rows_ - 1));
    --rows_;
  }

  // True if the fields of the last line fill up a column that is shorter than others, as in Igor's tables.
  bool is_padding() const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i].kind == ColumnKind::Nothing || i >= fields_.size()) continue;
      const std::string_view field = trimmed(fields_[i]);
      if (!field.empty() && field != "NaN" && field != "nan" && field != "NAN") return false;
    }
    return true;
  }

  bool has_more_fields() const {
    const auto rest = fields_.begin() + static_cast<std::ptrdiff_t>(columns_.size());
    return std::any_of(rest, fields_.end(), [](std::string_view field) { return !trimmed(field).empty(); });
  }

  // Compares the units of the lowest line that names them with those of --columns.
  void check_heading() {
    const auto factor = std::find_if(headings_.begin(), headings_.end(), is_factor);
    if (factor != headings_.end()) {
      throw CurveError(fmt::format(
          "\"{}\" above its numbers is a factor, as MATLAB prints one: write the numbers without it, such as by "
          "format longG or writematrix",
          trimmed(*factor)));
    }
    for (auto line = headings_.rbegin(); line != headings_.rend(); ++line) {
      split_line(*line, separator_, fields_);
      // "units: nm nN"
      if (fields_.size() > columns_.size() && trimmed(fields_.front()).ends_with(':')) fields_.erase(fields_.begin());
      if (fields_.size() < columns_.size()) continue;
      // a line far above may be about something else, and must name the units of all columns
      const bool words =
          (separator_ != ' ' || fields_.size() == columns_.size()) && names_units(line == headings_.rbegin(), unit_in);
      if (words || names_units(false, trimmed)) return;
    }
  }

  // Remarks on other units if `unit_of` finds a unit in the field above each column that has one, or above `any` of
  // them. Returns whether it does.
  bool names_units(bool any, std::string_view (*unit_of)(std::string_view)) {
    std::size_t quantities = 0, named = 0;
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const NamedUnit unit = compared(unit_of(trimmed(fields_[i])), columns_[i]);
      quantities += base_unit(columns_[i]).empty() ? 0U : 1U;
      named += unit == NamedUnit::None ? 0U : 1U;
      if (unit == NamedUnit::Another) others.push_back(i);
    }
    if (named == 0 || (!any && named < quantities)) return false;
    for (const std::size_t i : others) {
      remarks_.push_back(fmt::format("the heading of column {} is \"{}\", and --columns names another unit", i + 1,
                                     trimmed(fields_[i]).substr(0, 40)));
    }
    return true;
  }

  // Remarks on heights of the last line above the numbers that are said to be those of the tip.
  void check_tip() {
    split_line(heading(), separator_, fields_);
    for (std::size_t i = 0; i < columns_.size() && fields_.size() == columns_.size(); ++i) {
      if (!names_tip(fields_[i], columns_[i])) continue;
      remarks_.push_back(fmt::format(
          "the heading of column {} is \"{}\": if it is the position of the tip, and not of the lever's base, call it "
          "tip-position",
          i + 1, trimmed(fields_[i]).substr(0, 40)));
    }
  }

  const TableColumns& columns_;
  std::vector<std::vector<double>> table_;
  std::vector<TableNumber> row_;
  std::vector<ColumnCommas> commas_of_;
  std::vector<double> first_;  // numbers of the first row as written
  std::size_t first_at_ = 0;   // line number of the first row
  std::vector<std::string_view> fields_;
  std::vector<std::string> remarks_;
  std::vector<std::string_view> headings_;  // last lines above the numbers
  std::size_t rows_ = 0, padding_ = 0;
  std::size_t more_fields_at_ = 0, most_fields_ = 0;  // first line with more fields than columns; 0: none
  bool points_ = false, commas_ = false;              // decimal marks found so far
  char separator_ = ' ';
};

}  // namespace

TableNumbers table_numbers(std::string_view bytes, const TableColumns& columns) {
  if (bytes.find('\0') != std::string_view::npos) refuse_no_text(bytes);
  TableReader reader(columns);
  std::string_view line;
  Lines lines(bytes);
  while (lines.next(line)) {
    const std::string_view words = trimmed(line);
    if (words.starts_with('#')) {
      reader.see_heading(trimmed(words.substr(1)));
    } else if (!words.empty()) {
      reader.read(line, lines.number());
    }
  }
  if (!reader.has_rows()) {
    if (const std::string kind = unread_kind_of(bytes, bytes.size()); !kind.empty()) throw CurveError("it is " + kind);
    const std::string last = reader.heading().empty()
                                 ? std::string()
                                 : fmt::format("; its last line is \"{}\"", reader.heading().substr(0, 60));
    throw CurveError(
        fmt::format("no line has {} columns with numbers where --columns names them{}", columns.size(), last));
  }
  reader.finish();
  std::vector<std::string> remarks = reader.take_remarks();
  if (lines.is_open() && !trimmed(line).empty()) {
    remarks.emplace_back("its last line has no end, and may have lost digits");
  }
  return {reader.take(), std::move(remarks)};
}

}  // namespace afm::curves
