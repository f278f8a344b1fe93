// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "physics/tapping/driven_lever.h"
#include "physics/tapping/tapping_curve.h"
#include "physics/units.h"

namespace afm::physics {

class TapSurface;

// The jump down into the repulsive state, and the jump back.
struct TapLoop {
  TapJump in, off;
};

// The swings at rest over the height of the base, both branches, as a slow walk down and up meets them by direct
// integration (physics/tapping/tapping_oscillator.h): for a quality factor below AveragedFlow::kLeastQuality, where the
// averaged flow misses the higher harmonics. Each jump is halved to a thousandth of the free amplitude. States that the
// walk does not meet are missing. Without a jump from attraction into repulsion and one back above it, both
// branches are the way down.
//
// Constant after construction; any thread. The constructor takes up to some seconds, about as long as Q is high, and
// allocates.
class TapTable {
 public:
  // A swing at rest: u = A cos(phi), v = A sin(phi).
  struct Rest {
    double u_m = 0, v_m = 0;
    double lost_j = 0;        // energy lost in the sample per swing
    double peak_force_n = 0;  // largest force of the sample on the tip
    double mean_force_n = 0;  // mean force of the sample on the tip
  };

  TapTable(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever);

  // The swing of a branch at this height; beyond the branch's end, the swing at that end.
  Rest at(bool repelled, double z_m) const noexcept;

  // The stable swings that the walk meets at this height, the smallest amplitude first.
  std::vector<TapState> states_at(Length z) const;

  // Both jumps of the loop between the attractive and the repulsive state; empty: there is one branch.
  const std::optional<TapLoop>& loop() const noexcept { return loop_; }
  // Z below which a swing is on the repelled branch for the first time.
  Length falls_at() const noexcept { return Length(falls_m_); }

  // True if a tip on its way through `z` is on the repelled branch, after it was there (`repelled`) or not.
  bool repelled_at(bool repelled, double z_m) const noexcept { return repelled ? z_m <= leaves_m_ : z_m < falls_m_; }

  // The walk, from the highest Z to the lowest and back; a jump is two points.
  const TappingCurve& walk() const noexcept { return walk_; }
  const DrivenLever& lever() const noexcept { return lever_; }
  Length highest() const noexcept { return walk_.points.front().z; }
  Length lowest() const noexcept { return lowest_; }

 private:
  struct Node {
    double z_m = 0;
    Rest rest;
  };
  static std::vector<Node> branch_of(const std::vector<TapPoint>& points);

  DrivenLever lever_;
  TappingCurve walk_;
  std::vector<Node> attracted_, repelled_;  // nodes from the lowest Z up
  std::optional<TapLoop> loop_;
  double falls_m_ = 0, leaves_m_ = 0;  // heights at which a swing falls into the repulsive branch, leaves it
  Length lowest_;
};

}  // namespace afm::physics
