// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/marked_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/quantity_text.h"

namespace afm::physics {
namespace {

constexpr int kSide = 2 * MarkedSurface::kReach + 1;
constexpr int kMargin = MarkedSurface::kReach + 1;  // squares beyond the places of a tip
constexpr double kWidestTip = 1.75;                 // radius of the tip at z = 0 where it stops, over R_t
constexpr double kNarrowestRidge = 1.5;             // squares
constexpr int kAlong = 32;                          // places along a groove at which its section is taken

std::size_t squares_over(double length_m, double spacing_m) {
  return static_cast<std::size_t>(std::ceil(length_m / spacing_m)) + 2 * static_cast<std::size_t>(kMargin) + 1;
}

}  // namespace

Length MarkedSurface::longest_side(const SphereCone& tip) noexcept {
  return tip.radius * ((kMostSide - 2 * kMargin - 2) / kSquaresPerRadius);
}

MarkedSurface::MarkedSurface(const SphereCone& tip, const SoftSurface& surface, const Sideways<Length>& least,
                             const Sideways<Length>& most)
    : tip_(tip),
      hardness_pa_(surface.hardness.si),
      pile_up_share_(surface.pile_up_share),
      spacing_m_(tip.radius.si / kSquaresPerRadius),
      deepest_m_(-tip_.height_at(kWidestTip * tip.radius).si),
      left_m_(least.x.si - kMargin * spacing_m_),
      bottom_m_(least.y.si - kMargin * spacing_m_) {
  validate(surface);
  validate_marking_tip(tip);
  const Length longest = longest_side(tip);
  const double width_m = (most.x - least.x).si, height_m = (most.y - least.y).si;
  if (!(width_m >= 0.0 && height_m >= 0.0 && width_m <= longest.si && height_m <= longest.si)) {
    throw std::invalid_argument("a tip of " + format_quantity(tip.radius, kLengthUnits) +
                                " marks a square of at most " + format_quantity(longest, kLengthUnits, 3) + " x " +
                                format_quantity(longest, kLengthUnits, 3));
  }
  columns_ = squares_over(width_m, spacing_m_);
  rows_ = squares_over(height_m, spacing_m_);
  pressed_m_.resize(columns_ * rows_);
  back_m_.resize(columns_ * rows_);
}

template <class Visit>
void MarkedSurface::around(const Sideways<Length>& place, const Visit& visit) const noexcept {
  const auto column = static_cast<std::ptrdiff_t>(std::lround((place.x.si - left_m_) / spacing_m_));
  const auto row = static_cast<std::ptrdiff_t>(std::lround((place.y.si - bottom_m_) / spacing_m_));
  for (std::ptrdiff_t r = row - kReach; r <= row + kReach; ++r) {
    const double y_m = bottom_m_ + static_cast<double>(r) * spacing_m_ - place.y.si;
    for (std::ptrdiff_t c = column - kReach; c <= column + kReach; ++c) {
      const double x_m = left_m_ + static_cast<double>(c) * spacing_m_ - place.x.si;
      const double distance_m = std::sqrt(x_m * x_m + y_m * y_m);
      visit(Visited{static_cast<std::size_t>(r) * columns_ + static_cast<std::size_t>(c), x_m, y_m, distance_m,
                    tip_.height_at(Length(distance_m)).si});
    }
  }
}

bool MarkedSurface::holds(const Sideways<Length>& place) const noexcept {
  const double column = std::round((place.x.si - left_m_) / spacing_m_);
  const double row = std::round((place.y.si - bottom_m_) / spacing_m_);
  return column >= kReach && row >= kReach && column < static_cast<double>(columns_) - kReach &&
         row < static_cast<double>(rows_) - kReach;
}

Sunk MarkedSurface::sink(const Sideways<Length>& place, Length base, Stiffness spring) const noexcept {
  if (base.si >= highest_m_) return {.apex = base, .displaced = {}};
  // heights of the apex at which the squares begin to bear, the highest first
  std::array<double, static_cast<std::size_t>(kSide) * kSide> begins_m{};
  std::size_t count = 0;
  around(place, [&](const Visited& at) {
    const double begin_m = pressed_m_[at.index] - at.tip_m;
    if (begin_m > base.si) begins_m[count++] = begin_m;
  });
  const auto first = begins_m.begin();
  auto end = first + static_cast<std::ptrdiff_t>(count);
  std::make_heap(first, end);
  // the lever is bent further by each square that bears, until the next one begins below it
  const double square_m2 = spacing_m_ * spacing_m_, bend_m = hardness_pa_ * square_m2 / spring.si;
  double apex_m = base.si, sum_m = 0.0;
  std::size_t bearing = 0;
  while (end != first && *first > apex_m) {
    if (base.si + bend_m * static_cast<double>(bearing + 1) >= *first) {
      apex_m = *first;  // this one bears in part
      break;
    }
    sum_m += *first;
    apex_m = base.si + bend_m * static_cast<double>(++bearing);
    std::pop_heap(first, end--);
  }
  const bool stops = apex_m < deepest_m_;
  if (stops) {
    apex_m = deepest_m_;
    sum_m = 0.0;
    bearing = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (begins_m[i] <= apex_m) continue;
      sum_m += begins_m[i];
      ++bearing;
    }
  }
  const double displaced_m3 = square_m2 * std::max(0.0, sum_m - static_cast<double>(bearing) * apex_m);
  return {.apex = Length(apex_m), .displaced = Volume(displaced_m3), .stops = stops};
}

