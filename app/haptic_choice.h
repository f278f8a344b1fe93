// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "haptics/device_probe.h"

namespace afm::app {

// What the environment says of haptic drivers: TOUCHAFM_HD_LIBRARY and TOUCHAFM_HD_DEVICE.
haptics::ProbeSettings probe_settings();

}  // namespace afm::app
