// SPDX-License-Identifier: Apache-2.0
#include "retract_features.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "curve_bins.h"

namespace afm::physics {

namespace {

constexpr double kJumpShareOfPull = 0.25;
constexpr std::size_t kFilterSamples = 5;
constexpr std::size_t kReleaseBins = 512, kReleaseSamplesABin = 4;

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

// Work from the zero crossing of the retract's force to the last significant pull beyond the strongest one.
Energy work_of_separation(std::span<const CurvePoint> retract, std::size_t hardest, Force threshold) {
  std::size_t first = hardest, last = hardest;
  while (first > 0 && retract[first - 1].force.si < 0.0) --first;
  while (last + 1 < retract.size() && retract[last].force < -threshold) ++last;
  return work_below(retract.subspan(first, last - first + 1), Length(HUGE_VAL));
}

// The last point before the last sudden rise at or beyond the strongest pull. A computed curve has both ends of a jump
// at one Z; a measured one may have spread it over several samples of a filtered signal.
std::optional<std::size_t> jump_off(std::span<const CurvePoint> retract, std::size_t hardest, Force threshold,
                                    ForceZero zero_of_force) {
  const auto rise = [&](std::size_t i) { return retract[i + 1].force - retract[i].force; };
  const Force sudden = std::max(threshold, -kJumpShareOfPull * retract[hardest].force);
  std::optional<std::size_t> jump;
  for (std::size_t i = hardest; i + 1 < retract.size(); ++i) {
    const bool at_once = zero_of_force == ForceZero::True && retract[i + 1].z == retract[i].z && rise(i) > threshold;
    if (at_once || (rise(i) > sudden && retract[i].force < -threshold)) jump = i;
  }
  if (!jump || zero_of_force == ForceZero::True) return jump;
  const Force steep = kJumpShareOfPull * rise(*jump);
  while (*jump > hardest && rise(*jump - 1) > steep) --*jump;
  // one sample of a filtered signal may already have begun to rise
  const auto last = retract.begin() + static_cast<std::ptrdiff_t>(*jump) + 1;
  const auto first = last - static_cast<std::ptrdiff_t>(std::min(kFilterSamples, *jump - hardest + 1));
  // the last one of equal minima
  const auto deepest = std::min_element(std::make_reverse_iterator(last), std::make_reverse_iterator(first),
                                        [](const auto& a, const auto& b) { return a.force < b.force; });
  return static_cast<std::size_t>(deepest.base() - retract.begin()) - 1;
}

// Finds the release of a curve without a jump.
void find_gradual_release(std::span<const CurvePoint> retract, Force threshold, CurveFeatures& features) {
  const auto [low, high] =
      std::minmax_element(retract.begin(), retract.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  const std::vector<CurveBin> bins = curve_bins(retract, low->z, high->z, kReleaseBins, kReleaseSamplesABin);
  auto bin =
      std::min_element(bins.begin(), bins.end(), [](const auto& a, const auto& b) { return a.median < b.median; });
  features.pull_off = features.adhesion = Extreme{bin->z, bin->median};
  while (bin + 1 != bins.end() && bin->median < -threshold) ++bin;
  features.let_go = bin->z;
}

}  // namespace

void analyse_retract(std::span<const CurvePoint> cycle, std::size_t approach_count, Force threshold,
                     ForceZero zero_of_force, CurveFeatures& features) {
  const auto approach = cycle.first(approach_count), retract = cycle.subspan(approach_count);
  if (retract.empty()) return;
  features.let_go = features.contact_point;
  const auto hardest =
      std::min_element(retract.begin(), retract.end(), [](const auto& a, const auto& b) { return a.force < b.force; });
  const auto index = static_cast<std::size_t>(hardest - retract.begin());
  if (-hardest->force > threshold) {
    if (const auto jump = jump_off(retract, index, threshold, zero_of_force)) {
      features.jumps_off = true;
      features.pull_off = Extreme{retract[*jump].z, retract[*jump].force};
      features.adhesion = Extreme{hardest->z, hardest->force};
      features.let_go = retract[*jump].z;
    } else {
      find_gradual_release(retract, threshold, features);
    }
    features.adhesion_energy = work_of_separation(retract, index, threshold);
  }
  const auto by_z = [](const auto& a, const auto& b) { return a.z < b.z; };
  const Length both = std::min(std::max_element(approach.begin(), approach.end(), by_z)->z,
                               std::max_element(retract.begin(), retract.end(), by_z)->z);
  // a pull without an end ends where the approach began
  if (features.let_go) features.let_go = std::min(both, *features.let_go);
  features.loop_energy = work_below(cycle, features.let_go.value_or(both));
}

}  // namespace afm::physics
