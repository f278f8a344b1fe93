// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "lone_push.h"
#include "physics/manipulation/push_figures.h"
#include "physics/manipulation/tip_contact.h"

namespace afm::physics {

struct Apex {
  double x = 0.0, y = 0.0, height = 0.0;  // SI
};

// The rule that keeps the hand from gaining energy: no step raises stored energy plus friction.
bool may_be_taken(double change_j) noexcept;

// One sub-step of the tip among several spheres: at a fixed base, it lowers
//
//   E + R = 1/2 k_l |x_t - X|^2 + 1/2 k_c (h - Z)^2 + sum 1/2 k_n overlap^2 + sum f_k |moved|        (M16)
//
// from the positions at the start of the sub-step, with h >= 0. Friction separates by sphere, so that its minimum is
// the motion of least dissipation. A step is taken only if it lowers the sum. Does not allocate.
class HeapDescent {
 public:
  static constexpr std::size_t kMostActive = 16;
  static constexpr std::size_t kMostPairs = 256;

  struct Sphere {
    std::size_t particle = 0;
    const TipProfile* profile = nullptr;
    Flat start, at;
    double rest_n = 0.0;    // friction that it needs to begin
    double moving_n = 0.0;  // f_k
    bool pinned = false;
    bool moved() const { return at.x != start.x || at.y != start.y; }
  };

  // Two spheres that touch at `distance_m`; one of them may be no part of the descent and stay where it is.
  struct Pair {
    std::size_t first = 0;
    std::size_t second = 0;  // kMostActive: it stays
    Flat stays;
    double distance_m = 0.0;
  };

  explicit HeapDescent(const PushSprings& springs) noexcept : springs_(springs) {}

  // Begins a sub-step without spheres. No part moves by more than `reach_m`.
  void begin(const Apex& base, const Apex& apex, double reach_m) noexcept;
  bool add(const Sphere& sphere) noexcept;  // false: full
  bool add(const Pair& pair) noexcept;

  // E at the start: call it after the spheres and pairs, before descend().
  double stored() const noexcept { return stored(apex_); }

  // Returns whether it came to rest within the steps.
  bool descend(int most_steps) noexcept;

  const Apex& apex() const noexcept { return apex_; }
  std::size_t size() const noexcept { return count_; }
  const Sphere& sphere(std::size_t i) const noexcept { return spheres_[i]; }
  double friction() const noexcept;  // R

 private:
  static constexpr std::size_t kMostMovers = 8;
  static constexpr std::size_t kMostUnknowns = 3 + 2 * kMostMovers;
  struct Normal {
    double overlap_m = 0.0;
    std::array<double, 3> towards{};  // gradient of the overlap with the apex
    double apart_m = 1.0;             // radius of curvature of the overlap
    bool ball = false;                // the cap: curved along the vertical as well
  };
  struct System {
    std::size_t size = 3;
    std::array<double, kMostUnknowns> gradient{};
    std::array<std::array<double, kMostUnknowns>, kMostUnknowns> stiffness{};
  };

  // Where all parts were before a step.
  struct Places {
    Apex apex;
    std::array<Flat, kMostActive> spheres{};
  };

  double stored(const Apex& apex) const noexcept;
  Places places() const noexcept;
  void restore(const Places& places) noexcept;
  double change_since(const Places& before) const noexcept;
  double overlap_change(const Sphere& sphere, const Flat& was, const Apex& apex_was) const noexcept;
  Normal normal_to(const Sphere& sphere, const Apex& apex) const noexcept;
  Flat pull_on(std::size_t i, double& spring) const noexcept;
  bool sweep(double& gained) noexcept;
  bool newton(double& gained, bool tip_alone) noexcept;
  void assemble(System& system, const std::array<std::size_t, kMostActive>& place, bool curved) const noexcept;
  void add_tip(System& system, const std::array<std::size_t, kMostActive>& place, std::size_t i,
               bool curved) const noexcept;
  void add_pair(System& system, const std::array<std::size_t, kMostActive>& place, const Pair& pair,
                bool curved) const noexcept;
  bool within_reach(const Apex& apex) const noexcept;

  PushSprings springs_;
  Apex base_, start_, apex_;
  double reach_m_ = 0.0;
  std::array<Sphere, kMostActive> spheres_{};
  std::array<Pair, kMostPairs> pairs_{};
  std::size_t count_ = 0, pair_count_ = 0;
};

}  // namespace afm::physics
