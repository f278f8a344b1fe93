// SPDX-License-Identifier: Apache-2.0
#include "forcedimension/dhd_library.h"

#include <fmt/core.h>

#include "drivers/function_binder.h"

namespace afm::haptics {

namespace {

// Names of the SDK's shared libraries; the SDK is an archive without a fixed place.
constexpr const char* kDhdLibraryNames[] = {"libdhd.so.3", "libdhd.so", "libdrd.so.3", "libdrd.so"};
constexpr int kKnownVersion = 3;

// Reason for a refusal; empty if the library can be used.
std::string bind_dhd(void* library, DhdFunctions& dhd) {
  FunctionBinder binder(library);
  binder.bind("dhdGetSDKVersion", dhd.get_version);
  binder.bind("dhdGetDeviceCount", dhd.count_devices);
  binder.bind("dhdOpenID", dhd.open_index);
  binder.bind("dhdClose", dhd.close);
  binder.bind("dhdErrorGetLast", dhd.get_last_error);
  binder.bind("dhdErrorGetStr", dhd.get_error_string);
  binder.bind("dhdGetSystemType", dhd.get_type);
  binder.bind("dhdGetSystemName", dhd.get_name);
  binder.bind("dhdGetSerialNumber", dhd.get_serial_number);
  binder.bind("dhdHasGripper", dhd.has_gripper);
  binder.bind("dhdGetEffectorMass", dhd.get_effector_mass);
  binder.bind("dhdGetStatus", dhd.get_status);
  binder.bind("dhdGetPosition", dhd.get_position);
  binder.bind("dhdGetButton", dhd.get_button);
  binder.bind("dhdSetForceAndTorqueAndGripperForce", dhd.set_force);
  binder.bind("dhdEnableForce", dhd.enable_force);
  binder.bind("dhdSetBrakes", dhd.set_brakes);
  binder.bind("dhdSetGravityCompensation", dhd.set_gravity_compensation);
  binder.bind("dhdEmulateButton", dhd.emulate_button);
  binder.bind("dhdEnableExpertMode", dhd.enable_expert_mode);
  binder.bind("dhdDisableExpertMode", dhd.disable_expert_mode);
  binder.bind("dhdSetWatchdog", dhd.set_watchdog);
  if (std::string refusal = binder.refusal(); !refusal.empty()) return refusal;
  FunctionBinder(library).bind("dhdSetMaxForce", dhd.set_max_force);

  int major = 0, minor = 0, release = 0, revision = 0;
  dhd.get_version(&major, &minor, &release, &revision);
  if (major == kKnownVersion) return {};
  return fmt::format("its version is {}.{}.{}; TouchAFM knows version {}", major, minor, release, kKnownVersion);
}

}  // namespace

DhdSearch load_dhd(const std::string& configured) {
  return search_library<DhdFunctions>(kDhdLibraryNames, configured, bind_dhd);
}

}  // namespace afm::haptics
