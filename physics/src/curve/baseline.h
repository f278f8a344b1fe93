// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "physics/curve_analysis.h"

namespace afm::physics {

// Share of a curve's largest force that is far above rounding.
inline constexpr double kRoundingShare = 1e-6;

// The baseline of an approach whose largest force is `greatest`. Without a chosen range it lies in the outermost part
// that stays on one line; for waves, up to nine tenths of the way to the contact. Throws std::invalid_argument if all
// points have the same height, or the range has too few of them.
Baseline fit_baseline(std::span<const CurvePoint> approach, Force greatest, const BaselineChoice& choice);

}  // namespace afm::physics
