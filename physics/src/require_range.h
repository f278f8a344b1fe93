// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

#include "physics/contact_parameters.h"
#include "physics/quantity_text.h"

namespace afm::physics {

// Throws UnphysicalValue unless smallest <= value <= largest, SI; NaN fails. `field` is the member's name; the message
// shows it with blanks for underscores.
inline void require_range(const std::string& field, double value, double smallest, double largest, const Units& units) {
  if (value >= smallest && value <= largest) return;
  std::string words = field;
  std::replace(words.begin(), words.end(), '_', ' ');
  throw UnphysicalValue(
      field, words + " " + format_si(value, units.units) + " is not within " + range_text(smallest, largest, units));
}

template <class Q>
void require_range(const std::string& field, Q value, Q smallest, Q largest, const UnitList<Q>& units) {
  require_range(field, value.si, smallest.si, largest.si, units);
}

}  // namespace afm::physics
