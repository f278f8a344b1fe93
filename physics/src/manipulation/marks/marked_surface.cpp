// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/marked_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "physics/quantity_text.h"

namespace afm::physics {
namespace {

constexpr int kMargin = MarkedSurface::kReach + 1;  // margin around the positions of a tip, in squares
constexpr double kWidestTip = 1.75;                 // radius of the tip at z = 0 at its lowest height, over R_t
constexpr double kNarrowestRidge = 1.5;             // smallest radius of a contact for its ridge, in squares
constexpr int kAlong = 32;                          // positions along a groove at which its section is measured
constexpr double kRidgeReach = 2.24;                // farthest place of a ridge behind a tip, over the contact's radius
constexpr double kDoubt = 0.1;                      // allowed difference of an apex from the expected one, in squares
constexpr double kDoubtGrowth = 8.0;
constexpr int kPlacesPerSquare = 8;           // nodes of the tip's profile per square, over r^2
constexpr double kBelowProfile = 1.0 - 1e-3;  // share of a bound that the profile's straight lines do not cross

std::size_t squares_over(double length_m, double spacing_m) {
  return static_cast<std::size_t>(std::ceil(length_m / spacing_m)) + 2 * static_cast<std::size_t>(kMargin) + 1;
}

// The height at which a lever rests on squares that bend it by `bend_m` each, the higher ones first: the least one at
// which it is bent by all that begin to bear above it. Uses up the heights at which they begin.
double resting_height(double base_m, double bend_m, std::span<double> begins_m) noexcept {
  std::size_t bearing = 0;  // number of squares above the remaining ones
  while (!begins_m.empty()) {
    const double pivot_m = begins_m[begins_m.size() / 2];
    std::size_t above = 0, equal = 0;
    for (const double begin_m : begins_m) {
      above += begin_m > pivot_m ? 1U : 0U;
      equal += begin_m == pivot_m ? 1U : 0U;
    }
    const bool rests_above = base_m + bend_m * static_cast<double>(bearing + above) > pivot_m;
    if (!rests_above) {
      bearing += above + equal;
      if (!(base_m + bend_m * static_cast<double>(bearing) < pivot_m))
        return pivot_m;  // the last of these squares bears a part
    }
    double* kept_m = begins_m.data();
    std::size_t left = 0;
    for (const double begin_m : begins_m) {
      kept_m[left] = begin_m;
      left += (rests_above ? begin_m > pivot_m : begin_m < pivot_m) ? 1U : 0U;
    }
    begins_m = begins_m.first(left);
  }
  return base_m + bend_m * static_cast<double>(bearing);
}

// A band 0 <= slope x + offset <= high across a row.
class Band {
 public:
  explicit Band(double slope) noexcept : per_slope_(slope != 0.0 ? 1.0 / slope : 0.0) {}

  // Cuts the range from least to most down to the part within the band; all of it is left of a band along the row.
  void cut(double offset, double high, double& least, double& most) const noexcept {
    if (per_slope_ == 0.0) return;
    const double a = -offset * per_slope_, b = (high - offset) * per_slope_;
    least = std::max(least, std::min(a, b));
    most = std::min(most, std::max(a, b));
  }

 private:
  double per_slope_;
};

}  // namespace

Length MarkedSurface::longest_side(const SphereCone& tip) noexcept {
  return tip.radius * ((kMostSide - 2 * kMargin - 2) / kSquaresPerRadius);
}

MarkedSurface::MarkedSurface(const SphereCone& tip, const SoftSurface& surface, const Sideways<Length>& least,
                             const Sideways<Length>& most)
    : hardness_pa_(surface.hardness.si),
      pile_up_share_(surface.pile_up_share),
      spacing_m_(tip.radius.si / kSquaresPerRadius),
      deepest_m_(-TipOutline(tip).height_at(kWidestTip * tip.radius).si),
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
  changed_.resize(tiles());
  const TipOutline outline(tip);
  const double farthest = kReach + 1.0, place_m2 = spacing_m_ * spacing_m_ / kPlacesPerSquare;  // along x and y
  const auto places = static_cast<std::size_t>(2.0 * farthest * farthest * kPlacesPerSquare) + 2;
  profile_m_.reserve(places);
  for (std::size_t i = 0; i < places; ++i) {
    profile_m_.push_back(outline.height_at(Length(std::sqrt(static_cast<double>(i) * place_m2))).si);
  }
  places_per_m2_ = 1.0 / place_m2;
  // The height over r^2 grows on the cap and, at first, on the cone; then it falls.
  const double at_farthest_per_m = profile_m_.back() / (static_cast<double>(places - 1) * place_m2);
  least_rise_per_m_ = kBelowProfile * std::min(0.5 / tip.radius.si, at_farthest_per_m);
}

