// SPDX-License-Identifier: Apache-2.0
#include "rod_steps.h"

#include <array>
#include <cmath>

#include "definite_solution.h"
#include "line_friction.h"

namespace afm::physics {
namespace {

using Body = HeapContacts::Body;
using Place = HeapContacts::Place;

constexpr double kRodRounding = 1e-12;       // fraction by which a load must exceed a threshold
constexpr double kLeastTurning = 1e-3;       // least turning stiffness, as a share of the friction's curvature
constexpr double kLeastRodStiffness = 1e-6;  // least stiffness of a rod, as a share of a contact's

// Unknowns of a contact: up to three of each side, with the derivatives of its overlap.
struct Derivatives {
  std::array<std::size_t, 6> row{};
  std::array<double, 6> value{};
  std::size_t count = 0;

  void add(std::size_t at, double derivative) noexcept {
    row[count] = at;
    value[count++] = derivative;
  }
};

void add_contact(HeapSystem& s, const Derivatives& d, double stiffness, double overlap_m) noexcept {
  for (std::size_t a = 0; a < d.count; ++a) {
    s.gradient[d.row[a]] += stiffness * overlap_m * d.value[a];
    for (std::size_t b = 0; b < d.count; ++b) s.stiffness[d.row[a]][d.row[b]] += stiffness * d.value[a] * d.value[b];
  }
}

// Gradient of the energy of a rod's contacts over x, y and turn, with the sum of their stiffnesses.
struct Load {
  RodVector gradient{};
  RodMatrix stiffness{};
  double trace = 0.0;

  void add(double k, double overlap_m, const RodVector& derivative) noexcept {
    for (std::size_t a = 0; a < 3; ++a) {
      gradient[a] += k * overlap_m * derivative[a];
      for (std::size_t b = 0; b < 3; ++b) stiffness[a][b] += k * derivative[a] * derivative[b];
      trace += k * derivative[a] * derivative[a];
    }
  }
};

Load load_on(const HeapContacts& heap, std::size_t i) noexcept {
  Load load;
  const double k = heap.springs().contact.si;
  if (const HeapContacts::Normal tip = heap.normal_of(i); tip.overlap_m > 0.0) {
    load.add(k, tip.overlap_m, {-tip.towards[0], -tip.towards[1], tip.turning});
  }
  for (const std::size_t p : heap.pairs_of(i)) {
    const HeapContacts::Touch touch = heap.touch_of(p);
    if (!(touch.overlap_m > 0.0)) continue;
    const bool first = heap.pair(p).first == i;
    const double sign = first ? -1.0 : 1.0;
    load.add(k, touch.overlap_m,
             {sign * touch.u[0], sign * touch.u[1], -(first ? touch.turning_first : touch.turning_second)});
  }
  return load;
}

// Rotates a vector from the frame of the rod's start to that of the sample.
Flat in_sample(const Body& rod, double along, double across) noexcept {
  return {along * rod.start_axis.x - across * rod.start_axis.y, along * rod.start_axis.y + across * rod.start_axis.x};
}

std::optional<Place> first_motion(const Body& rod, const Load& load) noexcept {
  const RodVector& g = load.gradient;
  const Flat& axis = rod.start_axis;
  const DrivenMotion driven = driven_motion({-(g[0] * axis.x + g[1] * axis.y), g[0] * axis.y - g[1] * axis.x, -g[2]});
  if (!(driven.force > rod.rest_n * (1.0 + kRodRounding))) return std::nullopt;
  const RodVector& m = driven.motion;
  const double way = mean_way(m).way, squares = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
  if (!(load.trace > 0.0 && squares > 0.0)) return std::nullopt;
  const double length = (driven.force - rod.moving_n) * way / (load.trace * squares);
  const Flat to = in_sample(rod, length * m[0], length * m[1]);
  return rod.place_at({rod.start.x + to.x, rod.start.y + to.y}, length * m[2]);
}

}  // namespace

void add_rod_tip(HeapSystem& s, const HeapContacts& heap, std::size_t i, std::size_t row) noexcept {
  const HeapContacts::Normal tip = heap.normal_of(i);
  Derivatives d;
  for (std::size_t a = 0; a < 3; ++a) d.add(a, tip.towards[a]);
  if (row != 0) {
    d.add(row, -tip.towards[0]);
    d.add(row + 1, -tip.towards[1]);
    d.add(row + 2, tip.turning);
  }
  add_contact(s, d, heap.springs().contact.si, tip.overlap_m);
}

void add_rod_pair(HeapSystem& s, const HeapContacts& heap, std::size_t p, std::size_t row_first,
                  std::size_t row_second) noexcept {
  const HeapContacts::Touch touch = heap.touch_of(p);
  const HeapContacts::Pair& pair = heap.pair(p);
  Derivatives d;
  const auto add = [&](std::size_t row, std::size_t body, double sign, double turning) {
    if (row == 0) return;
    d.add(row, sign * touch.u[0]);
    d.add(row + 1, sign * touch.u[1]);
    if (heap.body(body).is_rod()) d.add(row + 2, turning);
  };
  add(row_first, pair.first, -1.0, -touch.turning_first);
  add(row_second, pair.second, 1.0, -touch.turning_second);
  add_contact(s, d, heap.springs().contact.si, touch.overlap_m);
}

void add_rod_friction(HeapSystem& s, const Body& rod, std::size_t row) noexcept {
  const RodVector motion = rod.motion_to(rod.place());
  const MeanWay mean = mean_way(motion);
  const RodMatrix curvature = mean_way_curvature(motion);
  // columns: x, y and turn in the rod's frame
  const Flat& axis = rod.start_axis;
  const RodMatrix frame{{{axis.x, axis.y, 0.0}, {-axis.y, axis.x, 0.0}, {0.0, 0.0, 1.0}}};
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t i = 0; i < 3; ++i) {
      s.gradient[row + a] += rod.moving_n * frame[i][a] * mean.slope[i];
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t b = 0; b < 3; ++b) {
          s.stiffness[row + a][row + b] += rod.moving_n * frame[i][a] * curvature[i][j] * frame[j][b];
        }
      }
    }
  }
  // pushed in its middle, a rod that turns a little loses no more
  s.stiffness[row + 2][row + 2] += kLeastTurning * rod.moving_n / mean.way;
}

