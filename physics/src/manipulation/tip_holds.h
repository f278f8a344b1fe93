// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/manipulation/pushed_particles.h"
#include "physics/manipulation/tip_hold.h"

namespace afm::physics {

// Pull-off force of a contact with the tip, on its flank and on its cap.
struct TipPull {
  double flank_n = 0.0, cap_n = 0.0;  // pull-off forces; 0: the tip only pushes

  bool holds() const noexcept { return flank_n > 0.0; }
  double on(bool cap) const noexcept { return cap ? cap_n : flank_n; }
};

// Spheres that the tip holds by adhesion. What a contact bears is drawn when it forms. The constructor allocates,
// nothing else does.
class TipHolds {
 public:
  TipHolds(const PushSetup& setup, const std::vector<PlacedParticle>& particles)
      : held_(particles.size()), follows_(particles.size()) {
    for (const ParticleSpecies& s : setup.species) {
      const TipPull pull{tip_pull_off(setup.tip, s, true).si, tip_pull_off(setup.tip, s, false).si};
      kinds_.push_back({s.sticks ? pull : TipPull{}, s.scatter_seed, s.sticks && lifts_anywhere(setup, s)});
      const double most_n = std::max(kinds_.back().pull.flank_n, kinds_.back().pull.cap_n);
      const double factor = s.scatter_seed != 0 ? kLargestFactor : 1.0;
      stretch_m_ = std::max(stretch_m_, factor * most_n / setup.springs.contact.si);
    }
    for (const PlacedParticle& particle : particles) kind_of_.push_back(particle.species);
    formed_.assign(particles.size(), 0);
  }

  const TipPull& pull_of(std::size_t particle) const noexcept { return held_[particle]; }
  // True if the tip lifts such particles off the sample or off a pad.
  bool lifts(std::size_t particle) const noexcept { return kinds_[kind_of_[particle]].lifts; }
  double stretch_m() const noexcept { return stretch_m_; }  // longest gap across which a contact holds

  // The tip touches a particle. True if it holds the particle from now on.
  bool form(std::size_t particle) noexcept {
    follows_[particle] = false;
    const Kind& kind = kinds_[kind_of_[particle]];
    if (!kind.pull.holds() || held_[particle].holds()) return false;
    const double factor = kind.seed != 0 ? pull_off_factor(kind.seed, particle, formed_[particle]++) : 1.0;
    held_[particle] = {factor * kind.pull.flank_n, factor * kind.pull.cap_n};
    return true;
  }

  // Records that a pull moves a particle. True for the first time since the tip last touched it.
  bool begins_to_follow(std::size_t particle) noexcept {
    const bool begins = !follows_[particle];
    follows_[particle] = true;
    return begins;
  }

  void tear(std::size_t particle) noexcept { held_[particle] = {}; }

  void reset() noexcept {
    std::fill(held_.begin(), held_.end(), TipPull{});
    std::fill(formed_.begin(), formed_.end(), 0U);
  }

 private:
  static constexpr double kLargestFactor = 6.0;  // upper bound of pull_off_factor()

  struct Kind {
    TipPull pull;
    std::uint16_t seed = 0;
    bool lifts = false;
  };

  std::vector<Kind> kinds_;  // adhesion of each species
  std::vector<std::size_t> kind_of_;
  std::vector<TipPull> held_;
  std::vector<bool> follows_;          // flag of each particle: moved by a pull since the last touch
  std::vector<std::uint32_t> formed_;  // number of contacts of each particle since reset()
  double stretch_m_ = 0.0;
};

}  // namespace afm::physics
