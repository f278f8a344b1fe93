// SPDX-License-Identifier: Apache-2.0
#include "formats/column_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bytes/table_numbers.h"
#include "bytes/text_table.h"
#include "core/enumerators.h"
#include "curves/curve_error.h"
#include "curves/table_columns.h"
#include "formats/segments.h"
#include "physics/quantity_text.h"

namespace afm::curves {

namespace {

enum class ColumnUnits { Length, Force, LengthOrVolts, Time, None };

struct ColumnRow {
  ColumnKind kind;
  std::string_view name;
  ColumnUnits units;
};
constexpr std::array kColumnRows{
    ColumnRow{ColumnKind::Height, "height", ColumnUnits::Length},
    ColumnRow{ColumnKind::TipPosition, "tip-position", ColumnUnits::Length},
    ColumnRow{ColumnKind::Force, "force", ColumnUnits::Force},
    ColumnRow{ColumnKind::Deflection, "deflection", ColumnUnits::LengthOrVolts},
    ColumnRow{ColumnKind::RetractHeight, "retract-height", ColumnUnits::Length},
    ColumnRow{ColumnKind::RetractTipPosition, "retract-tip-position", ColumnUnits::Length},
    ColumnRow{ColumnKind::RetractForce, "retract-force", ColumnUnits::Force},
    ColumnRow{ColumnKind::RetractDeflection, "retract-deflection", ColumnUnits::LengthOrVolts},
    ColumnRow{ColumnKind::Segment, "segment", ColumnUnits::None},
    ColumnRow{ColumnKind::Time, "time", ColumnUnits::Time},
    ColumnRow{ColumnKind::Nothing, "-", ColumnUnits::None}};
static_assert(core::has_row_for_each(kColumnRows, &ColumnRow::kind));

// SI units in one unit of this name; empty: not in the list.
std::optional<double> si_per_unit(const physics::Units& list, std::string_view name) {
  const auto found = std::find_if(list.units.begin(), list.units.end(),
                                  [&](const physics::Unit& unit) { return unit.symbol == name; });
  return found != list.units.end() ? std::optional(1.0 / found->per_si) : std::nullopt;
}

std::optional<TableColumn> column_of(const ColumnRow& row, std::string_view unit) {
  const auto in = [&](const physics::Units& list) -> std::optional<TableColumn> {
    const auto factor = si_per_unit(list, unit);
    return factor ? std::optional(TableColumn{row.kind, *factor, false}) : std::nullopt;
  };
  switch (row.units) {
    case ColumnUnits::Length:
      return in(physics::kLengthUnits);
    case ColumnUnits::Force:
      return in(physics::kForceUnits);
    case ColumnUnits::LengthOrVolts:
      if (unit == "V") return TableColumn{row.kind, 1.0, true};
      if (unit == "mV") return TableColumn{row.kind, 1e-3, true};
      return in(physics::kLengthUnits);
    case ColumnUnits::Time:
      return in(physics::kTimeUnits);
    case ColumnUnits::None:
      return unit.empty() ? std::optional(TableColumn{row.kind, 1.0, false}) : std::nullopt;
  }
  return std::nullopt;
}

std::size_t count_of(const TableColumns& columns, ColumnKind kind) {
  return static_cast<std::size_t>(
      std::count_if(columns.begin(), columns.end(), [&](const TableColumn& column) { return column.kind == kind; }));
}

// Index of the column of a kind; empty without one.
std::optional<std::size_t> place_of(const TableColumns& columns, ColumnKind kind) {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const TableColumn& column) { return column.kind == kind; });
  return found != columns.end() ? std::optional(static_cast<std::size_t>(found - columns.begin())) : std::nullopt;
}

// Newtons per unit of a force, or of a deflection with the given calibration.
double newtons_per(const TableColumn& column, const CurveReading& reading) {
  if (column.kind == ColumnKind::Force || column.kind == ColumnKind::RetractForce) return 1.0;
  if (!reading.spring_constant || (column.volts && !reading.sensitivity_m_per_v)) {
    throw CurveError(fmt::format("its deflection is in {}; give {}--spring-constant",
                                 column.volts ? "volts" : "a length",
                                 column.volts && !reading.sensitivity_m_per_v ? "--sensitivity and " : ""));
  }
  return reading.spring_constant->si * (column.volts ? *reading.sensitivity_m_per_v : 1.0);
}

// First row of the retract: where the height turns, at the extreme that is further from both ends.
std::size_t turn_of(const std::vector<double>& heights) {
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  const auto distance = [&](double height) {
    return std::min(std::abs(height - heights.front()), std::abs(height - heights.back()));
  };
  const auto turn = distance(*low) >= distance(*high) ? low : high;
  // a table of one way has its extremes near its ends, beside the noise
  constexpr double kShareOfTurn = 0.05;
  return distance(*turn) > kShareOfTurn * (*high - *low) ? static_cast<std::size_t>(turn - heights.begin()) + 1
                                                         : heights.size();
}

