// SPDX-License-Identifier: Apache-2.0
#include "physics/curve_analysis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace afm::physics {

namespace {

// A feature stands out of the noise from five standard deviations on; without noise, from a millionth of the curve's
// greatest force on, where rounding is far away.
constexpr double kSignificant = 5.0;
constexpr double kRoundingShare = 1e-6;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

struct Stretch {
  std::span<const CurvePoint> points;  // falling Z
  Length z_far;
};

// The line through the medians of up to 32 groups of neighbours, its slope the median of the slopes of all their pairs
// (Theil 1950, Sen 1968): half of the points may be wrong.
Baseline line_through(const Stretch& stretch) {
  constexpr std::size_t kGroups = 32;
  const std::size_t count = stretch.points.size();
  const std::size_t groups = std::min(kGroups, count);
  std::vector<double> z_of, force_of, slopes;
  for (std::size_t g = 0; g < groups; ++g) {
    std::vector<double> z, force;
    for (std::size_t i = g * count / groups; i < (g + 1) * count / groups; ++i) {
      z.push_back((stretch.points[i].z - stretch.z_far).si);
      force.push_back(stretch.points[i].force.si);
    }
    z_of.push_back(median(z));
    force_of.push_back(median(force));
  }
  for (std::size_t a = 0; a < groups; ++a) {
    for (std::size_t b = a + 1; b < groups; ++b) {
      if (z_of[a] != z_of[b]) slopes.push_back((force_of[a] - force_of[b]) / (z_of[a] - z_of[b]));
    }
  }
  Baseline line{stretch.z_far, {}, Stiffness(slopes.empty() ? 0.0 : median(slopes)), {}};
  std::vector<double> residuals;
  for (const CurvePoint& point : stretch.points) residuals.push_back((point.force - line.at(point.z)).si);
  line.level = Force(median(residuals));
  for (double& residual : residuals) residual = std::abs(residual - line.level.si);
  line.noise = Force(1.4826 * median(residuals));  // of a normal distribution
  return line;
}

// Fitted to the outermost fifth of the way, then to ever more of it as long as the next twentieth stays on the line.
Baseline fit_baseline(std::span<const CurvePoint> approach, Force greatest) {
  std::vector<CurvePoint> falling(approach.begin(), approach.end());
  std::stable_sort(falling.begin(), falling.end(), [](const auto& a, const auto& b) { return a.z > b.z; });
  const Length z_far = falling.front().z, way = z_far - falling.back().z;
  if (way.si <= 0.0) throw std::invalid_argument("all points of the curve's approach have the same height");

  const auto count_until = [&](double share) {
    const auto end = std::partition_point(falling.begin(), falling.end(),
                                          [&](const auto& point) { return point.z >= z_far - share * way; });
    return std::max<std::size_t>(5, static_cast<std::size_t>(end - falling.begin()));
  };
  const std::span<const CurvePoint> all(falling);
  std::size_t count = count_until(0.2);
  Baseline line = line_through({all.first(count), z_far});
  for (double share = 0.25; share < 0.95; share += 0.05) {
    const std::size_t next = count_until(share);
    if (next <= count) continue;
    std::vector<double> residuals;
    for (const CurvePoint& point : all.subspan(count, next - count)) {
      residuals.push_back((point.force - line.at(point.z)).si);
    }
    if (std::abs(median(residuals)) > std::max(1.5 * line.noise.si, kRoundingShare * greatest.si)) break;
    count = next;
    line = line_through({all.first(count), z_far});
  }
  return line;
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
    // at the ends a median of an even number would shift the curve by half a sample
    result.push_back((last - first) % 2 == 1 ? *middle : points[i].force.si);
  }
  return result;
}

struct Zero {
  std::size_t outside;  // index of the first point outwards that is not pushed
  Length z;
};

// From the greatest push towards the front of `approach`.
std::optional<Zero> first_zero(std::span<const CurvePoint> approach, Force threshold) {
  const std::vector<double> force = smoothed_forces(approach);
  const auto deepest = static_cast<std::size_t>(std::max_element(force.begin(), force.end()) - force.begin());
  if (force[deepest] <= threshold.si) return std::nullopt;
  for (std::size_t i = deepest; i > 0; --i) {
    const double inner = force[i], outer = force[i - 1];
    if (outer <= 0.0) {
      return Zero{i - 1, approach[i].z + inner / (inner - outer) * (approach[i - 1].z - approach[i].z)};
    }
  }
  return std::nullopt;
}

// Among the points before contact.
std::optional<CurveJump> find_snap_in(std::span<const CurvePoint> before_contact, Force threshold) {
  if (before_contact.size() < 2) return std::nullopt;
  const auto lowest =
      static_cast<std::size_t>(std::min_element(before_contact.begin(), before_contact.end(),
                                                [](const auto& a, const auto& b) { return a.force < b.force; }) -
                               before_contact.begin());
  const Force pull = -before_contact[lowest].force;
  if (pull <= threshold) return std::nullopt;

  const auto fall = [&](std::size_t i) { return before_contact[i].force - before_contact[i + 1].force; };
  std::size_t start = 0;
  for (std::size_t i = 0; i < lowest; ++i) {
    if (fall(i) > fall(start)) start = i;
  }
  if (lowest == 0 || fall(start) <= threshold || fall(start) < 0.25 * pull) return std::nullopt;

  // a jump may be spread over several samples of a filtered signal
  const Force steep = 0.25 * fall(start);
  while (start > 0 && fall(start - 1) > steep) --start;
  return CurveJump{before_contact[start].z, before_contact[start].force, -pull};
}

