// SPDX-License-Identifier: Apache-2.0
#include "physics/contact.h"

#include <numbers>

namespace afm::physics {

double alpha(const Interaction& interaction) {
  return 1.0 + interaction.spring_constant / interaction.sample_stiffness;
}

Stiffness effective_stiffness(const Interaction& interaction) {
  // k_c/alpha, not k_c k_s/(k_c + k_s), which is inf/inf for a rigid sample
  return interaction.spring_constant / alpha(interaction);
}

Length jump_to_contact_gap(const Interaction& interaction) {
  return cbrt(alpha(interaction) * interaction.hamaker * interaction.tip_radius / (3.0 * interaction.spring_constant));
}

Length jump_to_contact_deflection(const Interaction& interaction) {
  const double a = alpha(interaction);
  return 0.5 * cbrt(interaction.hamaker * interaction.tip_radius / (3.0 * a * a * interaction.spring_constant));
}

Length jump_to_contact_z(const Interaction& interaction) {
  return jump_to_contact_gap(interaction) + alpha(interaction) * jump_to_contact_deflection(interaction);
}

SurfaceEnergy work_of_adhesion(const Interaction& interaction) { return 2.0 * interaction.mean_surface_energy; }

Force adhesion_force(const Interaction& interaction) {
  return 2.0 * std::numbers::pi * interaction.tip_radius * work_of_adhesion(interaction);
}

Force van_der_waals_attraction(const Interaction& interaction, Length gap) {
  return interaction.hamaker * interaction.tip_radius / (6.0 * gap * gap);
}

ApproachRetractEvents approach_retract_events(const Interaction& interaction) {
  validate(interaction);
  ApproachRetractEvents events;
  events.alpha = alpha(interaction);
  events.effective_stiffness = effective_stiffness(interaction);
  events.d_attr = jump_to_contact_gap(interaction);
  events.delta_c_attr = jump_to_contact_deflection(interaction);
  events.delta_s_attr = interaction.spring_constant / interaction.sample_stiffness * events.delta_c_attr;
  events.z_jtc = jump_to_contact_z(interaction);
  events.f_fold = interaction.spring_constant * events.delta_c_attr;
  events.f_attr = events.effective_stiffness * events.z_jtc;
  events.work_of_adhesion = work_of_adhesion(interaction);
  events.f_ad = adhesion_force(interaction);
  events.z_joc = events.f_ad / events.effective_stiffness;
  events.loop_energy = events.effective_stiffness * (events.z_joc * events.z_joc - events.z_jtc * events.z_jtc) / 2.0;
  return events;
}

}  // namespace afm::physics
