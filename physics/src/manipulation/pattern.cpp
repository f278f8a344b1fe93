// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/pattern.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace afm::physics {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

// Squared distance of a particle from a target. The mean of those of the ends of a rod is that of the middles, plus
// that of the ways from middle to end, the nearer way round.
class PatternDistance {
 public:
  PatternDistance(std::span<const Sideways<Length>> targets, std::span<const Sideways<Length>> particles,
                  const PatternRods& rods)
      : targets_(targets), particles_(particles), rods_(rods) {}

  std::size_t targets() const { return targets_.size(); }
  std::size_t particles() const { return particles_.size(); }

  double squared_m2(std::size_t target, std::size_t particle) const {
    const Sideways<Length> apart = targets_[target] - particles_[particle];
    const double middles = apart.x.si * apart.x.si + apart.y.si * apart.y.si;
    if (rods_.targets.empty()) return middles;
    const Sideways<Length>& end = rods_.particles[particle];
    const Sideways<double>& axis = rods_.targets[target];
    const double half2 = end.x.si * end.x.si + end.y.si * end.y.si;
    const double along = std::sqrt(half2) * std::abs(end.x.si * axis.x + end.y.si * axis.y);
    return middles + 2.0 * std::max(0.0, half2 - along);
  }

  Length away(std::size_t target, std::size_t particle) const {
    return rods_.targets.empty() ? magnitude(targets_[target] - particles_[particle])
                                 : Length(std::sqrt(squared_m2(target, particle)));
  }

 private:
  std::span<const Sideways<Length>> targets_, particles_;
  PatternRods rods_;
};

// Shortest augmenting paths by reduced costs: each target in turn takes a particle, possibly from another target, which
// then takes its next best.
class Assignment {
 public:
  explicit Assignment(const PatternDistance& distance)
      : distance_(distance),
        of_target_(distance.targets(), 0.0),
        of_particle_(distance.particles(), 0.0),
        target_on_(distance.particles(), kNone) {
    for (std::size_t target = 0; target < distance.targets(); ++target) add(target);
  }

  std::vector<std::size_t> take() const {
    std::vector<std::size_t> particles(distance_.targets());
    for (std::size_t i = 0; i < target_on_.size(); ++i) {
      if (target_on_[i] != kNone) particles[target_on_[i]] = i;
    }
    return particles;
  }

 private:
  void add(std::size_t added) {
    const std::size_t count = distance_.particles();
    std::vector<double> least(count, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> from(count, kNone);  // predecessor of each particle on the path
    std::vector<bool> seen(count, false);
    std::size_t last = kNone, target = added;
    double at = 0.0;  // cost of the path to `target`
    while (true) {
      std::size_t next = kNone;
      for (std::size_t i = 0; i < count; ++i) {
        if (seen[i]) continue;
        const double reduced = at + distance_.squared_m2(target, i) - of_target_[target] - of_particle_[i];
        if (reduced < least[i]) {
          least[i] = reduced;
          from[i] = last;
        }
        if (next == kNone || least[i] < least[next]) next = i;
      }
      last = next;
      at = least[last];
      seen[last] = true;
      if (target_on_[last] == kNone) break;
      target = target_on_[last];
    }
    of_target_[added] += at;
    for (std::size_t i = 0; i < count; ++i) {
      if (!seen[i]) continue;
      if (target_on_[i] != kNone) of_target_[target_on_[i]] += at - least[i];
      of_particle_[i] -= at - least[i];
    }
    for (; from[last] != kNone; last = from[last]) target_on_[last] = target_on_[from[last]];
    target_on_[last] = added;
  }

  const PatternDistance& distance_;
  std::vector<double> of_target_, of_particle_;  // potentials
  std::vector<std::size_t> target_on_;           // target assigned to each particle
};

}  // namespace

PatternMatch match_pattern(std::span<const Sideways<Length>> targets, std::span<const Sideways<Length>> particles,
                           const PatternRods& rods) {
  const PatternDistance distance(targets, particles, rods);
  PatternMatch match{.particles = Assignment(distance).take(), .rms = Length(0.0)};
  double sum_m2 = 0.0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Length apart = distance.away(i, match.particles[i]);
    sum_m2 += apart.si * apart.si;
  }
  if (!targets.empty()) match.rms = Length(std::sqrt(sum_m2 / static_cast<double>(targets.size())));
  return match;
}

}  // namespace afm::physics