double median_of_some(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// First and last row at which the tip rests around its turn; empty unless it clearly does.
std::optional<std::pair<std::size_t, std::size_t>> rest_at(const std::vector<double>& heights, std::size_t turn) {
  constexpr double kBand = 0.01, kClearly = 3.0, kSteady = 1e-3, kDeviationPerMedian = 1.4826;
  constexpr std::size_t kFewest = 10;
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  const double range = *high - *low;
  const auto is_near = [](double level, double width) {
    return [=](double height) { return std::abs(height - level) <= width; };
  };
  const auto at_turn = is_near(heights[turn], kBand * range);
  const auto begin = std::find_if(heights.begin(), heights.end(), at_turn);
  const auto end = std::find_if(heights.rbegin(), heights.rend(), at_turn).base();
  const auto count = static_cast<std::size_t>(end - begin);
  // steady ramps have as large a share of their points there as of their heights
  if (count < kFewest + static_cast<std::size_t>(kClearly * kBand * static_cast<double>(heights.size()))) return {};
  const double level = median_of_some({begin, end});
  std::vector<double> deviations, steps;
  for (auto at = begin; at != end; ++at) {
    deviations.push_back(std::abs(*at - level));
    if (at != begin) steps.push_back(std::abs(*at - *(at - 1)));
  }
  // a ramp that slows down at its turn, as a sine does, is no rest
  const double spread = kDeviationPerMedian * median_of_some(deviations), noise = median_of_some(steps);
  if (spread > kClearly * noise + kSteady * range) return {};
  const auto at_rest = is_near(level, std::max(spread, 1e-9 * range));
  const auto first = std::find_if(begin, end, at_rest);
  const auto last =
      std::find_if(std::make_reverse_iterator(end), std::make_reverse_iterator(begin), at_rest).base() - 1;
  if (last + 1 == heights.end() || last - first < 2) return {};
  return std::pair(static_cast<std::size_t>(first - heights.begin()), static_cast<std::size_t>(last - heights.begin()));
}

// Throws if the tip comes near its turn once more: the rows of two curves would be taken for one.
void check_one_curve(const std::vector<double>& heights, std::size_t turn) {
  constexpr double kFar = 0.5, kNear = 0.25;  // shares of the whole way
  if (turn == heights.size()) return;
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  const auto way = [&, range = *high - *low](std::size_t row) {
    return std::abs(heights[row] - heights[turn - 1]) / range;
  };
  bool was_far = false;
  for (std::size_t row = turn; row < heights.size(); ++row) {
    was_far = was_far || way(row) > kFar;
    if (was_far && way(row) < kNear) {
      throw CurveError(fmt::format(
          "its heights turn again after their turn in row {} of {}: it holds more than one curve; write one "
          "approach and one retract into each file",
          turn, heights.size()));
    }
  }
}

// Segment of each row: 0 on the way to the turn and 1 on the way back, or 1 where the tip rests and 2 on the way back.
std::vector<double> segments_of(const std::vector<double>& heights) {
  std::vector<double> segments(heights.size(), 0.0);
  const std::size_t turn = turn_of(heights);
  check_one_curve(heights, turn);
  const auto from = [&](std::size_t row) { return segments.begin() + static_cast<std::ptrdiff_t>(row); };
  std::fill(from(turn), segments.end(), 1.0);
  if (turn == heights.size()) return segments;
  if (const auto rest = rest_at(heights, turn - 1)) {
    std::fill(segments.begin(), from(rest->first + 1), 0.0);
    std::fill(from(rest->first + 1), from(rest->second), 1.0);
    std::fill(from(rest->second), segments.end(), 2.0);
  }
  return segments;
}

// Metres per newton by which the lever's base is below the tip; 0 where the table has the base's heights.
double metres_per_newton(bool of_tip, const CurveReading& reading) {
  if (!of_tip) return 0.0;
  if (reading.spring_constant) return 1.0 / reading.spring_constant->si;
  throw CurveError("it has positions of the tip, not heights of the lever's base; give --spring-constant");
}

// Adds the points of one way: its heights or tip positions, and its forces or deflections.
void add_way(const std::vector<double>& places, const std::vector<double>& forces, double newtons, double metres,
             RecordedCurve& curve) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double force_n = forces[i] * newtons;
    curve.points.push_back({physics::Length(places[i] - metres * force_n), physics::Force(force_n)});
  }
}

std::vector<double> heights_of(const RecordedCurve& curve) {
  std::vector<double> heights;
  heights.reserve(curve.points.size());
  for (const physics::CurvePoint& point : curve.points) heights.push_back(point.z.si);
  return heights;
}

