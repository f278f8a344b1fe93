// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "physics/tapping/driven_lever.h"
#include "physics/tapping/tapping_oscillator.h"
#include "physics/units.h"

namespace afm::physics {

class TapSurface;

// Deflection and velocity of a tapping tip at the drive's angle of zero, mapped to those one swing later, by direct
// integration (physics/tapping/tapping_oscillator.h). A swing at rest is a fixed point of this map, which Newton's
// method finds in tens of swings, where the tip itself takes some 8 Q. It also finds the swings of soft levers that
// adhesion bends too much for averages (physics/tapping/averaged_flow.h).
//
// Swings that repeat only after several periods of the drive, or never, are missing; so are those of a law with a
// latch that is closed at the drive's angle of zero though the tip is above contact. One thread. Allocates.
class SwingMap {
 public:
  SwingMap(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever);

  // Stable swings at rest to which a grid of starts leads, except those of `known`; the smallest amplitude first. Takes
  // some 0.2 to 3 s.
  std::vector<DirectSwing> stable_beside(std::span<const TapState> known, Length z);

 private:
  using Point = std::complex<double>;  // deflection + i velocity/(angular rate of the drive), m
  // A fixed point of the map.
  struct Fixed {
    Point at;
    bool stable;
  };
  Point after(Point point, Length z, int swings = 1);
  std::optional<Fixed> fixed_near(Point at, Length z);
  std::optional<Point> rest_of(Point at, Length z, std::span<const Point> known);
  std::vector<Point> stable_points(Length z);  // fixed points to which the grid leads, each once
  std::optional<DirectSwing> settled_near(Point at, Length z);

  TappingOscillator tip_, fine_;  // fine_: the same tip with shorter steps
  double a0_m_;
};

}  // namespace afm::physics
