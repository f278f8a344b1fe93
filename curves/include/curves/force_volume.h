// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "curves/recorded_curve.h"
#include "physics/measured_branches.h"

namespace afm::curves {

// The curves of a force map as one volume to look at: the force at each pixel by the height of the lever's base above
// the deepest point of its curve, where the heights of a map are taken, too. Baselines are subtracted. Of a large map
// every second, third, ... pixel is kept along each side, of a curve kMostPoints a branch. Gathered once, then const;
// any thread.
class ForceVolume {
 public:
  static constexpr std::size_t kMostSide = 128;  // largest number of kept pixels along a side
  static constexpr std::size_t kMostPoints = 64;

  enum class Way { Approach, Retract };

  // Gathers curves while they are read. add() may be called by several threads at a time.
  class Gatherer {
   public:
    // Leaves out a curve without contact or retract, and one on another grid than the first.
    void add(const RecordedCurve& curve);

    // Call once, after every add().
    ForceVolume finish();

   private:
    std::mutex mutex_;
    std::optional<MapGrid> grid_;
    std::vector<std::pair<MapPixel, physics::MeasuredBranches>> found_;
  };

  // Number of kept pixels with a curve, and of all that are kept.
  std::size_t known() const;
  std::size_t size() const { return cells_.size(); }

  // Force at a place of the map, 0 to 1 from its left and from its lower edge, and a height of at least 0. NaN: no
  // curve, or the curve does not reach there.
  double force_n(Way way, double across, double up, double height_m) const;

  // Greatest height at which a curve reaches a force: a push on its approach, a pull on its retract. NaN: nowhere.
  double height_of_m(double force_n, double across, double up) const;
  // Number of known pixels at which a force is reached.
  std::size_t reached(double force_n) const;

  // Range of the forces without outliers; a pull is negative. Neither is less than a fiftieth of the other.
  double strongest_pull_n() const { return strongest_pull_n_; }
  double strongest_push_n() const { return strongest_push_n_; }

  // Height above which hardly any curve has a force.
  double top_m() const { return top_m_; }

 private:
  // Point in single precision, which is enough for a picture and half the memory.
  struct Point {
    float height_m, force_n;
  };
  using Branch = std::vector<Point>;  // points of a branch by rising height
  using Cell = std::array<Branch, 2>;

  const Branch& branch_at(Way way, double across, double up) const;
  static double height_on(const Branch& branch, double force_n);
  void measure();
  static std::size_t stride_of(const MapGrid& grid);

  std::size_t columns_ = 0, rows_ = 0;  // number of kept pixels; rows from below
  MapGrid grid_;
  std::size_t stride_ = 1;
  std::vector<Cell> cells_;
  double strongest_pull_n_ = 0, strongest_push_n_ = 0, top_m_ = 0;
};

}  // namespace afm::curves
