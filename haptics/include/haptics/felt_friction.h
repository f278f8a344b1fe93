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

// Friction of one material, as felt by the hand: lateral forces that dissipate energy, added to the law's conservative
// ones.
//
// - The load is the pull or push of the law's attached branch at the tip's Z, plus the strongest pull of that branch: a
//   function of Z only, zero where contact is lost. An oscillating lever rubs with its mean load.
// - Forces and slips on the tip are those of physics/friction/lateral_contact.h on every scale. On the hand they have
//   the gain of the law's force, or less, so that the lateral spring is at most kShareOfStiffness of the largest
//   renderable stiffness (Scaling::kMaxStiffnessNPerM), which a 1 kHz loop keeps stable.
// - A particle beside the tip bears a part of the load by the flank, and the sample rubs that much less (M83 of
//   docs/manipulation.md). A lattice, whose stored energy follows the load, does not notice, so that no path gains
//   energy.
// - A lattice whose depth follows the load also pushes along the normal, by the energy that a rising load adds. The
//   force is thus the gradient of the stored energy, and no path gains energy.
// - Off the sample there is no force and no memory.
//
// create() allocates; everything else may be called in a tick of the servo.
class FeltFriction {
 public:
  // Share of the largest stiffness; the force on a curved surface uses the other half.
  static constexpr double kShareOfStiffness = 0.5;

  // `material` has friction and is valid; `tables` are its own. Throws std::invalid_argument like LateralContact.
  FeltFriction(const scene::SharedContact& material, std::shared_ptr<const physics::LawTables> tables,
               const DeviceSpec& device);

  // Result of one step. Frames as in Touch.
  struct Step {
    physics::Sideways<physics::Force> lateral;  // force of the sample on the holder of the tip
    glm::dvec3 hand_force_n{0.0};
    double given_j = 0.0;  // energy on the hand stored by a touch-down and paid for by the jump to contact
    physics::LateralContact::Step events;
  };

  // Height above the surface, which determines the load, and the part of the load that a particle at the flank bears.
  struct Pressed {
    double z_m = 0;
    double borne_n = 0;
  };

  // Moves the tip to `xy_m` above the surface `below` it, in the phase and after the jumps of `response`.
  Step step(const glm::dvec2& xy_m, const Pressed& pressed, const SampleSurface::Place& below,
            const physics::TipResponse& response, const Scaling& scaling) noexcept;
  void lift() noexcept { contact_.lift(); }

  double stored_j(const Scaling& scaling) const noexcept;  // stored energy on the hand
  double stiffness_n_per_m(const Scaling& scaling) const noexcept;
  double gain(const Scaling& scaling) const noexcept;  // newtons on the hand per lateral newton on the tip

 private:
  physics::Force load(double z_m) const noexcept;
  double load_slope_n_per_m(double z_m) const noexcept;

  std::shared_ptr<const physics::LawTables> tables_;
  physics::Force adhesion_;
  physics::LateralContact contact_;
  double largest_stiffness_n_per_m_;
  bool is_lattice_;
  glm::dvec2 before_m_{0.0};
};

}  // namespace afm::haptics