// The height of the tip above its apex, on straight lines over r^2, which lie within 3e-4 R_t of its outline.
MarkedSurface::Rise MarkedSurface::rise_at(double distance_m2) const noexcept {
  const double place = distance_m2 * places_per_m2_;
  const auto i = static_cast<std::size_t>(place);
  const double* profile_m = profile_m_.data() + i;  // the libraries' checks of each index took a fifth of a tick
  const double step_m = profile_m[1] - profile_m[0];
  return {profile_m[0] + (place - static_cast<double>(i)) * step_m, step_m * places_per_m2_};
}

MarkedSurface::Window MarkedSurface::window(const Sideways<Length>& place) const noexcept {
  const long column = std::lround((place.x.si - left_m_) / spacing_m_) - kReach;
  const long row = std::lround((place.y.si - bottom_m_) / spacing_m_) - kReach;
  const double x_m = left_m_ + static_cast<double>(column) * spacing_m_ - place.x.si;
  const double y_m = bottom_m_ + static_cast<double>(row) * spacing_m_ - place.y.si;
  Window window;
  for (int i = 0; i < kSide; ++i) {
    window.x_m[static_cast<std::size_t>(i)] = x_m + i * spacing_m_;
    window.y_m[static_cast<std::size_t>(i)] = y_m + i * spacing_m_;
  }
  window.squares_per_m = 1.0 / spacing_m_;
  window.first = static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
  return window;
}

template <class Visit>
void MarkedSurface::above_tip(const Window& window, double apex_m, const Visit& visit) const noexcept {
  const double most_m2 = (highest_m_ - apex_m) / least_rise_per_m_;
  if (!(most_m2 > 0.0)) return;
  for (std::size_t r = 0; r < window.y_m.size(); ++r) {
    const double y_m2 = window.y_m[r] * window.y_m[r];
    if (!(y_m2 < most_m2)) continue;
    const double half_m = std::sqrt(most_m2 - y_m2);
    const Columns columns = window.columns_between(-half_m, half_m);
    const double* x_m = window.x_m.data();
    const double* heights_m = pressed_m_.data() + window.first + r * columns_;
    for (std::size_t c = columns.first; c < columns.end; ++c) {
      const double distance_m2 = x_m[c] * x_m[c] + y_m2;
      if (!(heights_m[c] - apex_m > least_rise_per_m_ * distance_m2)) continue;
      visit(Above{window.first + r * columns_ + c, x_m[c], window.y_m[r], distance_m2, rise_at(distance_m2)});
    }
  }
}

bool MarkedSurface::holds(const Sideways<Length>& place) const noexcept {
  const double column = std::round((place.x.si - left_m_) / spacing_m_);
  const double row = std::round((place.y.si - bottom_m_) / spacing_m_);
  return column >= kReach && row >= kReach && column < static_cast<double>(columns_) - kReach &&
         row < static_cast<double>(rows_) - kReach;
}

Sunk MarkedSurface::sink(const Sideways<Length>& place, const Sideways<double>& along, Length base, Stiffness spring,
                         Length about) const noexcept {
  if (base.si >= highest_m_) return {.apex = base, .displaced = {}, .resistance = {}};
  const Window squares = window(place);
  const double square_m2 = spacing_m_ * spacing_m_, bend_m = hardness_pa_ * square_m2 / spring.si;
  const double lowest_m = std::max(base.si, deepest_m_);
  // by square: the height of the apex at which it begins to bear, and how much that rises along the way
  std::array<double, static_cast<std::size_t>(kSide) * kSide> begins_m, rises, used_up_m;
  const double* heights_m = pressed_m_.data();
  double *begin = begins_m.data(), *rise_of = rises.data();
  std::size_t count = 0;
  double apex_m = 0.0;
  // what begins to bear below the apex counts for nothing: only what is above a lower bound of it is looked at
  for (double doubt_m = kDoubt * spacing_m_;; doubt_m *= kDoubtGrowth) {
    const double least_m = std::max(lowest_m, about.si - doubt_m);
    count = 0;
    above_tip(squares, least_m, [&](const Above& at) {
      const double begin_m = heights_m[at.index] - at.tip.height_m;
      begin[count] = begin_m;
      rise_of[count] = 2.0 * at.tip.per_m2_m * (at.x_m * along.x + at.y_m * along.y);
      count += begin_m > least_m ? 1U : 0U;
    });
    std::copy_n(begins_m.begin(), count, used_up_m.begin());
    apex_m = resting_height(base.si, bend_m, std::span(used_up_m).first(count));
    if (apex_m >= least_m || least_m == lowest_m) break;
  }
  const bool stops = apex_m < deepest_m_;
  if (stops) apex_m = deepest_m_;
  double displaced_m = 0.0, bearing = 0.0, rise = 0.0, in_part = 0.0, rise_in_part = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    // without a branch: half of them bear
    const auto bears = static_cast<double>(begin[i] > apex_m), partly = static_cast<double>(begin[i] == apex_m);
    displaced_m += bears * (begin[i] - apex_m);
    bearing += bears;
    rise += bears * rise_of[i];
    in_part += partly;
    rise_in_part += partly * rise_of[i];
  }
  // what the lever presses with beyond those that bear is borne by those that bear in part
  if (in_part > 0.0) rise += std::clamp(((apex_m - base.si) / bend_m - bearing) / in_part, 0.0, 1.0) * rise_in_part;
  return {.apex = Length(apex_m),
          .displaced = Volume(square_m2 * displaced_m),
          .resistance = Force(hardness_pa_ * square_m2 * rise),
          .stops = stops};
}

