// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/shared/field_visitor.h"
#include "scene/shared/pose.h"

namespace afm::servo {

struct RecordedWand {
  scene::Pose pose;
  bool orientation_valid = false;  // true: the orientation is valid, as in input::WandState
  bool position_valid = false;
  bool connected = false;
  std::uint32_t buttons = 0;

  bool operator==(const RecordedWand&) const = default;
};

template <class Visit, scene::RecordOf<RecordedWand>... Record>
constexpr void for_each_field(Visit&& visit, Record&... wand) {
  visit("pose", wand.pose...);
  visit("orientation_valid", wand.orientation_valid...);
  visit("position_valid", wand.position_valid...);
  visit("connected", wand.connected...);
  visit("buttons", wand.buttons...);
}
static_assert(scene::all_fields_described<RecordedWand>());

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
  std::optional<double> free_amplitude_m{};  // only for a tapping lever; absent from older files
  std::optional<double> drive_hz{};          // only for a tapping lever; absent from older files

  bool operator==(const RecordedScanChange&) const = default;
};

template <class Visit, scene::RecordOf<RecordedScanChange>... Record>
constexpr void for_each_field(Visit&& visit, Record&... change) {
  visit("frame", change.frame...);
  visit("pixel", change.pixel...);
  visit("setpoint_N", change.setpoint_n...);
  visit("gain_per_s", change.gain_per_s...);
  visit("line_rate_Hz", change.line_rate_hz...);
  visit("tip_radius_m", change.tip_radius_m...);
  visit("noise_m", change.noise_m...);
  visit("drift_m_per_s", change.drift_m_per_s...);
  visit("apex_distance_m", change.apex_distance_m...);
  visit("free_amplitude_m", change.free_amplitude_m...);
  visit("drive_Hz", change.drive_hz...);
}
static_assert(scene::all_fields_described<RecordedScanChange>());

// Scan on display; together with its changes it determines the images.
struct RecordedScan {
  std::uint32_t frame = 0;
  std::uint32_t pixel = 0;
  bool truth = false;

  bool operator==(const RecordedScan&) const = default;
};

template <class Visit, scene::RecordOf<RecordedScan>... Record>
constexpr void for_each_field(Visit&& visit, Record&... scan) {
  visit("frame", scan.frame...);
  visit("pixel", scan.pixel...);
  visit("truth", scan.truth...);
}
static_assert(scene::all_fields_described<RecordedScan>());

// Hand's part in that scan. SI.
struct RecordedHandPart {
  bool paints = false;
  bool feedback = false;
  double side_m = 0;
  std::uint64_t first_tick = 0;

  bool operator==(const RecordedHandPart&) const = default;
};

template <class Visit, scene::RecordOf<RecordedHandPart>... Record>
constexpr void for_each_field(Visit&& visit, Record&... part) {
  visit("paints", part.paints...);
  visit("feedback", part.feedback...);
  visit("side_m", part.side_m...);
  visit("first_tick", part.first_tick...);
}
static_assert(scene::all_fields_described<RecordedHandPart>());

// A map that is felt whole, and the visible part of its curves. SI.
struct RecordedMapView {
  std::string quantity{};  // quantity of the map's picture: "modulus"
  bool slice = false;
  std::optional<double> equal_force_n{};  // force of the surface of equal force; empty: no surface
  double reduced_modulus_pa = 0;          // modulus of the law below the tip, as in scene::LawHere
  double adhesion_j_per_m2 = 0;

  bool operator==(const RecordedMapView&) const = default;
};

template <class Visit, scene::RecordOf<RecordedMapView>... Record>
constexpr void for_each_field(Visit&& visit, Record&... map) {
  visit("quantity", map.quantity...);
  visit("slice", map.slice...);
  visit("equal_force_N", map.equal_force_n...);
  visit("reduced_modulus_Pa", map.reduced_modulus_pa...);
  visit("adhesion_J_per_m2", map.adhesion_j_per_m2...);
}
static_assert(scene::all_fields_described<RecordedMapView>());

