// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/curve_map.h"
#include "curves/map_place.h"
#include "curves/sample_model.h"
#include "physics/law.h"
#include "scene/shared/felt_heights.h"

namespace afm::curves {

class ForceVolume;
struct FitOptions;

// A fitted force map as one sample that is felt whole: modulus and adhesion of the usable fits, those of all other
// pixels filled from the nearest of these, and the heights. Grids of square cells; a larger map is thinned.
struct FeltMap {
  physics::Law law = physics::Law::Dmt;  // law of force; Hertz: the tip hardly sticks
  double poisson = 0.5;                  // Poisson's ratio of the fits
  scene::SharedLawMap laws;
  scene::Topography heights;                    // heights of the sample, 0 at the middle
  MapGrid grid;                                 // grid of the pixels
  std::vector<bool> is_filled;                  // pixels without a usable fit, in the order of CurveMap::fits()
  std::size_t filled = 0;                       // number of pixels without a usable fit
  std::shared_ptr<const ForceVolume> volume{};  // curves of the map, for display; null: not kept
};

inline constexpr std::size_t kLeastFits = 4;
inline constexpr double kLeastShare = 0.25;  // smallest share of the pixels with a usable fit

// Fails with WrongUsage, and the reason, if no law of force has the numbers of such a fit, or if fewer than kLeastFits
// or kLeastShare of the pixels have a usable one. `options` are those of the map's fits.
core::Result<FeltMap> felt_map(const CurveMap& map, const FitOptions& options);

// The sample of a whole map, with its curves; lever and look are those of its pixel. Fails as haptics::LawFamily and
// haptics::Scaling, with a line that names the file.
core::Result<SampleModel> make_sample_model(const SampleModel& pixel, const FitOptions& options,
                                            std::shared_ptr<const ForceVolume> volume = nullptr);

// Pixel of the map below a tip at this place of the sample, metres as felt; empty beside the map.
std::optional<MapPlace> pixel_below(const SampleModel& model, const std::array<double, 2>& xy_m);

// Text for a log: "E 1.2 kPa to 9.8 kPa, W 0.1 mJ/m2 to 0.3 mJ/m2; 12 of 256 pixels are filled from their neighbours".
std::string felt_text(const FeltMap& map);

}  // namespace afm::curves