std::string known_columns() {
  std::vector<std::string_view> names;
  names.reserve(kColumnRows.size());
  for (const ColumnRow& row : kColumnRows) names.push_back(row.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

core::Result<void> check_retract(const TableColumns& columns) {
  const auto count = [&](ColumnKind kind) { return count_of(columns, kind); };
  const std::size_t forces = count(ColumnKind::Force),
                    back = count(ColumnKind::RetractForce) + count(ColumnKind::RetractDeflection);
  if (back > 1 || count(ColumnKind::RetractForce) > forces || count(ColumnKind::RetractDeflection) > 1 - forces) {
    return core::wrong_usage("the retract has one column, of the same quantity as the approach");
  }
  if (count(ColumnKind::RetractHeight) > back * count(ColumnKind::Height) ||
      count(ColumnKind::RetractTipPosition) > back * count(ColumnKind::TipPosition)) {
    return core::wrong_usage(
        "heights or tip positions of the retract are of the same kind as those of the approach, and need its force: "
        "\"height:nm force:nN retract-height:nm retract-force:nN\"");
  }
  if (back == 1 && (count(ColumnKind::Segment) > 0 || count(ColumnKind::Time) > 0)) {
    return core::wrong_usage("a retract beside the approach has neither segment nor time; write - for them");
  }
  return {};
}

core::Result<void> check(const TableColumns& columns) {
  const auto count = [&](ColumnKind kind) { return count_of(columns, kind); };
  if (count(ColumnKind::Height) + count(ColumnKind::TipPosition) != 1 ||
      count(ColumnKind::Force) + count(ColumnKind::Deflection) != 1) {
    return core::wrong_usage(
        "it needs one height or tip-position, and one force or deflection: \"height:um force:nN\"");
  }
  if (count(ColumnKind::Segment) > 1 || count(ColumnKind::Time) > 1) {
    return core::wrong_usage("a segment or a time is named twice");
  }
  return check_retract(columns);
}

}  // namespace

core::Result<TableColumns> parse_table_columns(std::string_view text) {
  TableColumns columns;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::string_view word = text.substr(0, std::min(text.find_first_of(" \t"), text.size()));
    text.remove_prefix(word.size());
    if (word.find_first_of(",;") != std::string_view::npos || word.find("\u00a0") != std::string_view::npos) {
      return core::wrong_usage(
          fmt::format("\"{}\": separate the columns by blanks, as in \"height:um force:nN\"", word));
    }
    const std::size_t colon = std::min(word.find(':'), word.size());
    const std::string_view name = word.substr(0, colon), unit = word.substr(std::min(colon + 1, word.size()));
    const auto row = std::find_if(kColumnRows.begin(), kColumnRows.end(),
                                  [&](const ColumnRow& known) { return known.name == name; });
    if (row == kColumnRows.end()) {
      return core::wrong_usage(
          fmt::format("\"{}\" is not a column; write NAME:UNIT for each, with a name of {}", word, known_columns()));
    }
    const bool reversed = unit.starts_with('-');
    auto column = column_of(*row, unit.substr(reversed ? 1 : 0));
    if (!column) {
      return core::wrong_usage(fmt::format(
          "\"{}\" has no unit of its quantity; such as height:um, force:nN, deflection:V, time:s, segment", word));
    }
    if (reversed) column->si_per_unit = -column->si_per_unit;
    columns.push_back(*column);
  }
  if (const auto checked = check(columns); !checked) return tl::unexpected(checked.error());
  return columns;
}

RecordedCurve read_column_table(std::string_view bytes, const CurveReading& reading) {
  const TableColumns& columns = *reading.columns;
  auto [table, remarks] = table_numbers(bytes, columns);
  const auto at = [&](ColumnKind kind) { return place_of(columns, kind); };
  const auto column_of_kinds = [&](ColumnKind a, ColumnKind b) { return at(a) ? at(a) : at(b); };
  const bool of_tip = at(ColumnKind::TipPosition).has_value();
  const std::vector<double>& heights = table[*column_of_kinds(ColumnKind::Height, ColumnKind::TipPosition)];
  const std::size_t force = *column_of_kinds(ColumnKind::Force, ColumnKind::Deflection);
  const double metres = metres_per_newton(of_tip, reading);
  RecordedCurve curve;
  curve.metadata.remarks = std::move(remarks);
  add_way(heights, table[force], newtons_per(columns[force], reading), metres, curve);
  std::vector<double> segments(heights.size(), 0.0);
  if (const auto back = column_of_kinds(ColumnKind::RetractForce, ColumnKind::RetractDeflection)) {
    const auto own = column_of_kinds(ColumnKind::RetractHeight, ColumnKind::RetractTipPosition);
    const std::vector<double>&forces = table[*back], &places = own ? table[*own] : heights;
    const double newtons = newtons_per(columns[*back], reading);
    if (own) {
      add_way(places, forces, newtons, metres, curve);
    } else {
      add_way({places.rbegin(), places.rend()}, {forces.rbegin(), forces.rend()}, newtons, metres, curve);
    }
    segments.resize(curve.points.size(), 1.0);
  } else if (const auto segment = at(ColumnKind::Segment)) {
    segments = table[*segment];
  } else {
    segments = segments_of(heights_of(curve));
  }
  if (const auto time = at(ColumnKind::Time)) {
    for (const double seconds : table[*time]) curve.time_s.push_back(seconds - table[*time].front());
  }
  assign_branches(segments, curve);
  curve.metadata.spring_constant = reading.spring_constant;
  curve.metadata.sensitivity_m_per_v = reading.sensitivity_m_per_v;
  return curve;
}

}  // namespace afm::curves
