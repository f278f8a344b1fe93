// SPDX-License-Identifier: Apache-2.0
#include "laws/paper_tables.h"

#include <limits>
#include <stdexcept>

#include "physics/contact.h"
#include "physics/quantity_text.h"

namespace afm::physics {

LawTables paper_tables(const ContactParameters& contact) {
  const ApproachRetractEvents events = approach_retract_events(contact);
  if (events.z_joc <= events.z_jtc) {
    throw std::invalid_argument(
        "mean surface energy " + format_quantity(contact.mean_surface_energy, kSurfaceEnergyUnits) +
        " is too weak: jump-off-contact at " + format_quantity(events.z_joc, kLengthUnits) +
        " does not lie above jump-to-contact at " + format_quantity(events.z_jtc, kLengthUnits));
  }

  CycleFigures figures;
  figures.hysteretic = true;
  figures.z_jtc = events.z_jtc;
  figures.force_after_jtc = -events.f_attr;
  figures.tip_height_before_jtc = events.z_jtc;
  figures.tip_height_after_jtc = events.z_jtc - events.f_attr / contact.spring_constant;
  figures.z_joc = events.z_joc;
  figures.force_before_joc = -events.f_ad;
  figures.tip_height_before_joc = events.z_joc - events.f_ad / contact.spring_constant;
  figures.tip_height_after_joc = events.z_joc;
  figures.lost_at_joc = events.loop_energy;
  figures.loop_energy = events.loop_energy;
  figures.critical_stiffness = Stiffness(std::numeric_limits<double>::infinity());

  LawTables tables;
  tables.law = Law::Paper;
  tables.contact = contact;
  tables.attached = BranchTable::straight(Force(), -events.effective_stiffness);
  tables.figures = figures;
  return tables;
}

}  // namespace afm::physics
