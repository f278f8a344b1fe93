// SPDX-License-Identifier: Apache-2.0
#include "app/live_servo.h"

namespace afm::app {

namespace {

constexpr std::int64_t kLongestFrameNs = 2'000'000'000;
constexpr double kTurnM = 0.2e-9;  // Z must rise this far above its lowest before it counts as retracting

}  // namespace

void FrameBeat::operator()() const {
  const std::int64_t now_ns = clock_.now_ns();
  if (now_ns - start_ns_ < kLongestFrameNs) servo_.beat(now_ns);
}

bool is_retracting(double z_m, double deepest_z_m) { return z_m > deepest_z_m + kTurnM; }

Moment moment_of(const scene::TipState& tip, bool retracting) {
  Moment now;
  if (tip.material >= 0) now.material = static_cast<std::size_t>(tip.material);
  now.tip = {.z_m = tip.z_m,
             .deflection_m = tip.deflection_m,
             .z_joc_m = tip.release_z_m,
             .xy_m = {tip.tip_xy_m[0], tip.tip_xy_m[1]},
             .surface_height_m = tip.surface_height_m};
  now.force_n = tip.force_n;
  now.servo_state = tip.servo_state;
  now.phase = tip.phase;
  now.retracting = retracting;
  now.realtime = tip.realtime != 0;
  now.slow_motion = tip.slow_motion;
  return now;
}

const char* reason(scene::FaultCode fault) {
  switch (fault) {
    case scene::FaultCode::None:
      return "no fault";
    case scene::FaultCode::RendererDied:
      return "the renderer died";
    case scene::FaultCode::RendererHung:
      return "the renderer gave no frame for 250 ms";
    case scene::FaultCode::NotFinite:
      return "a position or force was not finite";
    case scene::FaultCode::LateTick:
      return "a servo tick came more than 20 ms late";
    case scene::FaultCode::VelocityTrip:
      return "the hand was faster than is safe";
    case scene::FaultCode::DeviceError:
      return "the haptic device failed";
    case scene::FaultCode::BadSharedData:
      return "the shared data was damaged";
    case scene::FaultCode::DeadManReleased:
      return "the Turn-On button was let go";
    case scene::FaultCode::MotorsHot:
      return "the device's motors are hot";
    case scene::FaultCode::EnergyExceeded:
      return "the hand was given more energy than the model holds";
    case scene::FaultCode::OutOfWorkspace:
      return "the hand left the device's workspace";
  }
  return "an unknown fault";
}

}  // namespace afm::app
