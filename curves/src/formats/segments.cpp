// SPDX-License-Identifier: Apache-2.0
#include "formats/segments.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "curves/curve_error.h"

namespace afm::curves {

namespace {

using physics::CurvePoint;

// Share of the heights of a curve up to which the tip counts as resting.
constexpr double kRestShare = 0.1;

// Run of points with the same number.
struct Run {
  double number = 0;
  std::size_t first = 0, count = 0;
};

std::vector<Run> runs_of(std::span<const double> segments) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (runs.empty() || runs.back().number != segments[i]) runs.push_back({segments[i], i, 0});
    ++runs.back().count;
  }
  return runs;
}

std::pair<double, double> z_range_of(std::span<const CurvePoint> points) {
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  return {low->z.si, high->z.si};
}

double mean_z(std::span<const CurvePoint> points) {
  double sum = 0;
  for (const CurvePoint& point : points) sum += point.z.si;
  return sum / static_cast<double>(points.size());
}

// Mean height of the last tenth above that of the first, in shares of the points' range: -1 to 1.
double rise_of(std::span<const CurvePoint> points) {
  if (points.size() < 2) return 0.0;
  const auto [low, high] = z_range_of(points);
  if (!(high > low)) return 0.0;
  const std::size_t tenth = std::max<std::size_t>(1, points.size() / 10);
  return (mean_z(points.last(tenth)) - mean_z(points.first(tenth))) / (high - low);
}

// Forces at heights within `from` to `to`, in shares of the range from its lowest.
std::vector<double> forces_at(std::span<const CurvePoint> points, double from, double to) {
  const auto [low, high] = z_range_of(points);
  std::vector<double> forces;
  for (const CurvePoint& point : points) {
    const double share = (point.z.si - low) / (high - low);
    if (share >= from && share <= to) forces.push_back(point.force.si);
  }
  return forces;
}

