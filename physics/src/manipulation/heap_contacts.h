// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lever_energy.h"
#include "line_friction.h"
#include "lone_push.h"
#include "outline.h"
#include "physics/manipulation/push_figures.h"
#include "physics/manipulation/tip_contact.h"
#include "tip_holds.h"

namespace afm::physics {

// The tip among several bodies, spheres and rods, during one sub-step, at a fixed base. Knows what touches, and the
// energy of the heap:
//
//   E + R = 1/2 k_l |x_t - X|^2 + 1/2 k_c (h - Z)^2 + sum 1/2 k_n overlap^2 + sum f_k |moved|        (M16)
//
// The way of a rod is the mean of its points' (line_friction.h), in its frame at the start of the sub-step.
// A step's change of it is summed over the moved parts only. Does not allocate.
class HeapContacts {
 public:
  static constexpr std::size_t kMostActive = 16;
  static constexpr std::size_t kMostLinks = 24;  // largest number of pairs per body
  static constexpr std::size_t kMostPairs = 256;

  // Place of a body. A rod has turned about its middle: its front end has gone across by `turned_m` more than that.
  struct Place {
    Flat at;
    double turned_m = 0.0;
    Flat axis{1.0, 0.0};
  };

  struct Body {
    std::size_t particle = 0;
    const TipProfile* profile = nullptr;
    Flat start, at;
    double rest_n = 0.0;    // friction that must be overcome to start a motion; for a rod, sideways
    double moving_n = 0.0;  // friction during motion, f_k
    bool pinned = false;
    bool near_tip = false;  // true: the tip may touch the body
    double half_m = 0.0;    // half length of a rod; 0: none
    double core_m = 0.0;    // flat radius of an island, which a heap pushes like a sphere; 0: none
    Flat start_axis{1.0, 0.0}, axis{1.0, 0.0};
    double turned_m = 0.0;
    TipPull pull;  // adhesion of the tip; positive: the tip also pulls

    bool is_rod() const { return half_m > 0.0; }
    bool is_sphere() const { return !is_rod() && !(core_m > 0.0); }
    bool moved() const { return at.x != start.x || at.y != start.y || turned_m != 0.0; }
    Place place() const { return {at, turned_m, axis}; }
    Outline outline(const Place& there) const { return {there.at, there.axis, half_m, core_m}; }
    Place place_at(const Flat& there, double turned_there_m) const;  // place with the axis turned accordingly
    RodVector motion_to(const Place& there) const;                   // motion from the start, in the frame of the start
  };

  // Two bodies that touch at `distance_m`; one of them may be no part of the heap and stay where it is. Two rods touch
  // where an end of one meets the other: one pair for each end, +1 or -1, of first or second.
  struct Pair {
    std::size_t first = 0;
    std::size_t second = kMostActive;  // index of the second body; kMostActive: a body outside the heap, which stays
    Outline stays;
    double distance_m = 0.0;
    int first_end = 0, second_end = 0;
    bool of_spheres = false;  // true: the nearest points are the centres; set when the pair is added
  };

  // Contact of tip and body.
  struct Normal {
    double overlap_m = -1.0;          // overlap of tip and body; positive: they touch
    bool acts = false;                // true: tip and body touch, or the tip holds the body
    std::array<double, 3> towards{};  // gradient of the overlap with the apex
    double apart_m = 1.0;             // radius of curvature of the overlap
    bool ball = false;                // true: contact on the cap, which is also curved along the vertical
    double turning = 0.0;             // derivative of the overlap with the turn of a rod
  };

  // Contact of two bodies.
  struct Touch {
    double overlap_m = -1.0;                           // overlap of both bodies; positive: they touch
    double apart_m = 1.0;                              // distance of the nearest points of their axes
    std::array<double, 2> u{};                         // unit vector from the second to the first
    double turning_first = 0.0, turning_second = 0.0;  // derivatives of the distance with the turns of rods
  };

  // Proposed places of the apex, of bodies, or of both.
  struct Step {
    Apex apex;
    bool moves_apex = false;
    std::size_t count = 0;
    std::array<std::size_t, kMostActive> movers{};
    std::array<Place, kMostActive> to{};
  };

  explicit HeapContacts(const PushSprings& springs) noexcept : springs_(springs) {}

  // Begins a sub-step without bodies.
  void begin(const Apex& base, const Apex& apex) noexcept;
  bool add(const Body& body) noexcept;  // false: no room for another body
  bool add(const Pair& pair) noexcept;  // adds a pair after its bodies; false: no room for another pair

  // Number of the body of this particle; size() if there is none.
  std::size_t find(std::size_t particle) const noexcept;

  // Looks for contacts where all parts are. Call it after the bodies and pairs, before anything below.
  void find_contacts() noexcept;

  double stored() const noexcept;    // stored energy E
  double friction() const noexcept;  // friction work R

  // The bodies that the following steps move, in their order.
  void choose(std::span<const std::size_t> movers) noexcept;

  // Change of E + R by a step of the chosen movers.
  double change_of(const Step& step) noexcept;
  // Takes the step whose change was computed last.
  void take(const Step& step) noexcept;

