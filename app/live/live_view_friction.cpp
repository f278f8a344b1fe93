// SPDX-License-Identifier: Apache-2.0
// The friction loop beside the force curve of the live window.
#include "app/live/live_view.h"
#include "core/log.h"
#include "physics/friction/friction.h"

namespace afm::app {

void LiveView::toggle_friction_loop() {
  const auto material = servo_.material();
  if (!material) return core::log_line("friction loop: choose a sample first");
  if (!panels_.toggle_friction_loop()) return core::log_line("friction loop: hidden");
  const physics::FrictionLaw law = felt_[*material].parameters.friction.law;
  core::log_line(law == physics::FrictionLaw::None
                     ? std::string("friction loop: friction is off; start with --friction lattice, area or amontons")
                     : std::string("friction loop: shown, friction ") + std::string(physics::text_of(law).word));
}

}  // namespace afm::app
