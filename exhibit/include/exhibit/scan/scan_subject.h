// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "curves/sample_model.h"
#include "exhibit/scan/live_scan.h"

namespace afm::exhibit {

class WallScene;

// The drawn sample of a material as a scan meets it: the surface that is felt (haptics::SampleSurface) before it is
// smoothed to the stiffness of a device, or a topography that was measured, which holds the usual tip already; the
// scanned square lies within its rim. `model` gives tip and adhesion.
// The result depends on nothing that must outlive it.
ScanSubject scan_subject(const WallScene& wall_scene, std::size_t material, const curves::SampleModel& model);

}  // namespace afm::exhibit
