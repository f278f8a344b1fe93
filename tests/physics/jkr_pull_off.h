// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "physics/adhesive_contact.h"

namespace afm::physics {

// Radius at pull-off, a^3 = 9 pi W R^2/(8 E*), for a given load.
inline Length jkr_pull_off_radius(const AdhesiveContact& contact) {
  const auto& [r, e, w] = contact;
  return cbrt(9.0 * std::numbers::pi * w * r * r / (8.0 * e));
}

}  // namespace afm::physics
