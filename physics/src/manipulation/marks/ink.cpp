// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/ink.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "physics/contact_parameters.h"
#include "physics/quantity_text.h"

namespace afm::physics {
namespace {

constexpr double kMostMoleculesPerS = 1e12;
constexpr double kLeastFootprintM2 = 1e-21, kMostFootprintM2 = 1e-16;
constexpr int kPlacesAlong = 64, kPlacesAcross = 2048;  // at which a width is taken

}  // namespace

void validate(const Ink& ink) {
  if (!(ink.molecules_per_s > 0.0 && ink.molecules_per_s <= kMostMoleculesPerS)) {
    throw UnphysicalValue("molecules_per_s", "it must be positive, and at most 1e12");
  }
  if (!(ink.footprint.si >= kLeastFootprintM2 && ink.footprint.si <= kMostFootprintM2)) {
    throw UnphysicalValue("footprint", "it must be within 0.001 and 100 nm2");
  }
}

Area inked_area(const Ink& ink, Time time) noexcept { return ink.molecules_per_s * time.si * ink.footprint; }

Length ink_dot_radius(const Ink& ink, Time time) noexcept {
  return Length(std::sqrt(inked_area(ink, time).si / std::numbers::pi));
}

Length ink_line_width(const Ink& ink, Velocity speed) noexcept {
  return Length(ink.molecules_per_s * ink.footprint.si / speed.si);
}

InkedSurface::InkedSurface(const Ink& ink, const Sideways<Length>& least, const Sideways<Length>& most, Length margin,
                           Length spacing)
    : squares_per_s_(inked_area(ink, Time(1.0)).si / (spacing.si * spacing.si)),
      spacing_m_(spacing.si),
      left_m_((least.x - margin).si),
      bottom_m_((least.y - margin).si),
      columns_(0),
      rows_(0) {
  validate(ink);
  const auto squares = [&](Length from, Length to) {
    const double count = std::ceil((to - from + 2.0 * margin) / spacing) + 1.0;
    if (!(count >= 1.0 && count <= static_cast<double>(kMostSide))) {
      throw std::invalid_argument("the tip writes over " + format_quantity(to - from, kLengthUnits, 3) +
                                  ": squares of " + format_quantity(spacing, kLengthUnits, 3) + " are too small");
    }
    return static_cast<std::size_t>(count);
  };
  columns_ = squares(least.x, most.x);
  rows_ = squares(least.y, most.y);
  covered_.resize(columns_ * rows_);
  nearest_.reserve(static_cast<std::size_t>(2 * kReach + 1) * (2 * kReach + 1));
  for (int row = -kReach; row <= kReach; ++row) {
    for (int column = -kReach; column <= kReach; ++column) {
      if (column * column + row * row > kReach * kReach) continue;
      nearest_.push_back({static_cast<std::int16_t>(column), static_cast<std::int16_t>(row)});
    }
  }
  const auto distance = [](const Offset& at) { return int{at.column} * at.column + int{at.row} * at.row; };
  std::stable_sort(nearest_.begin(), nearest_.end(),
                   [&](const Offset& a, const Offset& b) { return distance(a) < distance(b); });
}

long InkedSurface::column_of(Length x) const noexcept { return std::lround((x.si - left_m_) / spacing_m_); }
long InkedSurface::row_of(Length y) const noexcept { return std::lround((y.si - bottom_m_) / spacing_m_); }

void InkedSurface::touch(const Sideways<Length>& place, Time time) noexcept {
  if (!(time.si > 0.0) || !std::isfinite(place.x.si) || !std::isfinite(place.y.si)) return;
  const long column = column_of(place.x), row = row_of(place.y);
  if (column != column_ || row != row_) next_ = 0;
  column_ = column;
  row_ = row;
  waiting_ += squares_per_s_ * time.si;
  const auto wide = static_cast<long>(columns_), high = static_cast<long>(rows_);
  for (; waiting_ >= 1.0 && next_ < nearest_.size(); ++next_) {
    const long at_column = column + nearest_[next_].column, at_row = row + nearest_[next_].row;
    if (at_column < 0 || at_row < 0 || at_column >= wide || at_row >= high) continue;
    std::uint8_t& square = covered_[static_cast<std::size_t>(at_row * wide + at_column)];
    if (square != 0) continue;
    square = 1;
    waiting_ -= 1.0;
    covered_squares_ += 1.0;
  }
  if (next_ < nearest_.size()) return;
  lost_squares_ += std::floor(waiting_);
  waiting_ -= std::floor(waiting_);
}

Area InkedSurface::covered() const noexcept { return Area(covered_squares_ * spacing_m_ * spacing_m_); }
Area InkedSurface::lost() const noexcept { return Area(lost_squares_ * spacing_m_ * spacing_m_); }

bool InkedSurface::is_covered_at(const Sideways<Length>& place) const noexcept {
  const long column = column_of(place.x), row = row_of(place.y);
  if (column < 0 || row < 0 || column >= static_cast<long>(columns_) || row >= static_cast<long>(rows_)) return false;
  return is_covered(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
}

Length InkedSurface::width(const Sideways<Length>& from, const Sideways<Length>& to) const noexcept {
  const Sideways<Length> way = to - from;
  const Length length = magnitude(way);
  if (!(length.si > 0.0)) return {};
  const Sideways<double> across{-(way.y / length), way.x / length};
  const Length step(0.25 * spacing_m_);
  double covered = 0.0;
  for (int k = 0; k < kPlacesAlong; ++k) {
    const Sideways<Length> at = from + way * (0.25 + 0.5 * (k + 0.5) / kPlacesAlong);
    // outwards from the line, on both sides, as far as it is covered
    for (const double side : {-1.0, 1.0}) {
      for (int i = 0; i < kPlacesAcross; ++i) {
        const Length aside = side * (i + 0.5) * step;
        if (!is_covered_at({at.x + aside * across.x, at.y + aside * across.y})) break;
        covered += 1.0;
      }
    }
  }
  return step * (covered / kPlacesAlong);
}

}  // namespace afm::physics
