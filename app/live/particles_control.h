// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/view_control.h"
#include "exhibit/state/particles_now.h"

namespace afm::app {

struct ViewParts;

// Shows the particles where the servo has moved them.
class ParticlesControl final : public ViewControl {
 public:
  // `set` must outlive the object.
  ParticlesControl(ViewParts& parts, const scene::ParticleSet& set) : parts_(parts), now_{.set = &set} {}

  void add_to_moment(exhibit::Moment& now, ViewFrame& frame) override;

 private:
  ViewParts& parts_;
  exhibit::ParticlesNow now_;
};

}  // namespace afm::app
