// SPDX-License-Identifier: Apache-2.0
#include "baseline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "curve_bins.h"

namespace afm::physics {

namespace {

// Like std::nth_element, but without a branch for each value, which a processor mispredicts for half of the noise.
void put_in_place(std::vector<double>& values, std::size_t place) {
  constexpr std::size_t kFew = 12;
  constexpr int kMostRounds = 40;  // number of rounds before nth_element takes over: values may be arranged against it
  double* const all = values.data();
  std::size_t low = 0, high = values.size();
  // values that satisfy `holds` move to the front
  const auto part = [&](std::size_t from, const auto& holds) {
    std::size_t end = from;
    for (std::size_t i = from; i < high; ++i) {
      const double value = all[i];
      all[i] = all[end];
      all[end] = value;
      end += holds(value) ? 1U : 0U;
    }
    return end;
  };
  for (int round = 0; round < kMostRounds && high - low > kFew; ++round) {
    const double first = all[low], middle = all[low + (high - low) / 2], last = all[high - 1];
    const double pivot = std::max(std::min(first, middle), std::min(std::max(first, middle), last));
    const std::size_t less = part(low, [pivot](double value) { return value < pivot; });
    if (place < less) {
      high = less;
      continue;
    }
    low = part(less, [pivot](double value) { return value == pivot; });
    if (place < low) return;
  }
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(low), at(place), at(high));
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  put_in_place(values, values.size() / 2);
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

struct Stretch {
  std::span<const CurvePoint> points;  // points with falling Z
  Length z_far;
};

// Median of the heights.
Length middle_z(std::span<const CurvePoint> falling) {
  const std::size_t middle = falling.size() / 2;
  if (falling.size() % 2 == 1) return falling[middle].z;
  return 0.5 * (falling[middle].z + falling[middle - 1].z);
}

std::vector<double> residuals_of(std::span<const CurvePoint> points, const Baseline& line) {
  std::vector<double> residuals(points.size());
  std::transform(points.begin(), points.end(), residuals.begin(),
                 [line](const CurvePoint& point) { return (point.force - line.at(point.z)).si; });
  return residuals;
}

// Level and noise of a baseline whose other parts are known: median and median absolute deviation of what is left.
void level_on(const Stretch& stretch, Baseline& line) {
  line.level = Force();
  std::vector<double> residuals = residuals_of(stretch.points, line);
  line.level = Force(median(residuals));  // reorders the residuals
  for (double& residual : residuals) residual = std::abs(residual - line.level.si);
  constexpr double kNormal = 1.4826;  // standard deviation of a normal distribution over the median of its magnitudes
  line.noise = Force(kNormal * median(residuals));
}

// The line through the medians of up to 32 groups of neighbours, with the median of the slopes of all their pairs as
// slope (Theil 1950, Sen 1968): tolerates half of the points as outliers.
Baseline line_through(const Stretch& stretch, bool flat) {
  Baseline line{stretch.z_far, {}, {}, {}};
  if (!flat) {
    constexpr std::size_t kGroups = 32;
    const std::size_t count = stretch.points.size();
    const std::size_t groups = std::min(kGroups, count);
    std::array<double, kGroups> z_of{}, force_of{};
    std::vector<double> slopes(groups * groups / 2), force;
    for (std::size_t g = 0; g < groups; ++g) {
      const std::span<const CurvePoint> group =
          stretch.points.subspan(g * count / groups, (g + 1) * count / groups - g * count / groups);
      force.resize(group.size());
      std::transform(group.begin(), group.end(), force.begin(), [](const CurvePoint& point) { return point.force.si; });
      z_of[g] = (middle_z(group) - stretch.z_far).si;
      force_of[g] = median(force);
    }
    std::size_t pairs = 0;
    for (std::size_t a = 0; a < groups; ++a) {
      for (std::size_t b = a + 1; b < groups; ++b) {
        slopes[pairs] = (force_of[a] - force_of[b]) / (z_of[a] - z_of[b]);
        pairs += z_of[a] != z_of[b] ? 1U : 0U;
      }
    }
    slopes.resize(pairs);
    line.tilt = Stiffness(slopes.empty() ? 0.0 : median(slopes));
  }
  level_on(stretch, line);
  return line;
}

// Least squares of level, tilt, sine and cosine at one period.
struct WaveFit {
  std::array<double, 4> terms{};  // coefficients: level, tilt over the stretch's length, sine, cosine
  double residual = 0.0;          // sum of squared residuals
};

// Solves the symmetric 4 x 4 system by elimination with pivots; a singular one gives zeros.
std::array<double, 4> solved(std::array<std::array<double, 5>, 4> rows) {
  for (std::size_t column = 0; column < 4; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < 4; ++row) {
      if (std::abs(rows[row][column]) > std::abs(rows[pivot][column])) pivot = row;
    }
    std::swap(rows[column], rows[pivot]);
    if (std::abs(rows[column][column]) < 1e-12 * static_cast<double>(rows.size())) return {};
    for (std::size_t row = 0; row < 4; ++row) {
      if (row == column) continue;
      const double factor = rows[row][column] / rows[column][column];
      for (std::size_t i = column; i < 5; ++i) rows[row][i] -= factor * rows[column][i];
    }
  }
  return {rows[0][4] / rows[0][0], rows[1][4] / rows[1][1], rows[2][4] / rows[2][2], rows[3][4] / rows[3][3]};
}

// Bins of the stretch; `way` in lengths of the stretch.
struct Profile {
  std::vector<double> way, force;
  Length length;
};

WaveFit fit_at(const Profile& profile, double periods) {
  std::array<std::array<double, 5>, 4> sums{};
  const auto row_at = [&](std::size_t i) {
    const double phase = 2.0 * std::numbers::pi * periods * profile.way[i];
    return std::array{1.0, profile.way[i], std::sin(phase), std::cos(phase), profile.force[i]};
  };
  for (std::size_t i = 0; i < profile.way.size(); ++i) {
    const auto row = row_at(i);
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 5; ++b) sums[a][b] += row[a] * row[b] / static_cast<double>(profile.way.size());
    }
  }
  WaveFit fit{solved(sums), 0.0};
  for (std::size_t i = 0; i < profile.way.size(); ++i) {
    const auto row = row_at(i);
    double left = row[4];
    for (std::size_t a = 0; a < 4; ++a) left -= fit.terms[a] * row[a];
    fit.residual += left * left;
  }
  return fit;
}

