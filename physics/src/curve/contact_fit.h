// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "physics/contact_point.h"
#include "physics/curve_point.h"

namespace afm::physics {

// Means of the bins of an approach along Z, from the outermost inwards, none deeper than the strongest push.
struct ApproachProfile {
  std::vector<double> z;      // mean heights, metres, descending
  std::vector<double> force;  // mean forces, newtons
};

// Profile in bins of equal width, some of which may be empty.
ApproachProfile profile_of(std::span<const CurvePoint> approach, std::size_t most_bins = 512);

// The contact point of a fit, and the places whose fits are not significantly worse.
struct ContactFit {
  double contact = 0.0;
  double low = 0.0, high = 0.0;
  bool lacks_baseline = false;
  bool doubtful = false;
};

// Contact point by a method that needs only the profile: not ZeroForce, not FitPolynomial. Empty if it finds none.
std::optional<double> contact_on(const ApproachProfile& profile, ContactMethod method);

inline constexpr std::size_t kFewestFitBins = 5;
inline constexpr std::size_t kMostFitBins = 256;

// Least squares of a straight line, which is the rest of a baseline, and from the contact point on an elastic contact
// under a lever: in the depth d of the lever's base below the contact point, d = a F^(1/p) + F/k, with p = 3/2 for a
// sphere (Hertz 1882) or 2 for a cone (Sneddon 1965), and any a, k >= 0.
//
// - low, high: the places where the sum of squares is at most (1 + 9/n) times the least, three standard deviations, n
//   the number of independent residuals by the runs of their signs: a wave has few. Half a bin is added.
// - lacks_baseline: less than 0.18 of the way is outside the contact.
// - doubtful: so it does, or these places are apart by more than 0.17 of the pushed depth and three bins.
//
// For a profile of kFewestFitBins to kMostFitBins with a push. Takes some 0.1 ms.
ContactFit fit_contact(const ApproachProfile& profile);

}  // namespace afm::physics
