// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/level_choice.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "scene/shared/particle_blocks.h"

namespace afm::scene {

core::Result<void> set_level(const LevelChoice& choice, SharedParticles& particles) {
  if (choice.level == 0) return {};
  if (const std::string why = why_no_level(particles); !why.empty()) {
    return core::wrong_usage(fmt::format("--level {}: {}; leave it out", choice.level, why));
  }
  particles.level = {.level = static_cast<std::uint32_t>(choice.level),
                     .seed = static_cast<std::uint32_t>(choice.seed)};
  return {};
}

}  // namespace afm::scene
