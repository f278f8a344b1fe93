// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "haptics/device.h"
#include "haptics/particle_push.h"
#include "scene/shared/particle_blocks.h"

namespace afm::haptics {

// Limits of a groove on a device.
struct GrooveLimits {
  double most_force_n = 0;  // largest force; 0: no groove
  double most_stiffness_n_per_m = 0;
};
GrooveLimits groove_limits(const DeviceSpec& device);  // limits for a device as limited by the operator

// Groove that guides a hand along the plan of a push: a virtual fixture (Rosenberg 1993; for an AFM's tip Varol, Gunev
// & Basdogan). A force field in the plane of the sample, whatever the height of the hand, in metres of the hand with d
// the distance from the line and s the way along it:
//
//   U = -gain U_0 (1 - d^2/w^2)^3 W(s)   for d < w, else 0
//
// - W is 1 between the ends of the line, and falls to exactly 0 within 2 w beyond each, by a quintic step. Between the
//   ends the force is at right angles to the line; where the groove ends, a conservative field needs a part along it.
// - The force is at most GrooveLimits::most_force_n, U_0 = kDepth most_force_n w, and w follows from the stiffness.
// - The gain grows from 0 to 1 within kFadeS, and falls as slowly when the plan or its groove ends. Another line waits
//   until the gain is 0. At a constant gain no closed path gains energy; the change of the gain is known in every tick
//   (GroovePull::given_j). Switching on and off once gives a hand U_0 at most, about 2 mJ.
//
// Servo's thread; neither allocates nor throws.
class FeltGroove {
 public:
  static constexpr double kMostForceN = 0.3;
  static constexpr double kShareOfCap = 0.25;
  static constexpr double kShareOfStiffness = 0.25;  // share of the stiffness that the device can render
  static constexpr double kFadeS = 0.5;
  static constexpr double kDepth = 0.5823093;  // 25 sqrt(5)/96, depth over width at which the steepest slope is 1/w
  static constexpr double kCurvature = 6.0;    // largest curvature, at the line, in units of U_0/w^2
  static constexpr double kRampOverWidth = 2.0;

  // `hand_m_per_m` is the scale of the particles.
  FeltGroove(const GrooveLimits& limits, double hand_m_per_m);

  // Follows the newest plan, a valid one (scene::is_valid).
  void follow(const scene::PlannedPush& plan) noexcept { plan_ = plan; }
  const scene::PlannedPush& plan() const noexcept { return plan_; }

  // `tip_xy_m` is in metres of the nanoworld. The groove fades while it may not act.
  GroovePull step(const glm::dvec2& tip_xy_m, bool may_act, double elapsed_s) noexcept;

  // Removes the groove at once; call where no force is applied.
  void drop() noexcept;

  const glm::dvec2& force_n() const noexcept { return pull_.force_n; }  // force in the newest step, zero after drop()
  double half_width_m() const noexcept { return half_width_m_; }        // w, half width in the hand's metres

 private:
  // Line of the plan, in metres of the hand.
  struct Line {
    glm::dvec2 from_m{0.0};
    glm::dvec2 along{1.0, 0.0};  // unit vector of the line's direction
    double length_m = 0;
    bool operator==(const Line&) const = default;
  };
  struct Field {
    double stored_j = 0;
    glm::dvec2 force_n{0.0};
  };

  std::optional<Line> wanted_line() const noexcept;
  Field field_at(const glm::dvec2& hand_m) const noexcept;

  double hand_m_per_m_;
  double half_width_m_ = 0;
  double depth_j_ = 0;
  double stiffness_n_per_m_ = 0;
  scene::PlannedPush plan_;
  Line line_;
  double gain_ = 0;
  GroovePull pull_;
};

}  // namespace afm::haptics
