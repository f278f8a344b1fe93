// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

#include "physics/contact_parameters.h"
#include "physics/quantity_text.h"

namespace afm::physics {

// Throws UnphysicalValue unless smallest <= value <= largest; NaN fails. `field` is the member's name; with blanks for
// underscores it is what a person reads.
template <class Q>
void require_range(const std::string& field, Q value, Q smallest, Q largest, const UnitList<Q>& units) {
  if (value >= smallest && value <= largest) return;
  std::string words = field;
  std::replace(words.begin(), words.end(), '_', ' ');
  throw UnphysicalValue(field, words + " " + format_quantity(value, units) + " is not within " +
                                   format_quantity(smallest, units) + " to " + format_quantity(largest, units));
}

}  // namespace afm::physics
