// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "physics/friction/sideways.h"
#include "physics/manipulation/marked_surface.h"
#include "physics/manipulation/push_figures.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/rows_of_enum.h"
#include "physics/units.h"

// The tip of a lever on a soft surface: quasi-static, without mass or velocity (docs/manipulation.md, "Scratches").
namespace afm::physics {

enum class ScratchState : std::uint32_t {
  Free = 0,   // nothing is touched
  Holds = 1,  // the surface supports the tip without yielding
  Marks = 2,  // the tip presses the surface in
};

struct ScratchStateText {
  ScratchState state;
  std::string_view word;
};
inline constexpr std::array kScratchStates{ScratchStateText{ScratchState::Free, "free"},
                                           ScratchStateText{ScratchState::Holds, "holds"},
                                           ScratchStateText{ScratchState::Marks, "marks"}};
static_assert(has_row_for_each(kScratchStates, &ScratchStateText::state));

// State after a tick. The certificate: given >= lost + stored, at every tick.
struct ScratchTick {
  LeverBase base;           // reached position of the base; behind the requested one while `lagging`
  LeverBase apex;           // apex on the bent lever
  Sideways<Force> lateral;  // force on the lever
  Force load;               // upward force on the lever
  ScratchState state = ScratchState::Free;
  Energy given;   // energy from the hand since the start, at a frozen tip in each sub-step: an upper bound
  Energy work;    // work of the hand since the start, by the forces at both ends of each sub-step: an estimate
  Energy lost;    // hardness times the volume pressed down since the start
  Energy stored;  // energy stored in the lever
  std::uint64_t exhausted = 0;  // number of ticks at whose end the lever still pulled the tip on, since the start
  bool stops = false;           // true: the tip is at the lowest height of the model
  bool lagging = false;
};

// Throws UnphysicalValue with the field lateral_spring or normal_spring.
void validate_lever(const PushSprings& springs);

// The constructor allocates; a tick does not, nor locks, throws or waits. One thread. The result depends on the path of
// the base, never on a clock.
//
// Each tick descends in E + R: E is the energy of the lever, R the hardness times the volume pressed down by a step. A
// step that raises the sum is never taken, so that no path of the base gains energy, however few steps the budget
// allows. Of the springs, the contact's is not used: the surface itself is rigid until it gives.
class ScratchingTip {
 public:
  // Tip for a base over the rectangle from `least` to `most`. Throws as MarkedSurface and validate_lever() do, and
  // std::invalid_argument for a start outside.
  ScratchingTip(const SphereCone& tip, const PushSprings& springs, const SoftSurface& surface,
                const Sideways<Length>& least, const Sideways<Length>& most, const LeverBase& start);

  // Moves the base on a straight line. A base that is not finite, or outside the rectangle, is ignored.
  const ScratchTick& move_to(const LeverBase& base) noexcept;

  // Takes the tip off the surface: what the lever stores and what piles up without room are given up, and the account
  // begins again. From then on the ticks depend only on the surface and on the base. A base outside the rectangle is
  // ignored.
  void hold_over(const LeverBase& base) noexcept;

  // Moves the base straight up or down in one step, down by at most half a square, with few evaluations: for a lever
  // that is raised or lowered by something other than the hand between two ticks.
  void lift_base(Length up) noexcept;

  Stiffness normal_spring() const noexcept { return springs_.normal; }
  const ScratchTick& last() const noexcept { return tick_; }
  const MarkedSurface& surface() const noexcept { return surface_; }

  // Surface for restoring it or assembling it from tiles; only while the tip is off it.
  MarkedSurface& surface_below() noexcept { return surface_; }

 private:
  // A place of the tip, E + R of the step there, and how that rises on the way to the base.
  struct Step {
    Sideways<Length> place;
    Sunk sunk;
    double energy_j, slope_n;
  };

  double stored_j(const Sideways<Length>& place, Length apex) const noexcept;
  Step step_to(const Sideways<Length>& place, const Sideways<double>& along, Length about) noexcept;
  Step least_on_the_way(const Sideways<Length>& gap, const Sideways<double>& along) noexcept;
  void take(const Step& step, const Sideways<double>& along) noexcept;
  void settle() noexcept;
  void move_base(const LeverBase& base) noexcept;
  Sideways<Force> pull() const noexcept;
  Force press() const noexcept;

  PushSprings springs_;
  SoftSurface soft_;
  MarkedSurface surface_;
  Sideways<double> along_{0.0, 0.0};  // direction of the last motion in this contact; zero: only pressed so far
  double last_way_m_;                 // length of the last sideways step
  int looks_ = 0;                     // evaluations left in this tick
  Length contact_radius_;             // radius of the contact in which the surface yielded last
  bool rested_ = true;
  ScratchTick tick_;
};

}  // namespace afm::physics
