// SPDX-License-Identifier: Apache-2.0
#include "devices/hdapi_setup.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "core/printable.h"
#include "devices/hdapi_numbers.h"

namespace afm::haptics::hdapi {

namespace {

constexpr int kMostErrors = 64;  // limit that detects a broken library, whose stack never empties
constexpr int kMostRetries = 10;
constexpr auto kRetryPause = std::chrono::milliseconds(20);
constexpr double kMillimetre = 1e-3;

// Largest stiffness stable at 1 kHz (CHAI3D: 400 N/m for the Touch). The manufacturer's values range from 0 to 1 N/mm.
constexpr double kStableStiffnessNPerM = 400.0;

// Share of the workspace below the sample's surface; a stroke of 50 mm and the recoil need the rest.
constexpr double kContactShare = 1.0 / 3.0;

struct Taken {
  HdapiHandle device = kInvalidDevice;
  HdapiError error;
};

Taken try_name(const HdapiFunctions& hd, const char* name) {
  for (int retry = 0;; ++retry) {
    Taken taken;
    taken.device = hd.init_device(name);
    taken.error = take_newest_error(hd);
    if (taken.error.code != kAlreadyInitiated || retry == kMostRetries) return taken;
    std::this_thread::sleep_for(kRetryPause);
  }
}

double one_double(const HdapiFunctions& hd, std::uint32_t property) {
  std::array<double, kRoomForValues> values{};
  hd.get_doubles(property, values.data());
  return values[0];
}

std::string text(const HdapiFunctions& hd, std::uint32_t property) {
  const char* value = hd.get_string(property);
  return value == nullptr ? std::string() : core::printable(value);
}

core::Result<double> limit(const HdapiFunctions& hd, std::uint32_t property, const char* what, const char* unit,
                           double largest) {
  const double value = one_double(hd, property);
  if (value > 0 && value <= largest) return value;
  return core::failure(
      core::ErrorCategory::Failed,
      fmt::format("the haptic device reports an impossible {} of {} {}; check it with the manufacturer's test program",
                  what, value, unit));
}

bool is_box(const glm::dvec3& smallest, const glm::dvec3& largest) {
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = largest[axis] - smallest[axis];
    if (!(extent > 0.01 && extent < 10.0) || !is_within_reach(smallest)) return false;
  }
  return true;
}

}  // namespace

HdapiError take_newest_error(const HdapiFunctions& hd) {
  const HdapiError newest = hd.get_error();
  for (int i = 0; i < kMostErrors && hd.get_error().code != 0; ++i) {
  }
  return newest;
}

std::string error_text(const HdapiFunctions& hd, std::uint32_t code) {
  const char* words = hd.get_error_string(code);
  return fmt::format("{} (0x{:04x})", words == nullptr ? "unnamed error" : words, code);
}

core::Result<HdapiHandle> take_device(const HdapiFunctions& hd, const std::string& name) {
  struct Candidate {
    const char* name;  // null: the library's own default device
    std::string said;
  };
  // some drivers know only one of the two defaults
  std::vector<Candidate> candidates{{nullptr, "the default device"},
                                    {"Default Device", "\"Default Device\""},
                                    {"Default PHANToM", "\"Default PHANToM\""}};
  if (!name.empty()) candidates = {{name.c_str(), fmt::format("\"{}\"", name)}};

  std::string refusals;
  take_newest_error(hd);
  for (const Candidate& candidate : candidates) {
    const Taken taken = try_name(hd, candidate.name);
    if (taken.error.code == 0 && taken.device != kInvalidDevice) {
      hd.make_current_device(taken.device);
      return taken.device;
    }
    refusals += fmt::format("{}{}: {}", refusals.empty() ? "" : ", ", candidate.said,
                            taken.error.code == 0 ? "neither a handle nor an error" : error_text(hd, taken.error.code));
  }
  return core::failure(core::ErrorCategory::DeviceMissing,
                       fmt::format("no haptic device responds ({}); check cable and power, and check that the "
                                   "manufacturer's test program finds it",
                                   refusals));
}

core::Result<DeviceSpec> query_spec(const HdapiFunctions& hd) {
  const auto max_force = limit(hd, kNominalForce, "nominal force", "N", 100.0);
  if (!max_force) return tl::unexpected(max_force.error());
  const auto continuous_force = limit(hd, kNominalContinuousForce, "continuous force", "N", *max_force);
  if (!continuous_force) return tl::unexpected(continuous_force.error());
  const auto impulse = limit(hd, kForceImpulseLimit, "force impulse limit", "N/ms", 1e3);
  if (!impulse) return tl::unexpected(impulse.error());
  const auto velocity = limit(hd, kVelocityLimit, "velocity limit", "mm/s", 1e5);
  if (!velocity) return tl::unexpected(velocity.error());

  std::array<double, kRoomForValues> box{};
  hd.get_doubles(kUsableWorkspace, box.data());
  const glm::dvec3 smallest = kMillimetre * glm::dvec3(box[0], box[1], box[2]);
  const glm::dvec3 largest = kMillimetre * glm::dvec3(box[3], box[4], box[5]);
  if (!is_box(smallest, largest)) {
    return core::failure(
        core::ErrorCategory::Failed,
        "the haptic device reports an impossible workspace; check it with the manufacturer's test program");
  }
  const double stiffness = 1e3 * one_double(hd, kNominalStiffness);
  const std::string model = text(hd, kModel);
  const std::string serial = text(hd, kSerialNumber);
  if (const HdapiError error = take_newest_error(hd); error.code != 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("the haptic device does not report its limits: {}", error_text(hd, error.code)));
  }
  return DeviceSpec{
      .name = (model.empty() ? std::string("HDAPI device") : model) + (serial.empty() ? "" : ", serial " + serial),
      .max_force_n = *max_force,
      .max_continuous_force_n = *continuous_force,
      .max_stiffness_n_per_m = stiffness > 0 ? std::min(stiffness, kStableStiffnessNPerM) : kStableStiffnessNPerM,
      .max_slew_n_per_s = 1e3 * *impulse,
      .max_speed_m_per_s = kMillimetre * *velocity,
      .max_vibration_n = kMostVibrationN,
      .measures = true,
      .workspace_min_m = smallest,
      .workspace_max_m = largest,
      .contact_point_m =
          glm::dvec3(0.5 * (smallest.x + largest.x), smallest.y + kContactShare * (largest.y - smallest.y),
                     0.5 * (smallest.z + largest.z))};
}

std::uint32_t calibration_style(const HdapiFunctions& hd) {
  std::array<std::int32_t, kRoomForValues> values{};
  hd.get_integers(kCalibrationStyle, values.data());
  const auto styles = static_cast<std::uint32_t>(values[0]);
  if ((styles & kStyleAuto) != 0) return kStyleAuto;
  return (styles & kStyleInkwell) != 0 ? kStyleInkwell : styles;
}

}  // namespace afm::haptics::hdapi
