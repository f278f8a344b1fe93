// SPDX-License-Identifier: Apache-2.0
#include "haptics/device.h"

#include <algorithm>

namespace afm::haptics {

namespace {
constexpr double kDefaultCapN = 2.0;
constexpr double kUsableShare = 0.9;
}  // namespace

double force_cap_n(const DeviceSpec& spec) { return std::min(kDefaultCapN, kUsableShare * spec.max_force_n); }

}  // namespace afm::haptics
