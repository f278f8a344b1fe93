// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exhibit/scan/live_scan.h"
#include "physics/imaging/scan_artefact.h"

namespace afm::exhibit {

// Artefact that explains the newest lines of a scan; see physics::main_artefact().
physics::ScanArtefact cause_of(const LiveScan& scan);

}  // namespace afm::exhibit
