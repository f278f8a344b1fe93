// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace afm::servo {

// Pose in the room frame, metres, right-handed, +y up.
struct RecordedPose {
  std::array<double, 3> position_m{};
  std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};  // unit quaternion, w x y z: room from body

  bool operator==(const RecordedPose&) const = default;
};

struct RecordedWand {
  RecordedPose pose;
  bool orientation_valid = false;  // as in input::WandState
  bool position_valid = false;
  bool connected = false;
  std::uint32_t buttons = 0;

  bool operator==(const RecordedWand&) const = default;
};

// Settings of a scan from one pixel on. SI.
struct RecordedScanChange {
  std::uint32_t frame = 0;
  std::uint32_t pixel = 0;
  double setpoint_n = 0;
  double gain_per_s = 0;
  double line_rate_hz = 0;
  double tip_radius_m = 0;
  double noise_m = 0;
  double drift_m_per_s = 0;
  double apex_distance_m = 0;

  bool operator==(const RecordedScanChange&) const = default;
};

// Scan on display; together with its changes it determines the images.
struct RecordedScan {
  std::uint32_t frame = 0;
  std::uint32_t pixel = 0;
  bool truth = false;

  bool operator==(const RecordedScan&) const = default;
};

// Hand's part in that scan. SI.
struct RecordedHandPart {
  bool paints = false;
  bool feedback = false;
  double side_m = 0;
  std::uint64_t first_tick = 0;

  bool operator==(const RecordedHandPart&) const = default;
};

// State of the wall in one frame. Together with the servo's tick at the same time, it determines the picture. Names are
// those of the files and the command line; empty: none.
struct WallFrame {
  std::int64_t time_ns = 0;                   // CLOCK_MONOTONIC, time of the drawn tip state
  std::array<double, 16> room_from_sample{};  // as in SceneTransforms: sent to the servo with this frame
  std::array<double, 16> navigation{};        // displacement of the scene, room from room, column by column
  std::string centerpiece{};                  // "instrument", "analogy" or "journey"
  double journey_orders = 0;                  // 0 to 9
  double fade = 0;                            // 0 to 1
  std::string hovered{};                      // material under the wand or mouse
  std::optional<RecordedWand> wand{};
  RecordedPose head{};  // viewer of the drawn picture
  double ipd_m = 0;
  std::string stereo{};  // stereo mode: "anaglyph-red-cyan"
  bool eyes_swapped = false;
  std::string panels{};  // "samples", "parameters", "friction-loop", "keys" or "none"
  std::string guidance{};
  bool retracting = false;
  double release_z_m = 0;                               // as in ActiveContact
  std::vector<std::array<std::string, 3>> servo_row{};  // name, value, source
  std::optional<RecordedScan> scan{};
  std::vector<RecordedScanChange> scan_changes{};  // changes of `scan`
  std::optional<RecordedHandPart> scan_hand{};

  bool operator==(const WallFrame&) const = default;
};

// Curve of a material that was on the wall when a session began.
struct EarlierCurve {
  std::string material{};
  std::vector<std::array<double, 2>> points{};  // Z in nm, force in nN

  bool operator==(const EarlierCurve&) const = default;
};

// Array with one object per frame, which contains only the differences from the previous frame. `last` is the frame
// before the first one, and afterwards the last one.
nlohmann::json json_of(std::span<const WallFrame> frames, nlohmann::json& last);

// Throws nlohmann::json::exception if a key is missing, of the wrong type or not finite.
std::vector<WallFrame> frames_of(const nlohmann::json& json, nlohmann::json& last);

nlohmann::json json_of(const std::vector<EarlierCurve>& curves);
std::vector<EarlierCurve> curves_of(const nlohmann::json& json);

}  // namespace afm::servo
