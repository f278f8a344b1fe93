// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "carried_sphere.h"
#include "heap_contacts.h"
#include "island_push.h"
#include "lever_energy.h"
#include "lone_push.h"
#include "lying_particles.h"
#include "outline.h"
#include "physics/manipulation/pushed_particles.h"
#include "tip_holds.h"

namespace afm::physics {

// A tick of PushedParticles. The constructor allocates, nothing else does.
class PushedParticles::Ticker {
 public:
  Ticker(const PushSetup& setup, const std::vector<PlacedParticle>& particles, const LeverBase& start);

  const PushTick& tick(const LeverBase& asked, double elapsed_s) noexcept;
  void hold_over(const LeverBase& base) noexcept;
  void put(std::size_t i, const Flat& at, const HalfTurn& turn) noexcept;
  std::span<const std::uint32_t> moved() const noexcept { return moved_; }
  const PushTick& last() const noexcept { return tick_; }
  const LyingParticles& lying() const noexcept { return lying_; }

 private:
  static constexpr int kMostSprings = 64;  // most steps of a recoiling lever in a tick

  // Short list of particles.
  class Few {
   public:
    bool add(std::size_t sphere) noexcept {  // false: no room
      if (count_ == spheres_.size()) return false;
      spheres_[count_++] = sphere;
      return true;
    }
    void clear() noexcept { count_ = 0; }
    bool empty() const noexcept { return count_ == 0; }
    std::size_t size() const noexcept { return count_; }
    auto begin() noexcept { return spheres_.begin(); }
    auto end() noexcept { return spheres_.begin() + static_cast<std::ptrdiff_t>(count_); }

   private:
    std::array<std::size_t, HeapContacts::kMostActive> spheres_{};
    std::size_t count_ = 0;
  };

  // Largest motions in a sub-step: of a lone part, of a part in a heap, and of the base.
  struct Reach {
    double alone_m = 0.0, heap_m = 0.0, base_m = 0.0;
  };

  struct Budget {
    double work = 0.0;  // contacts that heaps may still evaluate
    int heap_steps = 0;
  };

  struct Pressed {
    double normal_n = 0.0, sine = 0.0, cosine = 1.0;
  };

  static Reach reach_of(const PushSetup& setup) noexcept;
  void advance(const Apex& to) noexcept;
  void sub_step(const Apex& to) noexcept;
  bool find_near() noexcept;
  bool free_step(const Apex& to) noexcept;
  bool passes(std::size_t i, const Apex& to) const noexcept;
  bool lone_step(const Apex& to, std::size_t i) noexcept;
  bool island_step(const Apex& to, std::size_t i) noexcept;
  RimForce rim_force(std::size_t i) const noexcept;  // force by the bend of the lever
  void heap_step(const Apex& to) noexcept;
  void tear(const Apex& to) noexcept;
  std::size_t lifted() const noexcept;
  bool lift() noexcept;
  bool find_obstacles() noexcept;
  void carry_step(const Apex& to) noexcept;
  void set_down() noexcept;
  bool gather(const Apex& to) noexcept;
  bool gather_pairs_of(std::size_t place) noexcept;
  bool add_pairs(std::size_t first, std::size_t second, std::size_t particle) noexcept;
  bool is_alone(std::size_t i) const noexcept;
  std::size_t kind_of(std::size_t i) const noexcept {  // index of its contact in contacts_
    return lying_.species(i) * (setup_.pads.size() + 1) + lying_.ground(i);
  }
  bool add_body(std::size_t i, bool near_tip) noexcept;
  double tip_contact_j(std::size_t i, const Flat& at, const Apex& apex) const noexcept;
  double stored_everywhere() const noexcept;
  double rest_threshold(std::size_t i, double rest_n, double moving_n) const noexcept;
  double share_of_push(std::size_t i) const noexcept;
  void place(std::size_t i, const Flat& at, const HalfTurn& turn) noexcept;
  void gave(double at_n, double goes_on_n) noexcept;
  void press() noexcept;
  void publish() noexcept;

  PushSetup setup_;
  std::vector<LoneContact> contacts_;  // contact of each species with the sample and with each pad
  std::vector<double> moved_at_s_;     // time at the end of the tick in which each particle last moved
  std::vector<Pressed> pressed_;       // load of each particle by the tip after the last sub-step
  TipHolds holds_;
  Reach reach_;
  LyingParticles lying_;
  HeapContacts heap_;
  CarriedSphere carried_;
  Apex base_, apex_;
  double clear_m_ = 0.0;
  double time_s_ = 0.0, tick_end_s_ = 0.0;
  Few near_, touched_;                // particles near the tip, particles pressed by it
  Few restless_;                      // particles of a heap that is not at rest
  std::vector<std::uint32_t> moved_;  // particles moved in this tick
  std::vector<bool> moves_;           // flag of each particle: it is in moved_
  Budget left_;                       // budget left in this tick
  bool exhausted_ = false;
  bool settled_ = false;  // true: a base at rest changes nothing
  PushTick tick_;
};

}  // namespace afm::physics
