// SPDX-License-Identifier: Apache-2.0
#include "physics/jkr.h"

#include <numbers>
#include <stdexcept>

#include "physics/quantity_text.h"

namespace afm::physics {
namespace {

using std::numbers::pi;

}  // namespace

Force jkr_load(const AdhesiveContact& contact, Length contact_radius) noexcept {
  const auto& [r, e, w] = contact;
  const Volume cube = contact_radius * contact_radius * contact_radius;
  return 4.0 / 3.0 * e * cube / r - contact_radius * sqrt(8.0 * pi * w * e * contact_radius);
}

Length jkr_indentation(const AdhesiveContact& contact, Length contact_radius) noexcept {
  const auto& [r, e, w] = contact;
  return contact_radius * contact_radius / r - sqrt(2.0 * pi * w / e * contact_radius);
}

Energy jkr_energy(const AdhesiveContact& contact, Length contact_radius) noexcept {
  const auto& [r, e, w] = contact;
  const Length a = contact_radius;
  const Length hertz = a * a / r;
  const Length delta = jkr_indentation(contact, a);
  return e * a * (delta * delta - 2.0 / 3.0 * delta * hertz + hertz * hertz / 5.0) - pi * w * a * a;
}

Length jkr_contact_radius(const AdhesiveContact& contact, Force load) {
  const auto& [r, e, w] = contact;
  const Force pull_off = jkr_pull_off_load(contact);
  if (!(load >= pull_off)) {
    throw std::invalid_argument("load " + format_quantity(load, kForceUnits) + " tears the contact off, which holds " +
                                format_quantity(pull_off, kForceUnits));
  }
  const Force unit = 3.0 * pi * w * r;
  return cbrt(3.0 * r / (4.0 * e) * (load + unit + sqrt(unit * (2.0 * load + unit))));
}

Force jkr_pull_off_load(const AdhesiveContact& contact) noexcept {
  return -1.5 * pi * contact.work_of_adhesion * contact.tip_radius;
}

Length jkr_fixed_grips_radius(const AdhesiveContact& contact) noexcept {
  const auto& [r, e, w] = contact;
  return cbrt(pi * w * r * r / (8.0 * e));
}

}  // namespace afm::physics