// Lines that a lesson has a person write on the sample, in the sample's frame. SI.
struct RecordedLines {
  std::vector<std::vector<std::array<double, 2>>> lines_m{};  // corners of each line in order
  double width_m = 0;

  bool operator==(const RecordedLines&) const = default;
};

template <class Visit, scene::RecordOf<RecordedLines>... Record>
constexpr void for_each_field(Visit&& visit, Record&... lines) {
  visit("lines_m", lines.lines_m...);
  visit("width_m", lines.width_m...);
}
static_assert(scene::all_fields_described<RecordedLines>());

// State of the wall in one frame. Together with the servo's tick at the same time, it determines the picture. Names are
// those of the files and the command line; empty: none.
struct WallFrame {
  std::int64_t time_ns = 0;                   // time of the drawn tip state, CLOCK_MONOTONIC
  std::array<double, 16> room_from_sample{};  // transform sent to the servo with this frame, as in SceneTransforms
  std::array<double, 16> navigation{};        // displacement of the scene, room from room, column-major
  std::string centerpiece{};                  // centre of the wall: "instrument", "analogy" or "journey"
  double journey_orders = 0;                  // position in the journey, 0 to 9
  double fade = 0;                            // opacity of the fade, 0 to 1
  std::string hovered{};                      // name of the material under the wand or mouse
  std::optional<RecordedWand> wand{};
  scene::Pose head{};  // pose of the viewer for whom the picture was drawn
  double ipd_m = 0;
  std::string stereo{};  // name of the stereo mode: "anaglyph-red-cyan"
  bool eyes_swapped = false;
  std::string panels{};  // panels shown: "samples", "parameters", "friction-loop", "sources", "keys" or "none"
  std::string guidance{};
  bool retracting = false;
  double release_z_m = 0;                               // height of release, as in ActiveContact
  std::vector<std::array<std::string, 3>> servo_row{};  // rows of name, value, source
  std::optional<RecordedScan> scan{};
  std::vector<RecordedScanChange> scan_changes{};  // changes of the scan's settings
  std::optional<RecordedHandPart> scan_hand{};
  std::optional<bool> false_colours{};   // true: heights in false colours; absent from older files
  std::optional<bool> stroboscope{};     // true: slowed-down swing of a tapping lever; absent from older files
  std::optional<RecordedMapView> map{};  // map that is felt whole below the tip; absent from older files
  std::optional<RecordedLines> lines{};  // lines to be written; absent from older files

  bool operator==(const WallFrame&) const = default;
};

template <class Visit, scene::RecordOf<WallFrame>... Record>
constexpr void for_each_field(Visit&& visit, Record&... frame) {
  visit("time_ns", frame.time_ns...);
  visit("room_from_sample", frame.room_from_sample...);
  visit("navigation", frame.navigation...);
  visit("centerpiece", frame.centerpiece...);
  visit("journey_orders", frame.journey_orders...);
  visit("fade", frame.fade...);
  visit("hovered", frame.hovered...);
  visit("wand", frame.wand...);
  visit("head", frame.head...);
  visit("ipd_m", frame.ipd_m...);
  visit("stereo", frame.stereo...);
  visit("eyes_swapped", frame.eyes_swapped...);
  visit("panels", frame.panels...);
  visit("guidance", frame.guidance...);
  visit("retracting", frame.retracting...);
  visit("release_z_m", frame.release_z_m...);
  visit("servo_row", frame.servo_row...);
  visit("scan", frame.scan...);
  visit("scan_changes", frame.scan_changes...);
  visit("scan_hand", frame.scan_hand...);
  visit("false_colours", frame.false_colours...);
  visit("stroboscope", frame.stroboscope...);
  visit("map", frame.map...);
  visit("lines", frame.lines...);
}
static_assert(scene::all_fields_described<WallFrame>());

// Curve of a material that was on the wall when a session began.
struct EarlierCurve {
  std::string material{};
  std::vector<std::array<double, 2>> points{};  // points with Z in nm and force in nN

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
