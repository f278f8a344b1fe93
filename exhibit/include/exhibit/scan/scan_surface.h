// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "curves/contact_setup.h"
#include "physics/imaging/scanner.h"
#include "physics/imaging/tip_shape.h"

namespace afm::exhibit {

// A sample's surface for the scanner.
struct ScanSurface {
  physics::Scanner::Surface height_m;  // surface traced by the apex; level beyond the rim, as for the hand
  double width_m = 0;                  // width of the drawn piece, which is centred on the origin
  double depth_m = 0;
  double pull_off_force_n = 0;  // magnitude
  double snap_in_m = 0;         // gap at which a free tip snaps in
};

// The sample of a material under a tip. Under a paraboloid: the surface that a hand feels (haptics::SampleSurface of
// the drawn heights). Under any other tip: the drawn heights dilated by it. The scanner itself adds the tip's second
// apex.
core::Result<ScanSurface> scan_surface(const curves::ContactSetup& setup, const physics::TipShape& tip,
                                       const std::string& assets_dir);

}  // namespace afm::exhibit
