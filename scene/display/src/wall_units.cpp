// SPDX-License-Identifier: Apache-2.0
#include "wall_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace afm::scene {

namespace {

constexpr double kMostExtents = 20.0;
constexpr double kHighestHeadM = 3.2;
constexpr double kLeastExtentM = 0.05, kMostExtentM = 60.0, kLeastDistanceM = 0.15;

// A person in front of a wall: lengths that are farther from these are less probable.
constexpr double kUsualExtentM = 3.7, kUsualDistanceM = 2.5, kUsualHeightM = 1.6;

// `penalty` is added to the distance from the usual lengths: decimetres come last.
struct LengthUnit {
  std::string_view name;
  double m;
  double penalty;
};
constexpr LengthUnit kMetres{"metres", 1.0, 0.0};
constexpr std::array kOtherUnits{LengthUnit{"millimetres", 1e-3, 0.0}, LengthUnit{"centimetres", 1e-2, 0.0},
                                 LengthUnit{"inches", 0.0254, 0.0}, LengthUnit{"feet", 0.3048, 0.0},
                                 LengthUnit{"decimetres", 0.1, 5.0}};
constexpr double kPenaltyOfOneInMetres = 0.7, kPenaltyOfTwoUnits = 2.5;
constexpr double kPenaltyOfAnOddHead = 6.0;  // head behind a screen or very high: the axes are wrong, too
constexpr double kNearlyAsGood = 3.0;
constexpr double kMostTimesLarger = 20.0;  // screens of one wall, measured in one unit
constexpr std::size_t kMostReadings = 3;

std::array<glm::dvec3, 4> corners_of(const Screen& screen) {
  return {screen.lower_left, screen.lower_right, screen.upper_left,
          screen.lower_right + screen.upper_left - screen.lower_left};
}

struct Reading {
  LengthUnit screens, head;
  WallLengths lengths;
  double width_m = 0, height_m = 0;
  double penalty = std::numeric_limits<double>::infinity();

  bool in_one_unit() const { return screens.m == head.m; }
  bool in_two_other_units() const { return !in_one_unit() && screens.m != kMetres.m && head.m != kMetres.m; }
};

double longest_edge_m(const Screen& screen) { return std::max(screen.width_m(), screen.height_m()); }

double from_usual(double length_m, double usual_m) { return std::abs(std::log(length_m / usual_m)); }

Reading read_in(const Wall& wall, Viewer viewer, const LengthUnit& screens, const LengthUnit& head) {
  Wall scaled{.screens = wall.screens, .outputs = {}, .viewers = {}};
  for (Screen& screen : scaled.screens) {
    for (glm::dvec3* corner : {&screen.lower_left, &screen.lower_right, &screen.upper_left}) *corner *= screens.m;
  }
  viewer.sweet_spot.position_m *= head.m;
  Reading reading{screens, head, lengths_of(scaled, viewer)};
  reading.width_m = scaled.screens.front().width_m();
  reading.height_m = scaled.screens.front().height_m();
  const WallLengths& lengths = reading.lengths;
  const double distance_m = std::abs(lengths.distance_m);
  const bool possible = lengths.extent_m >= kLeastExtentM && lengths.extent_m <= kMostExtentM &&
                        distance_m >= std::max(kLeastDistanceM, kLeastWidths * reading.width_m) &&
                        distance_m <= kMostExtents * lengths.extent_m;
  if (!possible) return reading;
  reading.penalty =
      screens.penalty + from_usual(lengths.extent_m, kUsualExtentM) + from_usual(distance_m, kUsualDistanceM);
  if (!reading.in_one_unit()) {
    reading.penalty += head.penalty + (reading.in_two_other_units() ? kPenaltyOfTwoUnits : kPenaltyOfOneInMetres);
  }
  if (lengths.distance_m < 0.0 || too_high(lengths)) reading.penalty += kPenaltyOfAnOddHead;
  if (lengths.head_height_m > 0.0) reading.penalty += from_usual(lengths.head_height_m, kUsualHeightM);
  return reading;
}

std::string described(const Reading& reading) {
  const std::string screen = fmt::format("{:.2f} m x {:.2f} m", reading.width_m, reading.height_m);
  const double distance_m = reading.lengths.distance_m;
  const std::string head =
      fmt::format("{:.2f} m {} it", std::abs(distance_m), distance_m < 0.0 ? "behind" : "in front of");
  if (reading.in_one_unit()) {
    return fmt::format("as {}, the screen would be {} with the head {}", reading.screens.name, screen, head);
  }
  if (reading.screens.m == kMetres.m) {
    return fmt::format("with sweet_spot in {}, the head would be {}", reading.head.name, head);
  }
  return fmt::format("with the corners in {} and sweet_spot in {}, the screen would be {} with the head {}",
                     reading.screens.name, reading.head.name, screen, head);
}

}  // namespace