Volume MarkedSurface::press(const Sideways<Length>& place, Length apex, Length contact_radius, Length back) noexcept {
  double pressed_m = 0.0, lowered_m = 0.0;
  around(place, [&](const Visited& at) {
    double& height_m = pressed_m_[at.index];
    const double under_tip_m = apex.si + at.tip_m;
    if (!(height_m > under_tip_m)) return;
    const double seen_m = height_m + back_m_[at.index], outward = at.distance_m / contact_radius.si;
    const double rises_m = back.si * std::max(0.0, 1.0 - outward * outward);
    pressed_m += height_m - under_tip_m;
    height_m = under_tip_m;
    // a square that is pressed down does not end higher than it was
    back_m_[at.index] = std::min(rises_m, seen_m - under_tip_m);
    lowered_m += seen_m - (height_m + back_m_[at.index]);
  });
  const double square_m2 = spacing_m_ * spacing_m_;
  pressed_m3_ += pressed_m * square_m2;
  for_good_m3_ += lowered_m * square_m2;
  under_way_m3_ += pile_up_share_ * lowered_m * square_m2;
  return Volume(pressed_m * square_m2);
}

// A parabola over the width of a ridge, from the contact's edge to twice its radius.
double MarkedSurface::ridge_weight(const Visited& at, double radius_m, const Sideways<double>& along) const noexcept {
  double outward_m = at.distance_m;
  if (along.x != 0.0 || along.y != 0.0) {
    const double ahead_m = at.x_m * along.x + at.y_m * along.y;
    if (ahead_m > 0.0 || ahead_m < -radius_m) return 0.0;
    outward_m = std::abs(at.y_m * along.x - at.x_m * along.y);
  }
  const double share = outward_m / radius_m - 1.0;
  return share > 0.0 && share < 1.0 ? share * (1.0 - share) : 0.0;
}

void MarkedSurface::pile_up(const Sideways<Length>& place, Length apex, Length contact_radius,
                            const Sideways<double>& along) noexcept {
  if (!(under_way_m3_ > 0.0)) return;
  const double radius_m = std::clamp(contact_radius.si, kNarrowestRidge * spacing_m_, 0.5 * kReach * spacing_m_);
  double weights = 0.0;
  around(place, [&](const Visited& at) { weights += ridge_weight(at, radius_m, along); });
  if (!(weights > 0.0)) return;
  const double square_m2 = spacing_m_ * spacing_m_, unit_m = under_way_m3_ / (square_m2 * weights);
  double raised_m = 0.0;
  bool fits = true;
  around(place, [&](const Visited& at) {
    double& height_m = pressed_m_[at.index];
    const double room_m = std::max(0.0, apex.si + at.tip_m - height_m);
    const double share_m = unit_m * ridge_weight(at, radius_m, along), by_m = std::min(share_m, room_m);
    if (by_m < share_m) fits = false;
    height_m += by_m;
    raised_m += by_m;
    if (by_m > 0.0) highest_m_ = std::max(highest_m_, height_m + back_m_[at.index]);
  });
  ridges_m3_ += raised_m * square_m2;
  under_way_m3_ = fits ? 0.0 : std::max(0.0, under_way_m3_ - raised_m * square_m2);
}