  Normal normal_of(std::size_t body) const noexcept;  // contact with the tip; negative overlap if the tip is not near
  Touch touch_of(std::size_t pair) const noexcept;

  // The same as Normal::acts, and as an overlap of Touch above 0, without directions.
  bool tip_acts(std::size_t body) const noexcept { return bodies_[body].near_tip && acts(body, tips_[body]); }
  bool touches(std::size_t pair) const noexcept {
    return apart_m_[pair] > 0.0 && pairs_[pair].distance_m - apart_m_[pair] > 0.0;
  }

  // Contacts after the step whose change was computed last. Valid only for the bodies that it moves.
  bool touches_then(std::size_t pair) const noexcept { return apart_then_m_[pair] < pairs_[pair].distance_m; }
  bool tip_acts_then(std::size_t body) const noexcept { return acts(body, tips_then_[body]); }

  const PushSprings& springs() const noexcept { return springs_; }
  const Apex& base() const noexcept { return base_; }
  const Apex& apex() const noexcept { return apex_; }
  std::size_t size() const noexcept { return count_; }
  const Body& body(std::size_t i) const noexcept { return bodies_[i]; }
  std::span<const std::size_t> near_tip() const noexcept { return {near_.data(), near_count_}; }
  const Pair& pair(std::size_t p) const noexcept { return pairs_[p]; }
  bool has_rod(std::size_t p) const noexcept {
    return !pairs_[p].of_spheres && (bodies_[pairs_[p].first].is_rod() || second_of(pairs_[p]).half_m > 0.0);
  }
  std::size_t pair_count() const noexcept { return pair_count_; }
  std::span<const std::uint16_t> pairs_of(std::size_t body) const noexcept {
    return {links_[body].data(), link_count_[body]};
  }
  // Number of a body among those that were chosen; kMostActive if it was not.
  std::size_t mover(std::size_t body) const noexcept { return body < kMostActive ? mover_[body] : kMostActive; }
  // True if a pair counts for this mover: once, if both of its bodies move.
  bool counts_to(std::size_t body, std::size_t pair) const noexcept {
    return pairs_[pair].first == body || mover_[pairs_[pair].first] == kMostActive;
  }

 private:
  // Tip and nearest point of a body's axis, seen from the apex.
  struct TipContact {
    double x = 0.0, y = 0.0, away_m = 0.0;
    Overlap overlap;
  };

  // The points of two axes that are nearest to each other, as far as the pair goes.
  struct Nearest {
    Flat first, second;
  };

  bool acts(std::size_t body, const TipContact& tip) const noexcept {
    return tip.overlap.depth_m > 0.0 || bodies_[body].pull.holds();
  }
  TipContact contact_at(std::size_t body, const Place& at, const Apex& apex) const noexcept;
  Place place_of(std::size_t body, const Step& step) const noexcept;
  Outline second_of(const Pair& pair) const noexcept;
  static Nearest nearest_of(const Pair& pair, const Outline& first, const Outline& second) noexcept;
  // Nearest points where all parts are, and after a step.
  Nearest nearest_now(const Pair& pair) const noexcept {
    const bool stays = pair.second == kMostActive;
    if (pair.of_spheres) return {bodies_[pair.first].at, stays ? pair.stays.at : bodies_[pair.second].at};
    return nearest_of(pair, bodies_[pair.first].outline(bodies_[pair.first].place()), second_of(pair));
  }
  Nearest nearest_then(const Pair& pair, const Step& step) const noexcept {
    const bool stays = pair.second == kMostActive;
    if (pair.of_spheres) {
      const auto center = [&](std::size_t i) -> const Flat& {
        return mover_[i] == kMostActive ? bodies_[i].at : step.to[mover_[i]].at;
      };
      return {center(pair.first), stays ? pair.stays.at : center(pair.second)};
    }
    return nearest_of(pair, bodies_[pair.first].outline(place_of(pair.first, step)),
                      stays ? pair.stays : bodies_[pair.second].outline(place_of(pair.second, step)));
  }
  double lever_change(const Apex& to) const noexcept;
  double tip_change(std::size_t body, const Place& to, const Apex& apex) const noexcept;
  double friction_change(std::size_t body, const Place& to) const noexcept;
  double pair_change(std::size_t pair, const Step& step) noexcept;

  PushSprings springs_;
  Apex base_, apex_;
  std::array<Body, kMostActive> bodies_{};
  std::array<std::size_t, kMostActive> particles_{};  // particle of each body
  std::array<Pair, kMostPairs> pairs_{};
  std::array<std::size_t, kMostActive> near_{};
  std::array<TipContact, kMostActive> tips_{}, tips_then_{};                // tip contacts: now, after the newest step
  std::array<double, kMostPairs> apart_m_{}, apart_then_m_{};               // gaps of pairs: now, after the newest step
  std::array<std::array<std::uint16_t, kMostLinks>, kMostActive> links_{};  // indices of the pairs of each body
  std::array<std::size_t, kMostActive> link_count_{};
  std::array<std::size_t, kMostActive> mover_{};
  std::size_t count_ = 0, pair_count_ = 0, near_count_ = 0;
};

}  // namespace afm::physics
