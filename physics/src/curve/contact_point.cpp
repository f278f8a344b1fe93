// SPDX-License-Identifier: Apache-2.0
#include "physics/contact_point.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "curve_bins.h"

namespace afm::physics {

namespace {

constexpr std::size_t kProfileBins = 512;

// Bins from the outermost inwards, none deeper than the strongest push.
struct ApproachProfile {
  std::vector<double> z;
  std::vector<double> force;
};

ApproachProfile profile_of(std::span<const CurvePoint> approach) {
  const auto [low, high] =
      std::minmax_element(approach.begin(), approach.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  std::vector<CurveBin> bins = curve_bins(approach, low->z, high->z, kProfileBins, 1);
  const auto greatest =
      std::max_element(bins.begin(), bins.end(), [](const auto& a, const auto& b) { return a.mean < b.mean; });
  ApproachProfile profile;
  for (auto bin = bins.end(); bin != greatest;) {
    --bin;
    profile.z.push_back(bin->z.si);
    profile.force.push_back(bin->mean.si);
  }
  return profile;
}

// Place where the straight line between two bins crosses `level`.
double crossing(const ApproachProfile& profile, std::size_t outer, double level) {
  const double inner_force = profile.force[outer + 1], outer_force = profile.force[outer];
  const double share = inner_force > outer_force ? (inner_force - level) / (inner_force - outer_force) : 0.0;
  return profile.z[outer + 1] + share * (profile.z[outer] - profile.z[outer + 1]);
}

std::optional<double> by_deviation(const ApproachProfile& profile) {
  const std::size_t count = std::max<std::size_t>(2, profile.z.size() / 10);
  double mean = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < count; ++i) mean += profile.force[i] / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(profile.force[i] - mean));
  const double level = mean + 2.0 * largest;
  if (profile.force.back() <= level) return std::nullopt;
  std::size_t i = profile.z.size() - 1;
  while (i > 0 && profile.force[i - 1] > level) --i;
  if (i == 0) return std::nullopt;
  return crossing(profile, i - 1, level);
}

constexpr std::size_t kTerms = 3;
using Terms = std::array<double, kTerms>;

// Sums over the profile of the products of d, d^1.5 and d^2 with each other and with the force.
struct NormalEquations {
  std::array<Terms, kTerms> products{};
  Terms with_force{};
  double force_squared = 0.0;
};

NormalEquations normal_equations(const ApproachProfile& profile, double contact) {
  NormalEquations sums;
  const double depth = contact - profile.z.back();
  for (std::size_t i = 0; i < profile.z.size(); ++i) {
    const double force = profile.force[i], d = std::max(0.0, contact - profile.z[i]) / depth;
    const Terms terms{d, d * std::sqrt(d), d * d};
    sums.force_squared += force * force;
    for (std::size_t a = 0; a < kTerms; ++a) {
      sums.with_force[a] += force * terms[a];
      for (std::size_t b = 0; b < kTerms; ++b) sums.products[a][b] += terms[a] * terms[b];
    }
  }
  return sums;
}

// Reduction of the sum of squares by the chosen terms (a bit each); empty if a coefficient would be negative.
std::optional<double> taken_by(NormalEquations sums, unsigned chosen) {
  const Terms with_force = sums.with_force;
  const auto is_chosen = [&](std::size_t term) { return (chosen >> term & 1U) != 0; };
  // Gauss-Jordan; the matrix is positive definite apart from rounding
  for (std::size_t pivot = 0; pivot < kTerms; ++pivot) {
    if (!is_chosen(pivot)) continue;
    const double head = sums.products[pivot][pivot];
    if (head < 1e-12) return std::nullopt;
    for (std::size_t row = 0; row < kTerms; ++row) {
      if (row == pivot || !is_chosen(row)) continue;
      const double factor = sums.products[row][pivot] / head;
      for (std::size_t k = 0; k < kTerms; ++k) sums.products[row][k] -= factor * sums.products[pivot][k];
      sums.with_force[row] -= factor * sums.with_force[pivot];
    }
  }
  double taken = 0.0;
  for (std::size_t term = 0; term < kTerms; ++term) {
    if (!is_chosen(term)) continue;
    const double coefficient = sums.with_force[term] / sums.products[term][term];
    if (coefficient < 0.0) return std::nullopt;
    taken += coefficient * with_force[term];
  }
  return taken;
}

// Residual sum of squares of the best fit with this contact point, by a straight line or by all terms.
double rest_of_fit(const ApproachProfile& profile, double contact, bool curved) {
  const NormalEquations sums = normal_equations(profile, contact);
  double most = 0.0;
  for (unsigned chosen = 1; chosen < (curved ? 1U << kTerms : 2U); ++chosen) {
    most = std::max(most, taken_by(sums, chosen).value_or(0.0));
  }
  return sums.force_squared - most;
}

// Searches an even grid, then a finer one around its best place.
std::optional<double> by_fit(const ApproachProfile& profile, bool curved) {
  constexpr int kPlaces = 256;
  double low = profile.z.back(), high = profile.z.front(), best = high;
  for (int pass = 0; pass < 2; ++pass) {
    const double step = (high - low) / kPlaces;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 1; i < kPlaces; ++i) {
      const double rest = rest_of_fit(profile, low + i * step, curved);
      if (rest < least) {
        least = rest;
        best = low + i * step;
      }
    }
    low = std::max(profile.z.back(), best - step);
    high = std::min(profile.z.front(), best + step);
  }
  return best;
}

