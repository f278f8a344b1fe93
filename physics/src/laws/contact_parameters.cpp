// SPDX-License-Identifier: Apache-2.0
#include "physics/contact_parameters.h"

#include <limits>

#include "require_range.h"

namespace afm::physics {

void validate(const ContactParameters& contact) {
  for (const ContactField& field : kContactFields) {
    const double si = field.get(contact);
    if (field.infinity == Infinity::Allowed && si == std::numeric_limits<double>::infinity()) continue;
    require_range(std::string(field.name), si, field.smallest, field.largest, *field.units);
  }
}

}  // namespace afm::physics
