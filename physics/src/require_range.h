// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <numbers>
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

// As require_range() for an angle in radians; the message has it in degrees, as people write it.
inline void require_angle(const std::string& field, double angle_rad, double smallest_rad, double largest_rad) {
  if (angle_rad >= smallest_rad && angle_rad <= largest_rad) return;
  static constexpr std::array kDegrees{Unit{"deg", 180.0 / std::numbers::pi, true}};
  const auto text = [](double rad) { return format_si(rad, kDegrees, 3); };
  std::string words = field;
  std::replace(words.begin(), words.end(), '_', ' ');
  throw UnphysicalValue(
      field, words + " " + text(angle_rad) + " is not within " + text(smallest_rad) + " to " + text(largest_rad));
}

template <class Q>
void require_range(const std::string& field, Q value, Q smallest, Q largest, const UnitList<Q>& units) {
  require_range(field, value.si, smallest.si, largest.si, units);
}

}  // namespace afm::physics
