// SPDX-License-Identifier: Apache-2.0
#include "app/live/particles_control.h"

#include "app/view/servo_supervisor.h"
#include "app/view/view_parts.h"
#include "exhibit/state/moment.h"
#include "servo/servo_client.h"

namespace afm::app {

void ParticlesControl::add_to_moment(exhibit::Moment& now, ViewFrame& /*frame*/) {
  const servo::ServoClient& servo = parts_.servo.link();
  now_.pages = servo.particle_pages();
  now_.push = servo.push();
  now.wall.particles = &now_;
}

}  // namespace afm::app
