// SPDX-License-Identifier: Apache-2.0
#include "haptics/contact/sweeping_scan.h"
#include "haptics/felt_particles.h"

namespace afm::haptics {

void FeltParticles::end_sweep() noexcept {
  sweep_ended_ = true;
  if (sweeping_) sweeping_->end();
}

// A new tip, that of the scan, moves them; the hand's own is off them, so that it is held over them before it meets
// them again.
void FeltParticles::sweep(const scene::ScanLead& scan, double elapsed_s, ParticlePush& step) noexcept {
  if (!sweeping_) return;
  const bool looks = scan.hand == scene::ScanHand::Looks;
  if (!looks) sweep_ended_ = false;
  if (!looks || sweep_ended_ || !may_look() || !sweeping_->sweeps(1e-12 * scan.load_pn)) return sweeping_->end();
  if (!sweeping_->goes_on(scan)) {
    strokes_.begin();
    spun_ = scene::kNoParticle;
    sweeping_->begin(scan, pages_);
  }
  const physics::PushTick& tick = sweeping_->step(drift_.way_m(), elapsed_s);
  const std::size_t begun = move_poses(sweeping_->particles());
  for (const std::uint32_t i : sweeping_->particles().moved()) {
    particles_.put(i, {sweeping_->particles().position(i), sweeping_->particles().turn(i)});
  }
  if (begun == 0) return;
  step.add({physics::EventKind::ParticleSwept, tick.gave_at.si, magnitude(tick.lateral).si});
}

}  // namespace afm::haptics
