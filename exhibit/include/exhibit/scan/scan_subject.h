// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "curves/sample_model.h"
#include "exhibit/scan/live_scan.h"

namespace afm::exhibit {

class WallScene;

// The drawn sample of a material for a scan: the surface that is felt (haptics::SampleSurface) before its smoothing for
// the device's stiffness, or a measured topography, which already includes its tip. The scanned square is within its
// rim. `model` supplies tip and adhesion. The result refers to none of the arguments.
ScanSubject scan_subject(const WallScene& wall_scene, std::size_t material, const curves::SampleModel& model);

}  // namespace afm::exhibit