constexpr double kFewestPeriods = 1.0, kMostPeriods = 60.0;  // limits of the number of periods in the stretch
constexpr std::size_t kWaveBins = 512;

// Number of periods in the stretch at which a wave leaves least, refined to a thousandth of the grid's step.
double best_periods(const Profile& profile) {
  constexpr double kStep = 0.125;
  double best = kFewestPeriods, least = fit_at(profile, best).residual;
  for (double periods = kFewestPeriods + kStep; periods <= kMostPeriods; periods += kStep) {
    if (const double residual = fit_at(profile, periods).residual; residual < least) {
      least = residual;
      best = periods;
    }
  }
  double low = std::max(kFewestPeriods, best - kStep), high = best + kStep;
  while (high - low > 1e-3 * kStep) {
    const double third = (high - low) / 3.0;
    if (fit_at(profile, low + third).residual < fit_at(profile, high - third).residual) {
      high -= third;
    } else {
      low += third;
    }
  }
  return 0.5 * (low + high);
}

// The line with the wave that explains most, or the line alone where none explains a quarter of what it leaves.
Baseline with_waves(const Stretch& stretch) {
  constexpr double kLeastExplained = 0.25;
  const Baseline line = line_through(stretch, false);
  const Length near = stretch.points.back().z;
  Profile profile{{}, {}, stretch.points.front().z - near};
  if (profile.length.si <= 0.0) return line;
  double without = 0.0;
  for (const MeanBin& bin : mean_bins(stretch.points, near, stretch.points.front().z, kWaveBins)) {
    profile.way.push_back((bin.z - stretch.z_far) / profile.length);
    profile.force.push_back(bin.mean.si);
    without += std::pow((bin.mean - line.at(bin.z)).si, 2.0);
  }
  const double periods = best_periods(profile);
  const WaveFit fit = fit_at(profile, periods);
  if (!(fit.residual < (1.0 - kLeastExplained) * without)) return line;
  Baseline wavy{stretch.z_far,
                {},
                Stiffness(fit.terms[1] / profile.length.si),
                {},
                {(1.0 / periods) * profile.length, Force(fit.terms[2]), Force(fit.terms[3])}};
  level_on(stretch, wavy);
  return wavy;
}

