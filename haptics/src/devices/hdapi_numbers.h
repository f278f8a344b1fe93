// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// Numbers of the vendor's interface, under our own names. Positions are in millimetres, velocities in mm/s, forces in
// N; the device frame is right +x, up +y, towards the user +z.
namespace afm::haptics::hdapi {

// errors
inline constexpr std::uint32_t kWarmMotors = 0x0200;
inline constexpr std::uint32_t kExceededForce = 0x0201;
inline constexpr std::uint32_t kExceededForceImpulse = 0x0202;
inline constexpr std::uint32_t kExceededVelocity = 0x0203;
inline constexpr std::uint32_t kForceError = 0x0204;
inline constexpr std::uint32_t kDeviceFault = 0x0300;
inline constexpr std::uint32_t kAlreadyInitiated = 0x0301;
inline constexpr std::uint32_t kCommunicationError = 0x0302;
inline constexpr std::uint32_t kCommunicationSetupError = 0x0303;
inline constexpr std::uint32_t kTimerError = 0x0304;
inline constexpr std::uint32_t kSchedulerFull = 0x0501;

// properties
inline constexpr std::uint32_t kButtons = 0x2000;       // one integer, one bit per button
inline constexpr std::uint32_t kPosition = 0x2050;      // three doubles
inline constexpr std::uint32_t kModel = 0x2501;         // text
inline constexpr std::uint32_t kSerialNumber = 0x2504;  // text
inline constexpr std::uint32_t kMaxWorkspace = 0x2550;  // six doubles: smallest x, y, z, largest x, y, z
inline constexpr std::uint32_t kUsableWorkspace = 0x2551;
inline constexpr std::uint32_t kCalibrationStyle = 0x2555;  // one integer, one bit per style
inline constexpr std::uint32_t kNominalStiffness = 0x2602;  // one double, N/mm
inline constexpr std::uint32_t kNominalForce = 0x2603;
inline constexpr std::uint32_t kNominalContinuousForce = 0x2604;
inline constexpr std::uint32_t kMotorTemperature = 0x2605;   // one double per motor, 0 cold to 1 too hot
inline constexpr std::uint32_t kVelocityLimit = 0x2606;      // one double, mm/s
inline constexpr std::uint32_t kForceImpulseLimit = 0x2607;  // one double, N/ms
inline constexpr std::uint32_t kForce = 0x2700;              // three doubles

// capabilities
inline constexpr std::uint32_t kForceOutput = 0x4000;
inline constexpr std::uint32_t kForceClamping = 0x4001;

// calibration
inline constexpr std::uint32_t kCalibrated = 0x5000;
inline constexpr std::uint32_t kNeedsUpdate = 0x5001;
inline constexpr std::uint32_t kNeedsManualInput = 0x5002;
inline constexpr std::uint32_t kStyleAuto = 2;
inline constexpr std::uint32_t kStyleInkwell = 4;

inline constexpr std::uint32_t kFirstButton = 1;

// scheduler
inline constexpr std::uint32_t kContinue = 1;  // returned by a callback that should be called again
inline constexpr std::uint16_t kHighestPriority = 65535;
inline constexpr HdapiSchedulerHandle kInvalidCallback = 0xFFFFFFFF;
inline constexpr HdapiHandle kInvalidDevice = 0xFFFFFFFF;

// Larger than any property's number of values, so that a driver that writes too many stays within the array.
inline constexpr int kRoomForValues = 32;

}  // namespace afm::haptics::hdapi
