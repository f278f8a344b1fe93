// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "physics/friction/friction.h"
#include "physics/friction/sideways.h"
#include "physics/units.h"

namespace afm::physics {

// The lattice's potential in units of U: v(x) = sum over its waves of 1 - cos(g . x), zero in the wells. Hexagonal:
// three waves of the length sqrt(3)/2 a, so that V = U v = const - U [2 cos(2 pi x/a) cos(2 pi y/(sqrt3 a)) + cos(4 pi
// y/(sqrt3 a))], with wells of 0, saddles of 4 U and tops of 4.5 U, and the stiffness 8 pi^2 U/a^2 all around a well.
// Rows and Square: waves along x, and along y.
class LatticeLandscape {
 public:
  LatticeLandscape(LatticeKind kind, Length period) noexcept;

  struct Place {
    double height = 0.0;
    double slope_x = 0.0, slope_y = 0.0;                 // gradient of the height, 1/m
    double bend_xx = 0.0, bend_xy = 0.0, bend_yy = 0.0;  // second derivatives of the height, 1/m^2
    std::array<double, 4> third{};                       // third derivatives xxx, xxy, xyy, yyy, 1/m^3
  };
  Place at(double x_m, double y_m) const noexcept;

  double period_m() const noexcept { return period_m_; }
  double sharpest_bend() const noexcept;  // upper bound of the curvature, 1/m^2
  double highest() const noexcept;        // upper bound of the height

 private:
  struct Wave {
    double x = 0.0, y = 0.0;  // wave vector g, 1/m
  };
  double period_m_;
  std::array<Wave, 3> waves_{};
  std::uint32_t count_ = 0;
};

// A jump of the tip from one well to another.
struct LatticeSlip {
  double fraction = 0.0;         // fraction of the step's path at which the tip slips, in [0, 1]
  Sideways<Length> support;      // position of the support
  Sideways<Length> way;          // displacement of the tip
  Sideways<Force> force_before;  // force on the support
  Sideways<Force> force_after;
  Energy lost;  // dissipated energy, positive
};

// The tip of Prandtl and Tomlinson on a lattice, V = U v(x) + (k/2) |x - X|^2. It stays in its well as long as there is
// one, and then takes the steepest way down to the next (an overdamped tip, pulled infinitely slowly). Its state is its
// position only:
//
// - Slips are exactly where the well ends, on the straight path between two steps, as many as there are. Forces and
//   slips do not depend on the division into steps or on time.
// - It only dissipates energy: dV = F . dX + v dU along a path, and every slip loses some.
// - U changes with the load. V then also pushes along the load's axis, with v dU/dN dN/dz: see relief().
//
// A path of many periods in one step is cut at its beginning (kLongestPath), which bounds the work of a step. One
// thread; does not allocate or throw.
class LatticeTip {
 public:
  static constexpr double kLongestPath = 3.0;  // longest path of a step, in periods
  static constexpr std::size_t kMostSlips = 6;

  LatticeTip(LatticeKind kind, Length period, Stiffness spring) noexcept;

  // Result of a step. Only a cut path or a touch-down can store energy that the hand has not supplied: `given`.
  struct Step {
    std::array<LatticeSlip, kMostSlips> slips{};
    std::uint32_t slip_count = 0;
    Energy lost;   // energy lost by slips and by leaving an unstable position
    Energy given;  // energy that no hand supplied, at or above zero
    std::span<const LatticeSlip> slipped() const noexcept { return std::span(slips).first(slip_count); }
  };

  // Puts the tip down above the support and lets it settle in its well; `scale` is U.
  Step land(const Sideways<Length>& support, Energy scale) noexcept;

  // Moves to `support`, with U changing to `scale` along the way.
  Step move_to(const Sideways<Length>& support, Energy scale) noexcept;

  Sideways<Force> force() const noexcept;  // force on the support, k (x - X)
  Sideways<Length> tip() const noexcept { return {Length(x_), Length(y_)}; }
  Energy stored() const noexcept;  // potential energy V
  double relief() const noexcept;  // v: dV/dU at a fixed support

 private:
  // Inputs of the potential: a support and a U.
  struct Control {
    double x = 0.0, y = 0.0, scale = 0.0;
  };
  // Position x of a tip at rest and the second derivatives of V there.
  struct Rest {
    double x = 0.0, y = 0.0;
    double xx = 0.0, xy = 0.0, yy = 0.0;
    double least() const noexcept;  // smaller eigenvalue of the second derivatives
  };

  Control on_path(const Control& from, const Control& change, double t) const noexcept;
  double potential(double x, double y, const Control& at) const noexcept;
  Rest rest_at(double x, double y, const Control& at) const noexcept;
  bool settle(Rest& rest, const Control& at, double reach) const noexcept;
  void roll_down(double x, double y, const Control& at) noexcept;
  static std::array<double, 2> softest(const Rest& rest) noexcept;
  bool leads_to(const Rest& rest, double t, const Rest& last, double end, const Control& at,
                const Control& change) const noexcept;
  void slip(double fraction, const Control& change, Step& step) noexcept;
  bool find_end_of_well(const Control& from, const Control& change, double t, double furthest, Rest& rest,
                        double& end) const noexcept;
  void follow(const Control& from, const Control& change, Step& step) noexcept;

  LatticeLandscape landscape_;
  double k_;
  Control now_;
  double x_ = 0.0, y_ = 0.0;  // position of the tip
};

}  // namespace afm::physics