double MarkedSurface::square_m(std::size_t column, std::size_t row) const noexcept {
  const std::size_t index = row * columns_ + column;
  return pressed_m_[index] + back_m_[index];
}

Length MarkedSurface::height(const Sideways<Length>& place) const noexcept {
  const double x = (place.x.si - left_m_) / spacing_m_, y = (place.y.si - bottom_m_) / spacing_m_;
  if (!(x >= 0.0 && y >= 0.0 && x < static_cast<double>(columns_ - 1) && y < static_cast<double>(rows_ - 1))) return {};
  const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
  const double right = x - std::floor(x), up = y - std::floor(y);
  const double low = (1.0 - right) * square_m(column, row) + right * square_m(column + 1, row);
  const double high = (1.0 - right) * square_m(column, row + 1) + right * square_m(column + 1, row + 1);
  return Length((1.0 - up) * low + up * high);
}

MarkVolumes MarkedSurface::volumes() const noexcept {
  return {.pressed = Volume(pressed_m3_),
          .sprung_back = Volume(pressed_m3_ - for_good_m3_),
          .ridges = Volume(ridges_m3_),
          .under_way = Volume(under_way_m3_),
          .densified = Volume(for_good_m3_ - ridges_m3_ - under_way_m3_)};
}

GrooveSection MarkedSurface::section(const Sideways<Length>& from, const Sideways<Length>& to) const noexcept {
  const Sideways<Length> way = to - from;
  const Length length = magnitude(way);
  if (!(length.si > 0.0)) return {};
  const Sideways<double> across{-(way.y / length), way.x / length};
  std::array<double, 4 * kReach + 1> mean_m{};  // at half a square from each other
  const double step_m = 0.5 * spacing_m_;
  for (std::size_t i = 0; i < mean_m.size(); ++i) {
    const double aside_m = step_m * (static_cast<double>(i) - 2.0 * kReach);
    for (int k = 0; k < kAlong; ++k) {
      const Sideways<Length> at = from + way * (0.25 + 0.5 * (k + 0.5) / kAlong);
      mean_m[i] += height({at.x + Length(aside_m * across.x), at.y + Length(aside_m * across.y)}).si / kAlong;
    }
  }
  const std::size_t lowest = static_cast<std::size_t>(std::min_element(mean_m.begin(), mean_m.end()) - mean_m.begin());
  if (!(mean_m[lowest] < 0.0)) return {};
  // zeros of the straight lines between the places
  double width_m = 0.0;
  for (std::size_t i = lowest; i + 1 < mean_m.size() && mean_m[i] < 0.0; ++i) {
    width_m += mean_m[i + 1] < 0.0 ? step_m : step_m * mean_m[i] / (mean_m[i] - mean_m[i + 1]);
  }
  for (std::size_t i = lowest; i > 0 && mean_m[i] < 0.0; --i) {
    width_m += mean_m[i - 1] < 0.0 ? step_m : step_m * mean_m[i] / (mean_m[i] - mean_m[i - 1]);
  }
  const double ridge_m = *std::max_element(mean_m.begin(), mean_m.end());
  return {.depth = Length(-mean_m[lowest]), .width = Length(width_m), .ridge = Length(std::max(0.0, ridge_m))};
}

Volume MarkedSurface::below() const noexcept {
  double sum_m = 0.0;
  for (std::size_t i = 0; i < pressed_m_.size(); ++i) sum_m -= std::min(0.0, pressed_m_[i] + back_m_[i]);
  return Volume(sum_m * spacing_m_ * spacing_m_);
}

Volume MarkedSurface::above() const noexcept {
  double sum_m = 0.0;
  for (std::size_t i = 0; i < pressed_m_.size(); ++i) sum_m += std::max(0.0, pressed_m_[i] + back_m_[i]);
  return Volume(sum_m * spacing_m_ * spacing_m_);
}

}  // namespace afm::physics
