// SPDX-License-Identifier: Apache-2.0
#include "curves/fitting/map_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "curves/fitting/fitted_curve.h"

namespace afm::curves {

CurveMap::Fit fit_of_each(const std::string& path, const FitOptions& options) {
  return [path, options](const RecordedCurve& curve) {
    const FittedCurve fitted = fitted_curve(path, curve, options);
    PixelFit pixel;
    pixel.adhesion_n = fitted.figures.adhesion_n.value_or(std::numeric_limits<double>::quiet_NaN());
    if (!fitted.fit) return pixel;
    pixel.trust = fitted.fit->trust;
    pixel.modulus_pa = fitted.fit->modulus_pa;
    if (fitted.fit->adhesion) pixel.adhesion_j_per_m2 = fitted.fit->adhesion->work_j_per_m2;
    return pixel;
  };
}

std::string fits_text(const CurveMap& map) {
  const auto count = [&](std::optional<fits::Trust> trust) {
    return std::count_if(map.fits().begin(), map.fits().end(), [&](const PixelFit& fit) { return fit.trust == trust; });
  };
  const auto pixels = static_cast<std::ptrdiff_t>(map.heights_m().size());
  const auto without_curve = pixels - static_cast<std::ptrdiff_t>(map.pixels_with_curve());
  return fmt::format("{} fits are trusted, {} doubtful, {} not trusted; {} curves have none",
                     count(fits::Trust::Trusted), count(fits::Trust::Doubtful), count(fits::Trust::No),
                     count(std::nullopt) - without_curve);
}

}  // namespace afm::curves
