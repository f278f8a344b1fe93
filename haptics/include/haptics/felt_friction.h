// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "haptics/device.h"
#include "haptics/sample_surface.h"
#include "haptics/scaling.h"
#include "physics/force_model.h"
#include "physics/friction/lateral_contact.h"
#include "physics/law_tables.h"
#include "scene/shared/shared_blocks.h"

namespace afm::haptics {

// The friction of one material, as the hand meets it: sideways forces that take energy, beside the law's that keep it.
//
// - The load is what the attached branch of the law pulls or pushes at the tip's Z, and the strongest pull of that
//   branch: a function of Z alone, zero where contact is lost. A lever that swings rubs with its mean load.
// - Forces and slips on the tip are those of physics/friction/lateral_contact.h on every scale. On the hand they have
// the gain of
//   the law's force, or less, so that the lateral spring is at most kShareOfStiffness of what the device can be given
//   (Scaling::kMaxStiffnessNPerM): a loop at 1 kHz holds it still.
// - A lattice whose depth follows the load pushes along the normal too, by what the rise of the load has to pay; so the
//   force is the gradient of what is stored, and no path gains energy.
// - Off the sample there is no force, and nothing is remembered.
//
// create() allocates; the rest is for a tick of the servo.
class FeltFriction {
 public:
  // Where a surface bends, its force takes the other half.
  static constexpr double kShareOfStiffness = 0.5;

  // `material` has friction and is valid; `tables` are its own. Throws std::invalid_argument as LateralContact does.
  FeltFriction(const scene::SharedContact& material, std::shared_ptr<const physics::LawTables> tables,
               const DeviceSpec& device);

  // What one step gave. Frames as in Touch.
  struct Step {
    physics::Sideways<physics::Force> lateral;  // on the tip's holder, by the sample
    glm::dvec3 hand_force_n{0.0};
    double given_j = 0.0;  // on the hand: stored by a touch-down, which a jump has paid
    physics::LateralContact::Step events;
  };

  // The tip is at `xy_m` and `z_m` above the surface `below` it, in the phase and after the jumps of `response`.
  Step step(const glm::dvec2& xy_m, double z_m, const SampleSurface::Place& below, const physics::TipResponse& response,
            const Scaling& scaling) noexcept;
  void lift() noexcept { contact_.lift(); }

  double stored_j(const Scaling& scaling) const noexcept;  // on the hand
  double stiffness_n_per_m(const Scaling& scaling) const noexcept;
  double gain(const Scaling& scaling) const noexcept;  // N on the hand for a lateral newton on the tip

 private:
  physics::Force load(double z_m) const noexcept;
  double load_slope_n_per_m(double z_m) const noexcept;

  std::shared_ptr<const physics::LawTables> tables_;
  physics::Force adhesion_;
  physics::LateralContact contact_;
  double largest_stiffness_n_per_m_;
  glm::dvec2 before_m_{0.0};
};

}  // namespace afm::haptics
