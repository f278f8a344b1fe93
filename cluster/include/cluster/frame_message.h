// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "cluster/messages.h"
#include "scene/display/wall.h"
#include "scene/shared/pose.h"

// Inputs of a frame, from which every machine of a wall builds the same frame.
namespace afm::cluster {

// Part of scene::TipState shown on the wall.
struct ShownTip {
  std::int64_t time_ns = 0;
  scene::Tip tip{};
  scene::Swing swing{};
  scene::SurfacePoint surface{};
  double release_z_m = 0;
  double slow_motion = 1;
  std::uint32_t edit_revision = 0;
  std::uint32_t refused_edit = 0;
  std::int32_t material = -1;
  physics::Phase phase = physics::Phase::WaitForLift;
  scene::ServoState servo_state = scene::ServoState::Disarmed;
  std::uint32_t realtime = 0;
};

template <class Visit, scene::RecordOf<ShownTip>... Record>
constexpr void for_each_field(Visit&& visit, Record&... tip) {
  visit("time_ns", tip.time_ns...);
  visit("tip", tip.tip...);
  visit("swing", tip.swing...);
  visit("surface", tip.surface...);
  visit("release_z_m", tip.release_z_m...);
  visit("slow_motion", tip.slow_motion...);
  visit("edit_revision", tip.edit_revision...);
  visit("refused_edit", tip.refused_edit...);
  visit("material", tip.material...);
  visit("phase", tip.phase...);
  visit("servo_state", tip.servo_state...);
  visit("realtime", tip.realtime...);
}
static_assert(scene::all_fields_described<ShownTip>());

// Panels shown in the live window, and the targets pointed at on them.
struct ShownPanels {
  static constexpr std::uint32_t kKeys = 1, kHidden = 2, kKeysKnown = 4, kMarking = 8, kUnattended = 16, kTab = 32,
                                 kControl = 64, kBuilding = 128, kAllFlags = 255;
  static constexpr std::uint32_t kMostRows = 64, kMostTargets = 8192U * 8192U;  // `kMostTargets`: pixels of a map

  std::uint32_t flags = 0;
  std::uint32_t right = 0;   // panel that replaces the sample's data, below kMostRight
  std::uint32_t marked = 0;  // index of the marked row
  std::uint32_t hand = 0;    // hand whose keys are listed, below kMostHands
  std::uint32_t control_kind = 0;
  std::uint32_t control_index = 0;

  static constexpr std::uint32_t kMostRight = 8, kMostHands = 3, kMostControls = 4;
};

template <class Visit, scene::RecordOf<ShownPanels>... Record>
constexpr void for_each_field(Visit&& visit, Record&... panels) {
  visit("flags", panels.flags...);
  visit("right", panels.right...);
  visit("marked", panels.marked...);
  visit("hand", panels.hand...);
  visit("control_kind", panels.control_kind...);
  visit("control_index", panels.control_index...);
}
static_assert(scene::all_fields_described<ShownPanels>());

// Viewer and drawing options of the picture.
struct ShownView {
  static constexpr std::uint32_t kSwapped = 1, kCalibration = 2, kDepth = 4, kHardDepth = 8, kAllFlags = 15;

  scene::Pose head{};
  double ipd_m = 0.063;        // eye distance of the viewer
  double drawn_ipd_m = 0.063;  // eye distance drawn; smaller for comfort
  std::array<double, 2> depth_range_m{};
  std::array<double, 2> nearest{};  // fields of scene::Disparity
  std::array<double, 2> farthest{};
  std::int32_t mode = -1;  // index into scene::kStereoModes; -1: each output's own mode
  std::uint32_t flags = 0;
  std::uint32_t relief = 0;
  std::uint32_t padding = 0;
};

template <class Visit, scene::RecordOf<ShownView>... Record>
constexpr void for_each_field(Visit&& visit, Record&... view) {
  visit("head", view.head...);
  visit("ipd_m", view.ipd_m...);
  visit("drawn_ipd_m", view.drawn_ipd_m...);
  visit("depth_range_m", view.depth_range_m...);
  visit("nearest", view.nearest...);
  visit("farthest", view.farthest...);
  visit("mode", view.mode...);
  visit("flags", view.flags...);
  visit("relief", view.relief...);
  visit("padding", view.padding...);
}
static_assert(scene::all_fields_described<ShownView>());

// Other fields of exhibit::Moment.
struct ShownMoment {
  static constexpr std::uint32_t kMostCenterpieces = 4, kNoCenterpiece = 1;  // kNoCenterpiece: used by films only
  static constexpr double kLongestCueS = 1.5;
  static constexpr std::uint32_t kRetracting = 1, kWand = 2, kWandOriented = 4, kWandPlaced = 8, kWandConnected = 16,
                                 kCue = 32, kBlank = 64, kScan = 128, kTruth = 256, kStopped = 512, kByWand = 1024,
                                 kFalseColours = 2048, kStroboscope = 4096, kParticlesScale = 8192, kAllFlags = 16383;

  std::array<double, 16> navigation{};  // room from room, column by column
  scene::Pose wand{};
  double journey_orders = 0;
  double fade = 0;
  double cue_age_s = 0;
  physics::EventKind cue = physics::EventKind::JumpToContact;
  std::uint32_t centerpiece = 0;
  std::int32_t hovered = -1;
  std::uint32_t wand_buttons = 0;
  std::uint32_t flags = 0;
  std::uint32_t scan_frame = 0;  // frame and pixel of exhibit::ScanProgress
  std::uint32_t scan_pixel = 0;
  float cue_force_n = 0;
};

template <class Visit, scene::RecordOf<ShownMoment>... Record>
constexpr void for_each_field(Visit&& visit, Record&... moment) {
  visit("navigation", moment.navigation...);
  visit("wand", moment.wand...);
  visit("journey_orders", moment.journey_orders...);
  visit("fade", moment.fade...);
  visit("cue_age_s", moment.cue_age_s...);
  visit("cue", moment.cue...);
  visit("centerpiece", moment.centerpiece...);
  visit("hovered", moment.hovered...);
  visit("wand_buttons", moment.wand_buttons...);
  visit("flags", moment.flags...);
  visit("scan_frame", moment.scan_frame...);
  visit("scan_pixel", moment.scan_pixel...);
  visit("cue_force_n", moment.cue_force_n...);
}
static_assert(scene::all_fields_described<ShownMoment>());

// Texts of a frame, one after the other, each terminated by a zero byte. Texts that do not fit are cut, the same on
// every machine.
struct ShownTexts {
  static constexpr std::size_t kBytes = 720;
  std::array<char, kBytes> bytes{};

  std::vector<std::string> list() const;  // texts without the empty ones at the end
  void set(std::span<const std::string> texts);
};

struct FrameMessage {
  ClusterHeader header{};
  std::int64_t sent_ns = 0;   // master's clock
  std::uint64_t journal = 0;  // number of records that precede the frame
  std::uint64_t missing = 0;  // one bit per absent node
  ShownTip tip{};
  ShownMoment moment{};
  ShownView view{};
  ShownPanels panels{};
  ShownTexts texts{};
};
static_assert(std::is_trivially_copyable_v<FrameMessage> && sizeof(FrameMessage) <= kMostDatagramBytes);
static_assert(scene::kMostNodes <= 64);

}  // namespace afm::cluster