WallLengths lengths_of(const Wall& wall, const Viewer& viewer) {
  std::vector<glm::dvec3> corners;
  WallLengths lengths{.distance_m = std::numeric_limits<double>::infinity()};
  double lowest_m = std::numeric_limits<double>::infinity();
  const glm::dvec3& head_m = viewer.sweet_spot.position_m;
  for (const Screen& screen : wall.screens) {
    for (const glm::dvec3& corner : corners_of(screen)) {
      for (const glm::dvec3& other : corners)
        lengths.extent_m = std::max(lengths.extent_m, glm::distance(corner, other));
      corners.push_back(corner);
      lowest_m = std::min(lowest_m, corner.y);
    }
    lengths.distance_m = std::min(lengths.distance_m, glm::dot(head_m - screen.lower_left, screen.normal()));
  }
  constexpr double kOnFloor = -0.05;  // fraction of the wall's extent
  if (lowest_m >= kOnFloor * lengths.extent_m) lengths.head_height_m = std::max(head_m.y, 0.0);
  return lengths;
}

bool too_far(const WallLengths& lengths) { return lengths.distance_m > kMostExtents * lengths.extent_m; }
bool too_high(const WallLengths& lengths) { return lengths.head_height_m > kHighestHeadM; }

std::string unit_that_fits(const Wall& wall, const Viewer& viewer) {
  std::vector<Reading> readings;
  for (const LengthUnit& unit : kOtherUnits) {
    readings.push_back(read_in(wall, viewer, unit, unit));
    readings.push_back(read_in(wall, viewer, unit, kMetres));
    readings.push_back(read_in(wall, viewer, kMetres, unit));
    for (const LengthUnit& other : kOtherUnits) {
      if (other.m != unit.m) readings.push_back(read_in(wall, viewer, unit, other));
    }
  }
  std::sort(readings.begin(), readings.end(), [](const Reading& a, const Reading& b) { return a.penalty < b.penalty; });
  const double worst = readings.front().penalty + kNearlyAsGood;
  std::string text;
  std::size_t named = 0;
  for (const Reading& reading : readings) {
    if (named == kMostReadings || !std::isfinite(reading.penalty) || reading.penalty > worst) break;
    if (named > 0 && reading.in_two_other_units()) continue;
    text += (named++ == 0 ? "lengths are in metres: " : "; ") + described(reading);
  }
  return text;
}

const Screen* screen_in_metres(const Wall& wall, const Screen& too_large) {
  for (const Screen& screen : wall.screens) {
    const double edge_m = longest_edge_m(screen);
    if (edge_m >= kLeastExtentM && longest_edge_m(too_large) > kMostTimesLarger * edge_m) return &screen;
  }
  return nullptr;
}

std::string unit_of_one_screen(const Screen& too_large, const Screen& in_metres) {
  const LengthUnit* best = nullptr;
  double least = std::log(kMostTimesLarger);
  for (const LengthUnit& unit : kOtherUnits) {
    const double off = from_usual(longest_edge_m(too_large) * unit.m, longest_edge_m(in_metres));
    if (off >= least) continue;
    least = off;
    best = &unit;
  }
  if (best == nullptr) return "";
  return fmt::format("lengths are in metres: with the corners of this screen in {}, it would be {:.2f} m x {:.2f} m",
                     best->name, too_large.width_m() * best->m, too_large.height_m() * best->m);
}

}  // namespace afm::scene