// Median of at least one value; changes their order.
double median_in(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// End of the heights: difference of its force from that a fifth of them away, and the noise there.
struct HeightsEnd {
  double change_n = 0, noise_n = 0;
};

// Largest change in three widths of the end, because a contact may be a hundredth of a long approach.
std::optional<HeightsEnd> end_of_heights(std::span<const CurvePoint> points, bool highest) {
  constexpr double kOuter = 0.05, kInner = 0.2, kDeviationPerMedian = 1.4826;
  constexpr std::array kNarrower{0.02, 0.005};
  constexpr std::size_t kFewest = 3;
  const auto forces = [&](double from, double to) {
    return highest ? forces_at(points, 1.0 - to, 1.0 - from) : forces_at(points, from, to);
  };
  std::vector<double> inner = forces(kInner - kOuter, kInner), outer = forces(0.0, kOuter);
  if (inner.empty() || outer.empty()) return std::nullopt;
  const double level_n = median_in(inner);
  HeightsEnd end{std::abs(median_in(outer) - level_n), 0.0};
  for (const double width : kNarrower) {
    outer = forces(0.0, width);
    if (outer.size() >= kFewest) end.change_n = std::max(end.change_n, std::abs(median_in(outer) - level_n));
  }
  for (double& force_n : inner) force_n = std::abs(force_n - level_n);
  end.noise_n = kDeviationPerMedian * median_in(inner);
  return end;
}

enum class ContactEnd { Unknown, Lowest, Highest };

// End of the heights with the largest change of the force, if clear: that of the contact, for a force of either sign.
ContactEnd contact_end_of(std::span<const CurvePoint> points) {
  constexpr double kClearly = 3.0, kSignificant = 5.0;
  const auto lowest = end_of_heights(points, false), highest = end_of_heights(points, true);
  if (!lowest || !highest) return ContactEnd::Unknown;
  const double noise_n = std::max(lowest->noise_n, highest->noise_n);  // 0 where the signal is constant
  const auto is_clear = [&](const HeightsEnd& end, const HeightsEnd& other) {
    return end.change_n > kClearly * other.change_n && end.change_n > kSignificant * noise_n;
  };
  if (is_clear(*lowest, *highest)) return ContactEnd::Lowest;
  return is_clear(*highest, *lowest) ? ContactEnd::Highest : ContactEnd::Unknown;
}

void reverse_times(RecordedCurve& curve, std::size_t first, std::size_t count) {
  if (curve.time_s.empty()) return;
  const auto begin = curve.time_s.begin() + static_cast<std::ptrdiff_t>(first);
  std::reverse(begin, begin + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

void remark_left_out(std::size_t points, std::string_view when, std::string_view what_it_does,
                     std::optional<double> duration_s, CurveMetadata& metadata) {
  if (metadata.remarks.size() >= kMostRemarks) return;
  const std::string duration = duration_s ? fmt::format(" for {:g} s", *duration_s) : std::string();
  const std::string left_out = points == 1 ? "1 point there is" : fmt::format("{} points there are", points);
  metadata.remarks.push_back(fmt::format("{} the tip {}{}: {} left out", when, what_it_does, duration, left_out));
}

void assign_branches(std::span<const double> segments, RecordedCurve& curve) {
  const std::vector<Run> runs = runs_of(segments);
  const bool two = std::all_of(segments.begin(), segments.end(), [](double n) { return n == 0.0 || n == 1.0; });
  const bool in_order = std::adjacent_find(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
                          return a.number >= b.number;
                        }) == runs.end();
  if (!two && (!in_order || runs.size() < 2 || runs.front().number != 0.0)) {
    throw CurveError(
        fmt::format("segment is {}; known are 0 (approach) and 1 (retract), or more in their order",
                    *std::find_if(segments.begin(), segments.end(), [](double n) { return n != 0.0 && n != 1.0; })));
  }
  std::vector<CurvePoint> points;
  std::vector<double> times;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::span<const CurvePoint> here = std::span(curve.points).subspan(runs[i].first, runs[i].count);
    const bool between = !two && i > 0 && i + 1 < runs.size();
    if (between) {
      const auto [low, high] = z_range_of(curve.points);
      const double moved = std::abs(here.back().z.si - here.front().z.si);
      if (moved > kRestShare * (high - low)) {
        throw CurveError(
            fmt::format("the tip moves by {:.3g} nm in its segment {}, between approach and retract; only "
                        "curves of one approach and one retract are read",
                        moved * 1e9, runs[i].number));
      }
      remark_left_out(runs[i].count, kBetweenBranches, "rests", std::nullopt, curve.metadata);
      continue;
    }
    const bool retract = two ? runs[i].number == 1.0 : i > 0;
    for (std::size_t k = 0; k < here.size(); ++k) {
      points.push_back({here[k].z, here[k].force, retract ? physics::Branch::Retract : physics::Branch::Approach});
      if (!curve.time_s.empty()) times.push_back(curve.time_s[runs[i].first + k]);
    }
  }
  curve.points = std::move(points);
  curve.time_s = std::move(times);
}

void remark_index(std::size_t index, std::size_t count, CurveMetadata& metadata) {
  if (count > 1) metadata.remarks.push_back(fmt::format("it is curve {} of {}, counted from 0", index, count));
}

namespace {

void remark(const char* sentence, RecordedCurve& curve) {
  if (curve.metadata.remarks.size() < kMostRemarks) curve.metadata.remarks.emplace_back(sentence);
}

}  // namespace

void put_second_part_first(std::size_t first_count, RecordedCurve& curve) {
  const auto second = curve.points.begin() + static_cast<std::ptrdiff_t>(first_count);
  for (auto point = curve.points.begin(); point != second; ++point) point->branch = physics::Branch::Retract;
  for (auto point = second; point != curve.points.end(); ++point) point->branch = physics::Branch::Approach;
  std::rotate(curve.points.begin(), second, curve.points.end());
  curve.time_s.clear();
  remark("its first part leads away from the sample: it is taken as the retract, and the second as the approach",
         curve);
}

void set_directions(RecordedCurve& curve) {
  constexpr double kClearRise = 0.2;
  const auto turn = std::find_if(curve.points.begin(), curve.points.end(),
                                 [](const auto& point) { return point.branch == physics::Branch::Retract; });
  const auto count = static_cast<std::size_t>(turn - curve.points.begin());
  const std::span<CurvePoint> all(curve.points), approach = all.first(count), retract = all.subspan(count);
  if (count < 2 || std::abs(rise_of(approach)) < kClearRise) return;

  const ContactEnd contact = contact_end_of(approach);
  if (rise_of(approach) < 0.0) {
    if (contact == ContactEnd::Highest) {
      remark(
          "the force of the approach changes most at its far end: do its heights count the other way, or are approach "
          "and retract exchanged?",
          curve);
    }
  } else if (contact != ContactEnd::Lowest) {
    for (CurvePoint& point : curve.points) point.z = -point.z;
    remark("its heights rise while the tip approaches: they are counted the other way here", curve);
  } else if (rise_of(retract) < -kClearRise) {
    put_second_part_first(count, curve);
    return;
  } else {
    std::reverse(approach.begin(), approach.end());
    reverse_times(curve, 0, count);
    remark("the points of its approach lead away from the sample: they are taken in the reverse order", curve);
  }
  if (rise_of(retract) < -kClearRise) {
    std::reverse(retract.begin(), retract.end());
    reverse_times(curve, count, retract.size());
    remark("the points of its retract lead towards the sample: they are taken in the reverse order", curve);
  }
}

}  // namespace afm::curves
