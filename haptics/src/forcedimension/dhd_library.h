// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "drivers/vendor_library.h"

// Force Dimension's library of haptic devices ("DHD"), installed by the lab and loaded at run time: omega, delta,
// sigma, lambda, and Novint's Falcon. Names, types and numbers are our own, based only on the facts of the interface
// (x86-64 SysV, plain C), as SDK 3.7 and 3.17 declare it and as CHAI3D, HAPI, sawForceDimensionSDK and Force
// Dimension's Python bindings use it: no header, binary or text of the manufacturer is used, and none may enter this
// tree.
//
// Positions are in metres, forces in N. The library's frame is x towards the user, y right, z up (CHAI3D, HAPI).
namespace afm::haptics {

using DhdId = char;  // number of an open device

// Functions of the library used by TouchAFM. All may be called from any thread; those that return an int return -1 on
// failure, and get_last_error() then has the reason, separately for each thread.
struct DhdFunctions {
  void (*get_version)(int* major, int* minor, int* release, int* revision) = nullptr;
  int (*count_devices)() = nullptr;
  int (*open_index)(char index) = nullptr;  // returns the DhdId; CHAI3D counts it from 0
  int (*close)(DhdId device) = nullptr;
  int (*get_last_error)() = nullptr;
  const char* (*get_error_string)(int error) = nullptr;

  int (*get_type)(DhdId device) = nullptr;
  const char* (*get_name)(DhdId device) = nullptr;
  int (*get_serial_number)(unsigned short* number, DhdId device) = nullptr;
  bool (*has_gripper)(DhdId device) = nullptr;
  int (*get_effector_mass)(double* kilograms, DhdId device) = nullptr;

  int (*get_status)(int* values, DhdId device) = nullptr;                        // writes dhd::kRoomForStatus at most
  int (*get_position)(double* x, double* y, double* z, DhdId device) = nullptr;  // returns 0 or dhd::kTimeGuard
  int (*get_button)(int index, DhdId device) = nullptr;                          // returns 1 if pressed
  // Force, torque and force of the gripper, the last two always 0 here. 0, or dhd::kMotorSaturated.
  int (*set_force)(double fx, double fy, double fz, double tx, double ty, double tz, double gripper,
                   DhdId device) = nullptr;
  int (*enable_force)(unsigned char on, DhdId device) = nullptr;  // `on` 0: brake mode
  int (*set_brakes)(int on, DhdId device) = nullptr;              // `on` 0: idle mode, the arm falls
  int (*set_gravity_compensation)(int on, DhdId device) = nullptr;
  int (*emulate_button)(unsigned char on, DhdId device) = nullptr;  // closing the gripper acts as button 0

  // expert mode, which belongs to the whole library
  int (*enable_expert_mode)() = nullptr;
  int (*disable_expert_mode)() = nullptr;
  int (*set_watchdog)(unsigned char eighths_of_a_millisecond, DhdId device) = nullptr;

  int (*set_max_force)(double newtons, DhdId device) = nullptr;  // null: the library is older than this function
};

using DhdSearch = LibrarySearch<DhdFunctions>;

// Loads only `configured` if it is not empty; otherwise the first of libdhd.so.3, libdhd.so, libdrd.so.3 and libdrd.so
// (which contains the former) that can be loaded, has the functions above and says that its version is 3.
DhdSearch load_dhd(const std::string& configured);

namespace dhd {

// errors: values of get_last_error()
inline constexpr int kCommunicationError = 2;
inline constexpr int kNoDriver = 4;
inline constexpr int kNoDevice = 5;
inline constexpr int kTimeout = 7;
inline constexpr int kGeometry = 8;  // joint angles that no position of the arm has
inline constexpr int kNotReady = 12;
inline constexpr int kInUse = 20;

// results that are no failures
inline constexpr int kTimeGuard = 1;       // earlier position: the device was not queried again
inline constexpr int kMotorSaturated = 2;  // less force than requested, because a motor is saturated

// indices of get_status(); 1: yes, 0: no
inline constexpr int kPowered = 0;
inline constexpr int kConnected = 1;
inline constexpr int kReset = 3;  // the device waits to be calibrated
inline constexpr int kForceMode = 5;
inline constexpr int kFailed = 9;
inline constexpr int kForceOffCause = 14;

// Larger than any version's number of values (13 to 17), so that a library that writes more stays within the array.
inline constexpr int kRoomForStatus = 64;

// values of kForceOffCause: why the device itself left force mode
inline constexpr int kOffByButton = 1;
inline constexpr int kOffByVelocity = 2;
inline constexpr int kOffByWatchdog = 3;
inline constexpr int kOffByCable = 5;
inline constexpr int kOffByDeadMan = 6;

inline constexpr std::int64_t kWatchdogUnitNs = 125'000;

}  // namespace dhd

}  // namespace afm::haptics