Volume MarkedSurface::press(const Sideways<Length>& place, Length apex, Length contact_radius, Length back) noexcept {
  double pressed_m = 0.0, lowered_m = 0.0;
  const double radius_m2 = contact_radius.si * contact_radius.si;
  above_tip(window(place), apex.si, [&](const Above& at) {
    double &height_m = pressed_m_[at.index], &back_m = back_m_[at.index];
    const double under_tip_m = apex.si + at.tip.height_m;
    if (!(height_m > under_tip_m)) return;
    const double seen_m = height_m + back_m;
    const double rises_m = back.si * std::max(0.0, 1.0 - at.distance_m2 / radius_m2);
    pressed_m += height_m - under_tip_m;
    height_m = under_tip_m;
    // a square that is pressed down does not end higher than it was
    back_m = std::min(rises_m, seen_m - under_tip_m);
    lowered_m += seen_m - (height_m + back_m);
  });
  note_change(place);
  const double square_m2 = spacing_m_ * spacing_m_;
  pressed_m3_ += pressed_m * square_m2;
  for_good_m3_ += lowered_m * square_m2;
  under_way_m3_ += pile_up_share_ * lowered_m * square_m2;
  return Volume(pressed_m * square_m2);
}

template <class Visit>
void MarkedSurface::beside(const Window& window, double radius_m, const Sideways<double>& along,
                           const Visit& visit) const noexcept {
  const bool round = along.x == 0.0 && along.y == 0.0;
  const Band behind(along.x), across(-along.y);
  for (std::size_t r = 0; r < window.y_m.size(); ++r) {
    const double y_m = window.y_m[r];
    if (std::abs(y_m) > kRidgeReach * radius_m) continue;
    double least_m = -kRidgeReach * radius_m, most_m = -least_m;
    if (!round) {
      behind.cut(y_m * along.y + radius_m, radius_m, least_m, most_m);
      across.cut(y_m * along.x + 2.0 * radius_m, 4.0 * radius_m, least_m, most_m);
    }
    const Columns columns = window.columns_between(least_m, most_m);
    for (std::size_t c = columns.first; c < columns.end; ++c) {
      const double x_m = window.x_m[c], distance_m2 = x_m * x_m + y_m * y_m;
      double outward_m = 0.0;
      if (round) {
        outward_m = std::sqrt(distance_m2);
      } else {
        const double ahead_m = x_m * along.x + y_m * along.y;
        if (ahead_m > 0.0 || ahead_m < -radius_m) continue;
        outward_m = std::abs(y_m * along.x - x_m * along.y);
      }
      // a parabola over the width of a ridge, from the contact's edge to twice its radius
      const double share = outward_m / radius_m - 1.0;
      if (share > 0.0 && share < 1.0) visit(window.first + r * columns_ + c, share * (1.0 - share), distance_m2);
    }
  }
}

void MarkedSurface::pile_up(const Sideways<Length>& place, Length apex, Length contact_radius,
                            const Sideways<double>& along) noexcept {
  if (!(under_way_m3_ > 0.0)) return;
  const double radius_m = std::clamp(contact_radius.si, kNarrowestRidge * spacing_m_, 0.5 * kReach * spacing_m_);
  const Window squares = window(place);
  double weights = 0.0;
  beside(squares, radius_m, along, [&](std::size_t, double weight, double) { weights += weight; });
  if (!(weights > 0.0)) return;
  const double square_m2 = spacing_m_ * spacing_m_, unit_m = under_way_m3_ / (square_m2 * weights);
  double raised_m = 0.0;
  bool fits = true;
  beside(squares, radius_m, along, [&](std::size_t index, double weight, double distance_m2) {
    double& height_m = pressed_m_[index];
    const double under_tip_m = apex.si + rise_at(distance_m2).height_m;
    const double share_m = unit_m * weight, by_m = std::min(share_m, std::max(0.0, under_tip_m - height_m));
    if (by_m < share_m) fits = false;
    height_m += by_m;
    raised_m += by_m;
    if (by_m > 0.0) highest_m_ = std::max(highest_m_, height_m + back_m_[index]);
  });
  note_change(place);
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
  std::array<double, 4 * kReach + 1> mean_m{};  // mean heights at a distance of half a square
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
