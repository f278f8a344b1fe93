// SPDX-License-Identifier: Apache-2.0
#include "servo/fault_reason.h"

namespace afm::servo {

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

}  // namespace afm::servo
