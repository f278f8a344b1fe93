// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "curves/contact_setup.h"
#include "curves/measured_topography.h"
#include "physics/imaging/scanner.h"
#include "physics/imaging/tip_shape.h"

namespace afm::imaging {

// A sample's surface for the scanner.
struct ScanSurface {
  physics::Scanner::Surface height_m;  // surface traced by the apex; level beyond the rim, as for the hand
  double width_m = 0;                  // width of the drawn sample, which is centred on the origin
  double depth_m = 0;
  double pull_off_force_n = 0;  // pull-off force, a magnitude
  double snap_in_m = 0;         // gap at which a free tip snaps in
};

// Name of the included sample of two calibration gratings.
inline constexpr const char* kGratings = "gratings";

// A sample in place of the drawn one: a glTF model with the role "surface", an image, or the included one.
struct OwnSample {
  std::string file;  // name of the file, or kGratings; empty: the drawn sample
  curves::TopographyReading reading;
  bool is_traced = true;  // true: an image's heights are those of an apex, as for the hand; false: those of the sample
};

// The sample of a material under a tip. Under a paraboloid: the surface that a hand feels (haptics::SampleSurface of
// the drawn heights). Under any other tip: the drawn heights dilated by it. An image that is traced is taken as it was
// measured, under any tip; the gratings are dilated by every tip. The scanner itself adds the tip's second apex. Fails
// as load_own_sample() does.
core::Result<ScanSurface> scan_surface(const curves::ContactSetup& setup, const physics::TipShape& tip,
                                       const std::string& assets_dir, const OwnSample& own = {});

}  // namespace afm::imaging
