// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

namespace afm::physics {

// Counts the swings of a force, tick by tick: rises by at least a given size within one period, each after a fall by at
// least as much. A steady oscillation has one in each period; a loop that bounces has fewer, and a step of the sample
// only one.
class ForceSwings {
 public:
  // Takes effect from the next tick on. Both are positive.
  void look_for(double size_n, double period_ticks) noexcept {
    size_n_ = size_n;
    period_ticks_ = period_ticks;
  }

  // True at the end of a rise.
  bool add(double force_n) noexcept {
    if (risen_) {
      highest_n_ = std::max(highest_n_, force_n);
      if (highest_n_ - force_n < size_n_) return false;
      risen_ = false;
      lowest_n_ = force_n;
      ticks_ = 0.0;
      return false;
    }
    ticks_ += 1.0;
    // a slow rise does not count
    if (force_n <= lowest_n_ || ticks_ > period_ticks_) {
      lowest_n_ = force_n;
      ticks_ = 0.0;
    }
    if (force_n - lowest_n_ < size_n_) return false;
    risen_ = true;
    highest_n_ = force_n;
    return true;
  }

  double period_ticks() const noexcept { return period_ticks_; }

 private:
  double size_n_ = 1.0, period_ticks_ = 1.0;
  double lowest_n_ = 0.0, highest_n_ = 0.0;
  double ticks_ = 0.0;  // ticks since the lowest force
  bool risen_ = false;
};

}  // namespace afm::physics