std::optional<double> by_distance(const ApproachProfile& profile) {
  const double way = profile.z.front() - profile.z.back();
  const double lowest = *std::min_element(profile.force.begin(), profile.force.end());
  const double rise = profile.force.back() - lowest;
  std::size_t farthest = 0;
  double least = 0.0;
  for (std::size_t i = 0; i < profile.z.size(); ++i) {
    const double below = (profile.force[i] - lowest) / rise - (profile.z.front() - profile.z[i]) / way;
    if (below < least) {
      least = below;
      farthest = i;
    }
  }
  if (farthest == 0) return std::nullopt;
  return profile.z[farthest];
}

// Slope over a fiftieth of the bins on either side.
std::optional<double> by_gradient(const ApproachProfile& profile) {
  const std::size_t count = profile.z.size(), reach = std::max<std::size_t>(2, count / 50);
  std::vector<double> slope(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = i < reach ? 0 : i - reach, last = std::min(count - 1, i + reach);
    double z = 0, force = 0, zz = 0, zf = 0;
    const auto inside = static_cast<double>(last - first + 1);
    for (std::size_t k = first; k <= last; ++k) {
      z += profile.z[k] / inside;
      force += profile.force[k] / inside;
    }
    for (std::size_t k = first; k <= last; ++k) {
      zz += (profile.z[k] - z) * (profile.z[k] - z);
      zf += (profile.z[k] - z) * (profile.force[k] - force);
    }
    if (zz > 0) slope[i] = -zf / zz;
  }
  auto i = static_cast<std::size_t>(std::max_element(slope.begin(), slope.end()) - slope.begin());
  const double small = 0.01 * slope[i];
  while (i > 0 && slope[i] > small) --i;
  if (i == 0) return std::nullopt;
  // at this place the window's inner end has just left the contact
  return profile.z[std::min(count - 1, i + reach)];
}

// Each force replaced by the median of itself and its two neighbours on either side.
std::vector<double> smoothed_forces(std::span<const CurvePoint> points) {
  std::vector<double> result;
  result.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<double, 5> window{};
    const std::size_t first = i < 2 ? 0 : i - 2, last = std::min(points.size(), i + 3);
    for (std::size_t k = first; k < last; ++k) window[k - first] = points[k].force.si;
    const auto end = window.begin() + static_cast<std::ptrdiff_t>(last - first);
    const auto middle = window.begin() + static_cast<std::ptrdiff_t>((last - first) / 2);
    std::nth_element(window.begin(), middle, end);
    // at the ends, a median of an even number would shift the curve by half a sample
    result.push_back((last - first) % 2 == 1 ? *middle : points[i].force.si);
  }
  return result;
}

std::optional<double> by_zero_force(std::span<const CurvePoint> approach) {
  const std::vector<double> force = smoothed_forces(approach);
  for (auto i = static_cast<std::size_t>(std::max_element(force.begin(), force.end()) - force.begin()); i > 0; --i) {
    const double inner = force[i], outer = force[i - 1];
    if (inner > 0.0 && outer <= 0.0) {
      return (approach[i].z + inner / (inner - outer) * (approach[i - 1].z - approach[i].z)).si;
    }
  }
  return std::nullopt;
}

std::optional<double> on_profile(const ApproachProfile& profile, ContactMethod method) {
  switch (method) {
    case ContactMethod::Deviation:
      return by_deviation(profile);
    case ContactMethod::FitLine:
      return by_fit(profile, false);
    case ContactMethod::FitPolynomial:
      return by_fit(profile, true);
    case ContactMethod::Farthest:
      return by_distance(profile);
    case ContactMethod::Gradient:
      return by_gradient(profile);
    case ContactMethod::ZeroForce:
      break;
  }
  return std::nullopt;
}

}  // namespace

std::string_view name_of(ContactMethod method) {
  return std::find_if(kContactMethods.begin(), kContactMethods.end(),
                      [&](const auto& each) { return each.method == method; })
      ->name;
}

std::optional<Length> contact_point(std::span<const CurvePoint> approach, ContactMethod method) {
  if (approach.empty()) return std::nullopt;
  std::optional<double> z;
  if (method == ContactMethod::ZeroForce) {
    z = by_zero_force(approach);
  } else if (const ApproachProfile profile = profile_of(approach); profile.z.size() >= 5) {
    z = on_profile(profile, method);
  }
  return z ? std::optional(Length(*z)) : std::nullopt;
}

}  // namespace afm::physics
