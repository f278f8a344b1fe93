// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>

#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"
#include "physics/manipulation/pushed_particles.h"
#include "scene/samples/ink_run.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/scratch_run.h"

// Whatever the bytes: a set of particles that can be pushed, a sample that can be scratched, ink, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const afm::fuzz::MemoryFile file(bytes, size);
  const auto set = afm::scene::load_particle_set(file.path());
  if (!set) return 0;
  ++afm::fuzz::accepted_inputs;
  if (set->ink) {
    const afm::scene::ScratchField field = afm::scene::scratch_field(*set);
    afm::physics::InkedSurface surface(set->ink->ink, field.least, field.most, afm::scene::ink_margin(*set),
                                       afm::scene::ink_spacing(*set));
    for (const afm::scene::HandMove& move : set->moves) surface.touch(move.to.position, afm::physics::Time(1e-3));
    if (!std::isfinite(surface.covered().si)) std::abort();
    return 0;
  }
  if (set->soft) {
    const afm::scene::ScratchField field = afm::scene::scratch_field(*set);
    afm::physics::ScratchingTip tip(set->setup.tip, set->setup.springs, set->soft->surface, field.least, field.most,
                                    set->start);
    for (const afm::scene::HandMove& move : set->moves) {
      const afm::physics::ScratchTick& tick = tip.move_to(move.to);
      if (!std::isfinite(tick.stored.si) || !std::isfinite(tick.lateral.x.si)) std::abort();
    }
    return 0;
  }
  afm::physics::PushedParticles particles(set->setup, set->particles, set->start);
  for (const afm::scene::HandMove& move : set->moves) {
    const afm::physics::PushTick& tick = particles.move_to(move.to, afm::physics::Time(1e-3));
    if (!std::isfinite(tick.stored.si) || !std::isfinite(tick.lateral.x.si)) std::abort();
  }
  return 0;
}
