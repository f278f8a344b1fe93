// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

// Common interface of HID wands: report bytes in, motion and buttons out.
namespace afm::input {

using Bytes = std::span<const std::uint8_t>;

inline constexpr double kRadPerDegree = std::numbers::pi / 180.0;

// Little-endian numbers; `at` must lie within the bytes.
constexpr std::uint16_t unsigned16(Bytes bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] | (bytes[at + 1] << 8));
}
constexpr std::int16_t signed16(Bytes bytes, std::size_t at) {
  return static_cast<std::int16_t>(unsigned16(bytes, at));
}
constexpr std::array<std::int16_t, 3> signed16_triple(Bytes bytes, std::size_t at) {
  return {signed16(bytes, at), signed16(bytes, at + 2), signed16(bytes, at + 4)};
}
constexpr std::uint32_t unsigned32(Bytes bytes, std::size_t at) {
  return unsigned16(bytes, at) | (static_cast<std::uint32_t>(unsigned16(bytes, at + 2)) << 16);
}

// One reading of gyroscope and accelerometer in the wand's frame: x to the right, y out of its upper side, z towards
// the hand, so that it points along -z. A wand at rest reads +1 g upwards.
struct ImuSample {
  glm::dvec3 rate_rad_per_s{0.0};
  glm::dvec3 acceleration_g{0.0};
};

// Contents of one report; an empty member means no change. `push` and `turn` as in WandState.
struct HidInput {
  std::optional<glm::dvec3> push;
  std::optional<glm::dvec3> turn;
  std::optional<std::uint32_t> buttons;  // bits of WandButton
  std::array<ImuSample, 3> imu;
  std::size_t imu_count = 0;                   // number of samples, evenly spaced since the previous report
  bool has_gyro = true;                        // true: imu samples include the gyroscope
  std::optional<double> yaw_from_forward_rad;  // heading from a wand that sees a beacon straight ahead
};

// Feature report to request from a device after opening it, `times` times.
struct FeatureRequest {
  std::uint8_t id = 0;
  std::size_t size = 0;
  int times = 1;
};

// Protocol of one device. Accepts any bytes, and either interprets or rejects them. One thread.
class HidDriver {
 public:
  HidDriver() = default;
  HidDriver(const HidDriver&) = delete;
  HidDriver& operator=(const HidDriver&) = delete;
  virtual ~HidDriver() = default;

  // Interprets a report. Empty: not a report of this device, or damaged.
  virtual std::optional<HidInput> read(Bytes report) = 0;

  // True if the cap or the stick steers the ray; otherwise the wand points in its own direction.
  virtual bool steered() const { return false; }

  // Output reports that make the device send reports for read().
  virtual std::vector<std::vector<std::uint8_t>> set_up() const { return {}; }

  // Output reports in response to the last report read. Returned once.
  virtual std::vector<std::vector<std::uint8_t>> take_answers() { return {}; }

  // Calibration stored in the device, if any; if it is implausible, nominal numbers are used.
  virtual std::optional<FeatureRequest> calibration() const { return std::nullopt; }
  virtual void calibrate(std::span<const std::vector<std::uint8_t>> reports) { static_cast<void>(reports); }
};

}  // namespace afm::input
