// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>

#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"
#include "physics/manipulation/pushed_particles.h"
#include "scene/samples/particle_set.h"

// Whatever the bytes: a set of particles that can be pushed, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const afm::fuzz::MemoryFile file(bytes, size);
  const auto set = afm::scene::load_particle_set(file.path());
  if (!set) return 0;
  ++afm::fuzz::accepted_inputs;
  afm::physics::PushedParticles particles(set->setup, set->particles, set->start);
  for (const afm::scene::HandMove& move : set->moves) {
    const afm::physics::PushTick& tick = particles.move_to(move.to, afm::physics::Time(1e-3));
    if (!std::isfinite(tick.stored.si) || !std::isfinite(tick.lateral.x.si)) std::abort();
  }
  return 0;
}