std::optional<Place> rod_step(const HeapContacts& heap, std::size_t i) noexcept {
  const Body& rod = heap.body(i);
  const Load load = load_on(heap, i);
  if (!rod.moved()) return first_motion(rod, load);
  const Place start = rod.place_at(rod.start, 0.0);
  if (!(load.trace > 0.0)) return start;  // friction only: back to the start
  HeapSystem system(3);
  add_rod_friction(system, rod, 0);
  for (std::size_t a = 0; a < 3; ++a) {
    system.gradient[a] += load.gradient[a];
    for (std::size_t b = 0; b < 3; ++b) system.stiffness[a][b] += load.stiffness[a][b];
    system.stiffness[a][a] += kLeastRodStiffness * heap.springs().contact.si;
  }
  decltype(system.gradient) move{};
  if (!solve_definite(system.size, system.stiffness, system.gradient, move)) return std::nullopt;
  const Place to = rod.place_at({rod.at.x + move[0], rod.at.y + move[1]}, rod.turned_m + move[2]);
  return goes_back(rod, to) ? start : to;
}

bool goes_back(const Body& body, const Place& to) noexcept {
  const double ways =
      (to.at.x - body.start.x) * (body.at.x - body.start.x) + (to.at.y - body.start.y) * (body.at.y - body.start.y);
  return (body.is_rod() ? ways + to.turned_m * body.turned_m : ways) <= 0.0;
}

double way_between(const Place& a, const Place& b) noexcept {
  return distance_between(a.at, b.at) + std::abs(a.turned_m - b.turned_m);
}

}  // namespace afm::physics