// -integral of F dZ along the points, over Z below `top`.
Energy work_below(std::span<const CurvePoint> points, Length top) {
  Energy work;
  for (std::size_t i = 1; i < points.size(); ++i) {
    CurvePoint a = points[i - 1], b = points[i];
    if (a.z >= top && b.z >= top) continue;
    const auto at_top = [&] { return a.force + (top - a.z) / (b.z - a.z) * (b.force - a.force); };
    if (a.z > top) {
      a = {top, at_top(), a.branch};
    } else if (b.z > top) {
      b = {top, at_top(), b.branch};
    }
    work = work - 0.5 * (a.force + b.force) * (b.z - a.z);
  }
  return work;
}

// From where the retract's force falls through zero to where, past the hardest pull, nothing significant is left.
Energy work_of_separation(std::span<const CurvePoint> retract, std::size_t hardest, Force threshold) {
  std::size_t first = hardest, last = hardest;
  while (first > 0 && retract[first - 1].force.si < 0.0) --first;
  while (last + 1 < retract.size() && retract[last].force < -threshold) ++last;
  return work_below(retract.subspan(first, last - first + 1), Length(HUGE_VAL));
}

std::optional<Stiffness> slope_of_upper_half(std::span<const CurvePoint> approach, Force greatest_push) {
  double count = 0, mean_z = 0, mean_force = 0;
  const auto upper = [&](const CurvePoint& point) { return point.force >= 0.5 * greatest_push; };
  for (const CurvePoint& point : approach) {
    if (!upper(point)) continue;
    count += 1;
    mean_z += (point.z.si - mean_z) / count;
    mean_force += (point.force.si - mean_force) / count;
  }
  double zz = 0, zf = 0;
  for (const CurvePoint& point : approach) {
    if (!upper(point)) continue;
    zz += (point.z.si - mean_z) * (point.z.si - mean_z);
    zf += (point.z.si - mean_z) * (point.force.si - mean_force);
  }
  if (count < 3 || zz <= 0.0) return std::nullopt;
  return Stiffness(-zf / zz);
}

void analyse_retract(std::span<const CurvePoint> cycle, std::size_t approach_count, Force threshold,
                     CurveFeatures& features) {
  const auto approach = cycle.first(approach_count), retract = cycle.subspan(approach_count);
  if (retract.empty()) return;
  const auto by_z = [](const auto& a, const auto& b) { return a.z < b.z; };
  features.loop_energy = work_below(cycle, std::min(std::max_element(approach.begin(), approach.end(), by_z)->z,
                                                    std::max_element(retract.begin(), retract.end(), by_z)->z));
  const auto lowest =
      std::min_element(retract.begin(), retract.end(), [](const auto& a, const auto& b) { return a.force < b.force; });
  if (-lowest->force <= threshold) return;
  features.pull_off = Extreme{lowest->z, lowest->force};
  features.adhesion_energy = work_of_separation(retract, static_cast<std::size_t>(lowest - retract.begin()), threshold);
}

}  // namespace

CurveSummary summarise(std::span<const CurveSample> samples) {
  CurveSummary summary;
  const CurveSample* previous = nullptr;
  for (const CurveSample& sample : samples) {
    Extreme& extreme = sample.branch == Branch::Approach ? summary.approach : summary.retract;
    if (sample.force < extreme.force) extreme = {sample.z, sample.force};
    if (previous != nullptr) {
      summary.loop_energy = summary.loop_energy - 0.5 * (sample.force + previous->force) * (sample.z - previous->z);
    }
    previous = &sample;
  }
  return summary;
}

std::vector<CurvePoint> points_of(std::span<const CurveSample> samples) {
  std::vector<CurvePoint> points;
  points.reserve(samples.size());
  for (const CurveSample& sample : samples) points.push_back({sample.z, sample.force, sample.branch});
  return points;
}

CurveFeatures analyse(std::span<const CurvePoint> points, ForceZero zero_of_force) {
  std::vector<CurvePoint> cycle(points.begin(), points.end());
  const auto turn = std::stable_partition(cycle.begin(), cycle.end(),
                                          [](const CurvePoint& point) { return point.branch == Branch::Approach; });
  const auto approach_count = static_cast<std::size_t>(turn - cycle.begin());
  if (approach_count < kFewestApproachPoints) {
    throw std::invalid_argument("the curve's approach has " + std::to_string(approach_count) +
                                " points; an analysis needs at least " + std::to_string(kFewestApproachPoints));
  }
  Force greatest;
  for (const CurvePoint& point : cycle) {
    if (!isfinite(point.z) || !isfinite(point.force)) throw std::invalid_argument("a point of the curve is not finite");
    greatest = std::max(greatest, abs(point.force));
  }

  CurveFeatures features;
  const std::span<CurvePoint> approach(cycle.data(), approach_count);
  features.baseline = fit_baseline(approach, greatest);
  if (zero_of_force == ForceZero::True) {
    features.baseline.level = Force();
    features.baseline.tilt = Stiffness();
  }
  for (CurvePoint& point : cycle) {
    point.force = point.force - features.baseline.at(point.z);
    if (point.branch == Branch::Approach) features.greatest_push = std::max(features.greatest_push, point.force);
  }
  const Force threshold = std::max(kSignificant * features.baseline.noise, kRoundingShare * greatest);

  const auto zero = first_zero(approach, threshold);
  if (zero) {
    features.contact_point = zero->z;
    features.contact_slope = slope_of_upper_half(approach, features.greatest_push);
  }
  features.snap_in = find_snap_in(approach.first(zero ? zero->outside + 1 : approach.size()), threshold);
  analyse_retract(cycle, approach_count, threshold, features);
  return features;
}

}  // namespace afm::physics
