// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/friction/sideways.h"
#include "physics/units.h"

namespace afm::physics {

// Dry friction as a spring anchored on the sample: it holds up to a yield force and drags its anchor beyond (Hayward &
// Armstrong 2000; elastic, perfectly plastic). With L the vector from the anchor to the support,
//
//   force on the support = -k L,  |k L| <= yield;  the anchor moves along L only, and only at the yield force
//
// - A held tip does not drift, and the forces depend only on the path, not on time.
// - A straight path with one yield force gives the same in one step as in many: the anchor then follows a tractrix,
//   tan(angle/2) = tan(angle_0/2) exp(-way/r) with r = yield/k, which has a closed form.
// - It only dissipates energy: a path costs 1/2 k |L|^2 at its end minus that at its beginning, plus `lost`, which is
//   positive.
//
// One thread; does not allocate or throw.
class AnchoredTip {
 public:
  explicit AnchoredTip(Stiffness spring) noexcept : k_(spring.si) {}

  // The tip touches down: no force.
  void land(const Sideways<Length>& support) noexcept;

  // Moves along a straight line to `support`, with the new yield force for the whole line. Returns the dissipated
  // energy. A lower yield force shortens L.
  Energy move_to(const Sideways<Length>& support, Force yield) noexcept;

  Sideways<Force> force() const noexcept { return {Force(-k_ * x_), Force(-k_ * y_)}; }  // force on the support
  Energy stored() const noexcept { return Energy(0.5 * k_ * (x_ * x_ + y_ * y_)); }

 private:
  double k_;
  Sideways<Length> support_{};
  double x_ = 0.0, y_ = 0.0;  // L, metres
};

}  // namespace afm::physics
