// SPDX-License-Identifier: Apache-2.0
#include "haptics/device.h"

#include <algorithm>
#include <cmath>

namespace afm::haptics {

namespace {
constexpr double kDefaultCapN = 2.0;
constexpr double kUsableShare = 0.9;
constexpr double kFarthestM = 1e3;
}  // namespace

double force_cap_n(const DeviceSpec& spec) { return std::min(kDefaultCapN, kUsableShare * spec.max_force_n); }

bool is_within_reach(const glm::dvec3& position_m) noexcept {
  // a NaN compares false
  return std::abs(position_m.x) <= kFarthestM && std::abs(position_m.y) <= kFarthestM &&
         std::abs(position_m.z) <= kFarthestM;
}

}  // namespace afm::haptics