// The approach sorted from the outermost point inwards.
class Falling {
 public:
  explicit Falling(std::span<const CurvePoint> approach) : points_(approach.begin(), approach.end()) {
    const auto is_higher = [](const auto& a, const auto& b) { return a.z > b.z; };
    if (!std::is_sorted(points_.begin(), points_.end(), is_higher)) {
      std::stable_sort(points_.begin(), points_.end(), is_higher);
    }
    if (way().si <= 0.0) throw std::invalid_argument("all points of the curve's approach have the same height");
  }

  Length z_far() const { return points_.front().z; }
  Length way() const { return points_.front().z - points_.back().z; }
  std::span<const CurvePoint> first(std::size_t count) const { return std::span(points_).first(count); }
  std::span<const CurvePoint> between(std::size_t from, std::size_t to) const {
    return std::span(points_).subspan(from, to - from);
  }
  // Points out to this way from the outermost one.
  std::size_t count_until(Length way) const {
    const auto end = std::partition_point(points_.begin(), points_.end(),
                                          [&](const auto& point) { return point.z >= z_far() - way; });
    return static_cast<std::size_t>(end - points_.begin());
  }

 private:
  std::vector<CurvePoint> points_;
};

// Fits the outermost fifth of the way, then more and more of it as long as the next twentieth stays on the line.
Baseline found_line(const Falling& approach, Force greatest, bool flat) {
  const auto count_until = [&](double share) {
    return std::max(kFewestBaselinePoints, approach.count_until(share * approach.way()));
  };
  std::size_t count = count_until(0.2);
  Baseline line = line_through({approach.first(count), approach.z_far()}, flat);
  for (double share = 0.25; share < 0.95; share += 0.05) {
    const std::size_t next = count_until(share);
    if (next <= count) continue;
    std::vector<double> residuals = residuals_of(approach.between(count, next), line);
    if (std::abs(median(residuals)) > std::max(1.5 * line.noise.si, kRoundingShare * greatest.si)) break;
    count = next;
    line = line_through({approach.first(count), approach.z_far()}, flat);
  }
  return line;
}

Stretch chosen_stretch(const Falling& approach, const WayRange& range) {
  const std::size_t from = approach.count_until(range.from), to = approach.count_until(range.to);
  // the outermost point belongs to a range that begins there
  const std::size_t first = range.from.si <= 0.0 ? 0 : from;
  if (to < first + kFewestBaselinePoints) {
    throw std::invalid_argument("the range of the baseline has " + std::to_string(to > first ? to - first : 0) +
                                " points of the approach; it needs at least " + std::to_string(kFewestBaselinePoints));
  }
  return {approach.between(first, to), approach.z_far()};
}

// Outside the contact by the straight baseline, less a tenth: a wave resembles the beginning of a contact.
Stretch outside_contact(std::span<const CurvePoint> recorded, const Falling& approach, const Baseline& line) {
  constexpr double kKept = 0.9;
  std::vector<CurvePoint> above(recorded.begin(), recorded.end());
  for (CurvePoint& point : above) point.force = point.force - line.at(point.z);
  const auto contact = contact_point(above, ContactMethod::FitPolynomial);
  const Length way = contact ? approach.z_far() - *contact : approach.way();
  const std::size_t count = std::max(kFewestBaselinePoints, approach.count_until(kKept * way));
  return {approach.first(count), approach.z_far()};
}

}  // namespace

Baseline fit_baseline(std::span<const CurvePoint> approach, Force greatest, const BaselineChoice& choice) {
  const Falling falling(approach);
  const bool flat = choice.shape == BaselineShape::Flat, waves = choice.shape == BaselineShape::Waves;
  if (choice.range) {
    const Stretch stretch = chosen_stretch(falling, *choice.range);
    return waves ? with_waves(stretch) : line_through(stretch, flat);
  }
  const Baseline line = found_line(falling, greatest, flat);
  return waves ? with_waves(outside_contact(approach, falling, line)) : line;
}

}  // namespace afm::physics
