// SPDX-License-Identifier: Apache-2.0
#include "physics/measured_branches.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curve/curve_bins.h"

namespace afm::physics {

namespace {

// Average number of samples per bin, which reduces the felt noise.
constexpr std::size_t kSamplesABin = 4;
// Distance between both ends of a jump, too small to contain a sample or to be felt.
constexpr double kJumpShareOfBin = 1e-3;
constexpr double kPullOffShareOfBin = 0.25;

// The points of one branch above its baseline, Z from the contact point.
std::vector<CurvePoint> centred(std::span<const CurvePoint> points, Branch branch, const CurveFeatures& features) {
  std::vector<CurvePoint> result;
  for (const CurvePoint& point : points) {
    if (point.branch != branch) continue;
    result.push_back({point.z - *features.contact_point, point.force - features.baseline.at(point.z), branch});
  }
  return result;
}

std::vector<MeasuredPoint> smoothed(std::span<const CurvePoint> points, Length bottom, Length top,
                                    std::size_t most_points) {
  std::vector<MeasuredPoint> result;
  for (const CurveBin& bin : curve_bins(points, bottom, top, most_points, kSamplesABin)) {
    result.push_back({bin.z, bin.middle});
  }
  return result;
}

// Inserts `knot` in place of the points within half of `width`; returns its index.
std::size_t put(std::vector<MeasuredPoint>& branch, const MeasuredPoint& knot, Length width) {
  std::erase_if(branch, [&](const MeasuredPoint& point) { return abs(point.z - knot.z) < 0.5 * width; });
  const auto place = std::find_if(branch.begin(), branch.end(), [&](const auto& point) { return point.z > knot.z; });
  const auto index = static_cast<std::size_t>(place - branch.begin());
  branch.insert(place, knot);
  return index;
}

// Inserts a jump with the ends `below` and, a little higher, `above`; returns the number of points below it.
std::uint32_t put_jump(std::vector<MeasuredPoint>& branch, const MeasuredPoint& below, Force above, Length width) {
  const std::size_t last = put(branch, below, width);
  const auto next = branch.begin() + static_cast<std::ptrdiff_t>(last) + 1;
  branch.insert(next, {below.z + kJumpShareOfBin * width, above});
  return static_cast<std::uint32_t>(last + 1);
}

// Flattens the branch beyond the last significant force, where an instrument records its own baseline, which would be
// felt as a wave, and could be too strong for Turn-On.
void flatten_beyond(std::vector<MeasuredPoint>& approach, Length off, Force noise) {
  const Force significant = 5.0 * noise;
  for (auto point = approach.rbegin(); point->z > off && abs(point->force) < significant; ++point) {
    point->force = Force();
  }
}

// A gradual pull-off is the median of neighbouring samples at its place; the bins beside it are means of others, which
// noise may take deeper. None is felt as a harder pull, and the pull-off has some width, which no table's node misses.
void put_pull_off(std::vector<MeasuredPoint>& retract, const MeasuredPoint& pull_off, Force hardest, Length width) {
  for (MeasuredPoint& point : retract) point.force = std::max(point.force, hardest);
  const std::size_t first = put(retract, pull_off, width);
  const auto next = retract.begin() + static_cast<std::ptrdiff_t>(first) + 1;
  retract.insert(next, {pull_off.z + kPullOffShareOfBin * width, pull_off.force});
}

// Linear interpolation at `z`.
Force force_at(std::span<const MeasuredPoint> branch, Length z) {
  const auto above = std::find_if(branch.begin(), branch.end(), [&](const auto& point) { return point.z > z; });
  if (above == branch.begin()) return above->force;
  if (above == branch.end()) return (above - 1)->force;
  const MeasuredPoint& below = *(above - 1);
  return below.force + (z - below.z) / (above->z - below.z) * (above->force - below.force);
}

}  // namespace

MeasuredBranches measured_branches(std::span<const CurvePoint> points, std::size_t most_points) {
  const CurveFeatures features = analyse(points);
  if (!features.contact_point) {
    throw std::invalid_argument("the curve has no contact point: its approach never pushes the tip away");
  }
  const std::vector<CurvePoint> approach = centred(points, Branch::Approach, features),
                                retract = centred(points, Branch::Retract, features);
  if (retract.empty()) throw std::invalid_argument("the curve has no retract branch, without which no loop");

  const auto by_z = [](const auto& a, const auto& b) { return a.z < b.z; };
  const Length bottom = std::min(std::min_element(approach.begin(), approach.end(), by_z)->z,
                                 std::min_element(retract.begin(), retract.end(), by_z)->z);
  const Length highest = std::min(std::max_element(approach.begin(), approach.end(), by_z)->z,
                                  std::max_element(retract.begin(), retract.end(), by_z)->z);
  // without a snap-in, free and pressed branch are one line, which may be cut below the contact point, because a soft
  // sample may release there
  const Length let_go = *features.let_go - *features.contact_point, apart = 0.01 * abs(bottom);
  const Length in =
      features.snap_in ? features.snap_in->z - *features.contact_point : std::min(Length(), let_go - apart);
  const Length off = std::max(let_go, in + apart);
  const Length top = std::min(highest, std::max(off, 0.5 * (in - bottom)) + 0.5 * (off - bottom));
  const Length width = (top - bottom) / static_cast<double>(most_points);

  const bool at_jump = features.jumps_off && off == features.pull_off->z - *features.contact_point;
  const bool gradual = features.pull_off && !at_jump;
  // plus two knots and an end of a jump, or the ends of a jump and of a pull-off
  MeasuredBranches branches{smoothed(approach, bottom, top, most_points - 3),
                            smoothed(retract, bottom, top, most_points - (gradual ? 4 : 3)),
                            {}};
  const auto snap = features.snap_in;
  const Force met = force_at(branches.approach, in);
  branches.jumps.approach =
      put_jump(branches.approach, {in, snap ? snap->force_after : met}, snap ? snap->force_before : met, width);
  flatten_beyond(branches.approach, off, features.baseline.noise);
  if (gradual) {
    const Force pull_off = features.pull_off->force;
    put_pull_off(branches.retract, {features.pull_off->z - *features.contact_point, pull_off},
                 std::min(pull_off, features.adhesion->force), width);
  }
  branches.jumps.retract =
      put_jump(branches.retract, {off, at_jump ? features.pull_off->force : force_at(branches.retract, off)},
               force_at(branches.approach, off), width);
  return branches;
}

}  // namespace afm::physics
