// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "physics/units.h"

// Limits of particles on a sample, for those who explain a refusal in the words of a file.
namespace afm::physics {

inline constexpr Length kThinnestParticle{1e-9}, kThickestParticle{1e-5};  // bounds of R_p
inline constexpr double kFlattestIsland = 1.5;  // smallest ratio of an island's width to its height

// Refusal of a particle: of an unknown species, without a finite angle, or where another one lies already. Its text
// counts particles from 1, as people do.
class UnplaceableParticle : public std::invalid_argument {
 public:
  UnplaceableParticle(std::size_t particle, const std::string& why) : std::invalid_argument(why), particle_(particle) {}
  std::size_t particle() const noexcept { return particle_; }  // index, from 0

 private:
  std::size_t particle_;
};

}  // namespace afm::physics
