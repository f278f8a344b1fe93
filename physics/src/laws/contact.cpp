// SPDX-License-Identifier: Apache-2.0
#include "physics/contact.h"

#include <numbers>

namespace afm::physics {

double alpha(const ContactParameters& contact) { return 1.0 + contact.spring_constant / contact.sample_stiffness; }

Stiffness effective_stiffness(const ContactParameters& contact) {
  // k_c/alpha, not k_c k_s/(k_c + k_s), which is inf/inf for a rigid sample
  return contact.spring_constant / alpha(contact);
}

Length jump_to_contact_gap(const ContactParameters& contact) {
  return cbrt(alpha(contact) * contact.hamaker * contact.tip_radius / (3.0 * contact.spring_constant));
}

Length jump_to_contact_deflection(const ContactParameters& contact) {
  const double a = alpha(contact);
  return 0.5 * cbrt(contact.hamaker * contact.tip_radius / (3.0 * a * a * contact.spring_constant));
}

Length jump_to_contact_z(const ContactParameters& contact) {
  return jump_to_contact_gap(contact) + alpha(contact) * jump_to_contact_deflection(contact);
}

SurfaceEnergy work_of_adhesion(const ContactParameters& contact) { return 2.0 * contact.mean_surface_energy; }

Force adhesion_force(const ContactParameters& contact) {
  return 2.0 * std::numbers::pi * contact.tip_radius * work_of_adhesion(contact);
}

ApproachRetractEvents approach_retract_events(const ContactParameters& contact) {
  validate(contact);
  ApproachRetractEvents events;
  events.alpha = alpha(contact);
  events.effective_stiffness = effective_stiffness(contact);
  events.d_attr = jump_to_contact_gap(contact);
  events.delta_c_attr = jump_to_contact_deflection(contact);
  events.delta_s_attr = contact.spring_constant / contact.sample_stiffness * events.delta_c_attr;
  events.z_jtc = jump_to_contact_z(contact);
  events.f_fold = contact.spring_constant * events.delta_c_attr;
  events.f_attr = events.effective_stiffness * events.z_jtc;
  events.work_of_adhesion = work_of_adhesion(contact);
  events.f_ad = adhesion_force(contact);
  events.z_joc = events.f_ad / events.effective_stiffness;
  events.loop_energy = events.effective_stiffness * (events.z_joc * events.z_joc - events.z_jtc * events.z_jtc) / 2.0;
  return events;
}

}  // namespace afm::physics
