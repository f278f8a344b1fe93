// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exhibit/models/relief.h"
#include "exhibit/scan/live_scan.h"

namespace afm::exhibit {

// The image so far, laid on the sample: the heights of the trace in the colours of its panel.
HeightRelief relief_of(const LiveScan& scan);

// The whole sample as drawn, on the square that a scan would cover.
HeightRelief relief_of(const ScanSubject& subject);

}  // namespace afm::exhibit
