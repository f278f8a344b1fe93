// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exhibit/scan/live_scan.h"

namespace afm::exhibit {

// What is wrong with an image, if anything.
enum class ScanCause { None, Blur, Overload, Parachuting, Ringing, Drift, DoubleTip, Noise, BluntTip };

// The cause that explains the newest lines of a scan: what happened to the tip first, then what its settings must do
// to the image. Where several apply, the one that hides the others.
ScanCause cause_of(const LiveScan& scan);

}  // namespace afm::exhibit
