// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lone_push.h"
#include "physics/manipulation/push_figures.h"
#include "physics/manipulation/tip_contact.h"

namespace afm::physics {

struct Apex {
  double x = 0.0, y = 0.0, height = 0.0;  // SI
};

// The tip among several spheres during one sub-step, at a fixed base. Knows what touches, and the energy of the heap:
//
//   E + R = 1/2 k_l |x_t - X|^2 + 1/2 k_c (h - Z)^2 + sum 1/2 k_n overlap^2 + sum f_k |moved|        (M16)
//
// A step's change of it is summed over the moved parts alone. Does not allocate.
class HeapContacts {
 public:
  static constexpr std::size_t kMostActive = 16;
  static constexpr std::size_t kMostLinks = 24;  // pairs of a sphere
  static constexpr std::size_t kMostPairs = 256;

  struct Sphere {
    std::size_t particle = 0;
    const TipProfile* profile = nullptr;
    Flat start, at;
    double rest_n = 0.0;    // friction that it needs to begin
    double moving_n = 0.0;  // f_k
    bool pinned = false;
    bool near_tip = false;  // the tip may touch it
    bool moved() const { return at.x != start.x || at.y != start.y; }
  };

  // Two spheres that touch at `distance_m`; one of them may be no part of the heap and stay where it is.
  struct Pair {
    std::size_t first = 0;
    std::size_t second = kMostActive;  // kMostActive: it stays
    Flat stays;
    double distance_m = 0.0;
  };

  // Tip and sphere.
  struct Normal {
    double overlap_m = -1.0;          // positive: they touch
    std::array<double, 3> towards{};  // gradient of the overlap with the apex
    double apart_m = 1.0;             // radius of curvature of the overlap
    bool ball = false;                // the cap: curved along the vertical as well
  };

  // Two spheres.
  struct Touch {
    double overlap_m = -1.0;    // positive: they touch
    double apart_m = 1.0;       // distance of the centres
    std::array<double, 2> u{};  // from the second to the first
  };

  // Proposed places of the apex, of spheres, or of both.
  struct Step {
    Apex apex;
    bool moves_apex = false;
    std::size_t count = 0;
    std::array<std::size_t, kMostActive> spheres{};
    std::array<Flat, kMostActive> to{};
  };

  explicit HeapContacts(const PushSprings& springs) noexcept : springs_(springs) {}

  // Begins a sub-step without spheres.
  void begin(const Apex& base, const Apex& apex) noexcept;
  bool add(const Sphere& sphere) noexcept;  // false: full
  bool add(const Pair& pair) noexcept;      // after its spheres; false: full

  // Number of the sphere of this particle; size() if there is none.
  std::size_t find(std::size_t particle) const noexcept;

  // Looks for contacts where all parts are. Call it after the spheres and pairs, before anything below.
  void find_contacts() noexcept;

  double stored() const noexcept;    // E
  double friction() const noexcept;  // R

  // The spheres that the following steps move, in their order.
  void choose(std::span<const std::size_t> movers) noexcept;

  // Change of E + R by a step of the chosen movers.
  double change_of(const Step& step) noexcept;
  // Takes the step whose change was asked last.
  void take(const Step& step) noexcept;

  Normal normal_of(std::size_t sphere) const noexcept;  // a gap if the tip is not near
  Touch touch_of(std::size_t pair) const noexcept;

  // Contacts after the step whose change was asked last. Valid only for what it moves.
  bool touches_then(std::size_t pair) const noexcept { return apart_then_m_[pair] < pairs_[pair].distance_m; }
  bool tip_touches_then(std::size_t sphere) const noexcept { return tips_then_[sphere].overlap.depth_m > 0.0; }

  const PushSprings& springs() const noexcept { return springs_; }
  const Apex& base() const noexcept { return base_; }
  const Apex& apex() const noexcept { return apex_; }
  std::size_t size() const noexcept { return count_; }
  const Sphere& sphere(std::size_t i) const noexcept { return spheres_[i]; }
  std::span<const std::size_t> near_tip() const noexcept { return {near_.data(), near_count_}; }
  const Pair& pair(std::size_t p) const noexcept { return pairs_[p]; }
  std::size_t pair_count() const noexcept { return pair_count_; }
  std::span<const std::uint16_t> pairs_of(std::size_t sphere) const noexcept {
    return {links_[sphere].data(), link_count_[sphere]};
  }
  // Number of a sphere among those that were chosen; kMostActive if it was not.
  std::size_t mover(std::size_t sphere) const noexcept { return sphere < kMostActive ? mover_[sphere] : kMostActive; }
  // Whether a pair counts to this mover: once, if both of its spheres move.
  bool counts_to(std::size_t sphere, std::size_t pair) const noexcept;

 private:
  // Tip and sphere, seen from the apex.
  struct TipContact {
    double x = 0.0, y = 0.0, away_m = 0.0;
    Overlap overlap;
  };

  TipContact contact_at(std::size_t sphere, const Flat& at, const Apex& apex) const noexcept;
  Flat place_of(std::size_t sphere, const Step& step) const noexcept;
  double lever_change(const Apex& to) const noexcept;
  double tip_change(std::size_t sphere, const Flat& to, const Apex& apex) const noexcept;
  double friction_change(std::size_t sphere, const Flat& to) const noexcept;
  double pair_change(std::size_t pair, const Step& step) noexcept;

  PushSprings springs_;
  Apex base_, apex_;
  std::array<Sphere, kMostActive> spheres_{};
  std::array<Pair, kMostPairs> pairs_{};
  std::array<std::size_t, kMostActive> near_{};
  std::array<TipContact, kMostActive> tips_{}, tips_then_{};                // now, and after the step asked last
  std::array<double, kMostPairs> apart_m_{}, apart_then_m_{};               // distances of pairs, now and then
  std::array<std::array<std::uint16_t, kMostLinks>, kMostActive> links_{};  // pairs of a sphere
  std::array<std::size_t, kMostActive> link_count_{};
  std::array<std::size_t, kMostActive> mover_{};
  std::size_t count_ = 0, pair_count_ = 0, near_count_ = 0;
};

}  // namespace afm::physics
