// SPDX-License-Identifier: Apache-2.0
#include "heap_system.h"

#include <cmath>

namespace afm::physics {

void add_sphere_tip(HeapSystem& s, const HeapContacts& heap, std::size_t i, std::size_t row, bool curved) noexcept {
  const HeapContacts::Normal normal = heap.normal_of(i);
  const double k = heap.springs().contact.si, force = k * normal.overlap_m;
  const auto& d = normal.towards;
  // d overlap/d apex = d, against the sphere: -d; curvature -(1 - dd')/r, on the flank in the plane alone
  const double away = std::sqrt(d[0] * d[0] + d[1] * d[1]);
  const std::array<double, 3> u{away > 0.0 ? d[0] / away : 1.0, away > 0.0 ? d[1] / away : 0.0, 0.0};
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      double value = k * d[a] * d[b];
      if (curved) {
        const double same = a == b ? 1.0 : 0.0;
        if (normal.ball) value -= force * (same - d[a] * d[b]) / normal.apart_m;
        if (!normal.ball && a < 2 && b < 2) value -= force * away * (same - u[a] * u[b]) / normal.apart_m;
      }
      s.stiffness[a][b] += value;
      if (row == 0) continue;
      if (b < 2) s.stiffness[a][row + b] -= value;
      if (a < 2) s.stiffness[row + a][b] -= value;
      if (a < 2 && b < 2) s.stiffness[row + a][row + b] += value;
    }
    s.gradient[a] += force * d[a];
    if (row != 0 && a < 2) s.gradient[row + a] -= force * d[a];
  }
}

void add_sphere_pair(HeapSystem& s, const HeapContacts& heap, std::size_t pair, std::size_t p, std::size_t q,
                     bool curved) noexcept {
  const HeapContacts::Touch touch = heap.touch_of(pair);
  const double k = heap.springs().contact.si, force = k * touch.overlap_m;
  const auto& u = touch.u;
  for (std::size_t a = 0; a < 2; ++a) {
    for (std::size_t b = 0; b < 2; ++b) {
      double value = k * u[a] * u[b];
      if (curved) value -= force * ((a == b ? 1.0 : 0.0) - u[a] * u[b]) / touch.apart_m;
      if (p != 0) s.stiffness[p + a][p + b] += value;
      if (q != 0) s.stiffness[q + a][q + b] += value;
      if (p != 0 && q != 0) {
        s.stiffness[p + a][q + b] -= value;
        s.stiffness[q + a][p + b] -= value;
      }
    }
    if (p != 0) s.gradient[p + a] -= force * u[a];
    if (q != 0) s.gradient[q + a] += force * u[a];
  }
}

void add_sphere_friction(HeapSystem& s, const HeapContacts::Body& body, std::size_t row) noexcept {
  const double x = body.at.x - body.start.x, y = body.at.y - body.start.y;
  const double way = std::sqrt(x * x + y * y);
  const std::array<double, 2> u{x / way, y / way};
  for (std::size_t a = 0; a < 2; ++a) {
    s.gradient[row + a] += body.moving_n * u[a];
    for (std::size_t b = 0; b < 2; ++b) {
      s.stiffness[row + a][row + b] += body.moving_n / way * ((a == b ? 1.0 : 0.0) - u[a] * u[b]);
    }
  }
}

}  // namespace afm::physics
