// SPDX-License-Identifier: Apache-2.0
#include "physics/contact_point.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "contact_fit.h"

namespace afm::physics {

namespace {

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

// Sums over the bins in contact, for contact points that move outwards.
class Touching {
 public:
  explicit Touching(const ApproachProfile& profile) : profile_(profile), end_(profile.z.size()) {}

  struct Sums {
    double squares, with_force;  // sums of depth squared, and depth times force
  };
  Sums below(double contact) {
    const double deepest = profile_.z.back();
    for (; end_ > 0 && profile_.z[end_ - 1] < contact; --end_) {
      const double z = profile_.z[end_ - 1] - deepest, force = profile_.force[end_ - 1];
      count_ += 1.0;
      z_ += z;
      zz_ += z * z;
      force_ += force;
      zf_ += z * force;
    }
    const double way = contact - deepest;
    return {way * (count_ * way - 2.0 * z_) + zz_, way * force_ - zf_};
  }

 private:
  const ApproachProfile& profile_;
  std::size_t end_;
  double count_ = 0, z_ = 0, zz_ = 0, force_ = 0, zf_ = 0;
};

// The kink of zero and a straight line: an even grid, then a finer one around its best place.
double by_line(const ApproachProfile& profile) {
  constexpr int kPlaces = 256;
  double low = profile.z.back(), high = profile.z.front(), best = high;
  for (int pass = 0; pass < 2; ++pass) {
    const double step = (high - low) / kPlaces;
    double most = -1.0;
    Touching touching(profile);
    for (int i = 1; i < kPlaces; ++i) {
      const double contact = low + i * step;
      const auto [squares, with_force] = touching.below(contact);
      // reduction of the sum of squares
      const double taken = with_force > 0.0 && squares > 0.0 ? with_force * with_force / squares : 0.0;
      if (taken > most) {
        most = taken;
        best = contact;
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

// Sums over bins from the outermost one on, of which any window's sums are differences.
class RunningSums {
 public:
  explicit RunningSums(const ApproachProfile& profile) : sums_(profile.z.size() + 1) {
    // from the middle, so that the differences keep their digits
    const double middle = 0.5 * (profile.z.front() + profile.z.back()), level = profile.force.front();
    for (std::size_t i = 0; i < profile.z.size(); ++i) {
      const double z = profile.z[i] - middle, force = profile.force[i] - level;
      const Sums& before = sums_[i];
      sums_[i + 1] = {before.z + z, before.force + force, before.zz + z * z, before.zf + z * force};
    }
  }

  // Slope of the line that fits the bins `first` to `last` best, with inwards as its direction; 0 if they have one
  // height.
  double inward_slope(std::size_t first, std::size_t last) const {
    const Sums &end = sums_[last + 1], &begin = sums_[first];
    const double share = 1.0 / static_cast<double>(last - first + 1);
    const double z = end.z - begin.z, force = end.force - begin.force;
    const double zz = end.zz - begin.zz - share * z * z;
    return zz > 0.0 ? -(end.zf - begin.zf - share * z * force) / zz : 0.0;
  }

 private:
  struct Sums {
    double z = 0, force = 0, zz = 0, zf = 0;
  };
  std::vector<Sums> sums_;
};

// Slope over a fiftieth of the bins on either side.
std::optional<double> by_gradient(const ApproachProfile& profile) {
  const std::size_t count = profile.z.size(), reach = std::max<std::size_t>(2, count / 50);
  const RunningSums sums(profile);
  std::vector<double> slope(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    slope[i] = sums.inward_slope(i < reach ? 0 : i - reach, std::min(count - 1, i + reach));
  }
  auto i = static_cast<std::size_t>(std::max_element(slope.begin(), slope.end()) - slope.begin());
  const double small = 0.01 * slope[i];
  while (i > 0 && slope[i] > small) --i;
  if (i == 0) return std::nullopt;
  // at this place the window's inner end has just left the contact
  return profile.z[std::min(count - 1, i + reach)];
}

// Median without a branch: the greatest and the least of four are not the median of five.
double median_of(const std::array<double, 5>& five) {
  const auto [a, b, c, d, e] = five;
  const double inner_low = std::max(std::min(a, b), std::min(c, d)),
               inner_high = std::min(std::max(a, b), std::max(c, d));
  return std::max(std::min(inner_low, inner_high), std::min(std::max(inner_low, inner_high), e));
}

// Each force replaced by the median of itself and its two neighbours on either side.
std::vector<double> smoothed_forces(std::span<const CurvePoint> points) {
  std::vector<double> result;
  result.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<double, 5> window{};
    const std::size_t first = i < 2 ? 0 : i - 2, last = std::min(points.size(), i + 3);
    for (std::size_t k = first; k < last; ++k) window[k - first] = points[k].force.si;
    if (last - first == window.size()) {
      result.push_back(median_of(window));
      continue;
    }
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

}  // namespace

std::optional<double> contact_on(const ApproachProfile& profile, ContactMethod method) {
  if (profile.z.size() < kFewestFitBins) return std::nullopt;
  switch (method) {
    case ContactMethod::Deviation:
      return by_deviation(profile);
    case ContactMethod::FitLine:
      return by_line(profile);
    case ContactMethod::Farthest:
      return by_distance(profile);
    case ContactMethod::Gradient:
      return by_gradient(profile);
    case ContactMethod::FitPolynomial:
    case ContactMethod::ZeroForce:
      break;
  }
  return std::nullopt;
}

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
  } else if (method == ContactMethod::FitPolynomial) {
    const ApproachProfile profile = profile_of(approach, kMostFitBins);
    if (profile.z.size() >= kFewestFitBins) z = fit_contact(profile).contact;
  } else {
    z = contact_on(profile_of(approach), method);
  }
  return z ? std::optional(Length(*z)) : std::nullopt;
}

}  // namespace afm::physics
