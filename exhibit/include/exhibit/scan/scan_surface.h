// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "curves/contact_setup.h"
#include "physics/imaging/scanner.h"
#include "physics/imaging/tip_shape.h"

namespace afm::exhibit {

// A sample as the scanner meets it.
struct ScanSurface {
  physics::Scanner::Surface height_m;  // what the apex traces; level beyond the rim, as it is felt
  double width_m = 0;                  // of the drawn piece, which is centred on the origin
  double depth_m = 0;
  double pull_off_force_n = 0;  // magnitude
  double snap_in_m = 0;         // gap at which a free tip jumps into contact
};

// The sample of a material under a tip: under a paraboloid what a hand feels (haptics::SampleSurface of the drawn
// heights), under any other tip the drawn heights dilated by it. The tip's second apex is left to the scanner.
core::Result<ScanSurface> scan_surface(const curves::ContactSetup& setup, const physics::TipShape& tip,
                                       const std::string& assets_dir);

}  // namespace afm::exhibit
