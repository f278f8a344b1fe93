// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/pattern.h"

#include <cmath>
#include <limits>

namespace afm::physics {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

// Shortest augmenting paths by reduced costs: each target in turn takes a particle, possibly from another target, which
// then takes its next best.
class Assignment {
 public:
  Assignment(std::span<const Sideways<Length>> targets, std::span<const Sideways<Length>> particles)
      : targets_(targets),
        particles_(particles),
        of_target_(targets.size(), 0.0),
        of_particle_(particles.size(), 0.0),
        target_on_(particles.size(), kNone) {
    for (std::size_t target = 0; target < targets.size(); ++target) add(target);
  }

  std::vector<std::size_t> take() const {
    std::vector<std::size_t> particles(targets_.size());
    for (std::size_t i = 0; i < target_on_.size(); ++i) {
      if (target_on_[i] != kNone) particles[target_on_[i]] = i;
    }
    return particles;
  }

 private:
  double cost(std::size_t target, std::size_t particle) const {
    const Sideways<Length> apart = targets_[target] - particles_[particle];
    return apart.x.si * apart.x.si + apart.y.si * apart.y.si;
  }

  void add(std::size_t added) {
    const std::size_t count = particles_.size();
    std::vector<double> least(count, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> from(count, kNone);  // particle before it on the path
    std::vector<bool> seen(count, false);
    std::size_t last = kNone, target = added;
    double at = 0.0;  // cost of the path to `target`
    while (true) {
      std::size_t next = kNone;
      for (std::size_t i = 0; i < count; ++i) {
        if (seen[i]) continue;
        const double reduced = at + cost(target, i) - of_target_[target] - of_particle_[i];
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

  std::span<const Sideways<Length>> targets_, particles_;
  std::vector<double> of_target_, of_particle_;  // potentials
  std::vector<std::size_t> target_on_;           // target that each particle is assigned to
};

}  // namespace

PatternMatch match_pattern(std::span<const Sideways<Length>> targets, std::span<const Sideways<Length>> particles) {
  PatternMatch match{.particles = Assignment(targets, particles).take(), .rms = Length(0.0)};
  double sum_m2 = 0.0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Length apart = magnitude(targets[i] - particles[match.particles[i]]);
    sum_m2 += apart.si * apart.si;
  }
  if (!targets.empty()) match.rms = Length(std::sqrt(sum_m2 / static_cast<double>(targets.size())));
  return match;
}

}  // namespace afm::physics
