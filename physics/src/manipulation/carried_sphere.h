// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "lever_energy.h"
#include "lone_push.h"
#include "outline.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/manipulation/tip_contact.h"

namespace afm::physics {

// A sphere that hangs on the tip and moves with it, and the other particles, which stay where they are: the tip and the
// sphere rest against them without friction. The energy of all that,
//
//   E = 1/2 k_l |x_t - X|^2 + 1/2 k_c (h - Z)^2 + sum 1/2 k_n overlap^2                                  (M28)
//
// depends only on the place of the apex. Does not allocate.
class CarriedSphere {
 public:
  struct Obstacle {
    Outline outline;
    double radius_m = 0.0;
    const TipProfile* profile = nullptr;  // contact of tip and obstacle
  };

  explicit CarriedSphere(const PushSprings& springs) noexcept : springs_(springs) {}

  bool any() const noexcept { return particle_ != kNoParticle; }
  std::size_t particle() const noexcept { return particle_; }

  // Takes a sphere at its place on the sample, with the apex above the height at which it would touch the sphere: the
  // gap closes.
  void take(std::size_t particle, Length radius, const Flat& at, const SphereCone& tip, const Apex& apex,
            double touches_at_m) noexcept;
  void drop() noexcept { particle_ = kNoParticle; }

  const Flat& from() const noexcept { return from_; }  // place on the sample from which the sphere was taken
  Flat place(const Apex& apex) const noexcept { return {apex.x + offset_.x, apex.y + offset_.y}; }
  double height_m(const Apex& apex) const noexcept { return apex.height - lowest_apex_m_; }  // lowest point
  bool lies(const Apex& apex) const noexcept { return apex.height <= lowest_apex_m_; }

  // Obstacles near tip and sphere, for the calls below.
  void begin() noexcept { count_ = 0; }
  bool add(const Obstacle& obstacle) noexcept;  // false: no room for another obstacle

  // True if the apex rests at the base, or above it where the sphere lies, and nothing else touches.
  bool is_free(const Apex& base, const Apex& apex) const noexcept;

  double energy_j(const Apex& base, const Apex& apex) const noexcept;
  double pressed_j(const Apex& apex) const noexcept;  // energy of the contacts of the carried sphere only

  // Moves the apex by at most `reach_m` to less energy, no lower than where the sphere lies on the sample. True if it
  // then rests.
  bool settle(const Apex& base, double reach_m, Apex& apex) const noexcept;

 private:
  static constexpr std::size_t kMostObstacles = 16;

  using Vector = std::array<double, 3>;
  using Matrix = std::array<Vector, 3>;

  // Overlap of the tip or the sphere with an obstacle, and its gradient with the apex.
  struct Meeting {
    double overlap_m = -1.0;
    Vector towards{};
  };
  Meeting of_tip(const Obstacle& obstacle, const Apex& apex) const noexcept;
  Meeting of_sphere(const Obstacle& obstacle, const Apex& apex) const noexcept;
  bool touches(const Apex& apex) const noexcept;
  Apex at_rest(const Apex& base) const noexcept { return {base.x, base.y, std::max(lowest_apex_m_, base.height)}; }
  bool newton(const Apex& base, const Apex& apex, Vector& step) const noexcept;

  PushSprings springs_;
  std::size_t particle_ = kNoParticle;
  double radius_m_ = 0.0;
  Flat offset_;                 // position of the sphere's centre relative to the apex
  double lowest_apex_m_ = 0.0;  // height of the apex at which the sphere lies on the sample
  Flat from_;
  std::array<Obstacle, kMostObstacles> obstacles_{};
  std::size_t count_ = 0;
};

}  // namespace afm::physics
