// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/wand_options.h"
#include "core/clock.h"
#include "core/result.h"
#include "input/dtrack_source.h"
#include "input/navigation.h"
#include "input/selection.h"
#include "input/simulated_head.h"
#include "input/simulated_wand.h"
#include "input/tracker_report.h"
#include "input/wand_file.h"
#include "input/wand_source.h"

namespace afm::core {
class Clock;
}
namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

// Validated values of the options.
struct WandChoice {
  enum class Source { Auto, Hid, Dtrack, Simulated, Mouse };
  Source source = Source::Auto;
  std::string hid_name{};                   // node, numbers or part of the name of the wand; empty: any
  input::WandFile file;                     // mapping, hand and tracker of the wand file
  bool has_tracker_file = false;            // true: tracker's frame in the room given by the file
  std::optional<std::uint32_t> head_body;   // number of the tracker's body
  std::vector<input::HeadKey> head_script;  // motion of a simulated head, used without a tracked one; may be empty
};

core::Result<WandChoice> parse_wand_choice(const WandOptions& options);

// The wand of the live window: its source, its target, and the transform of the scene. Main thread only; a separate
// thread reads the devices.
class ViewWand {
 public:
  // The stage and the clock must outlive the object. `assets_dir` holds the folder wands. Without a usable HID library
  // and with Source::Auto, only the mouse is used, and the log says so.
  static core::Result<std::unique_ptr<ViewWand>> open(const WandChoice& choice, const exhibit::Stage& stage,
                                                      const std::string& assets_dir, const core::Clock& clock);

  // Call once a frame. `eye_m` is the point between the eyes, room frame.
  void update(std::int64_t now_ns, const scene::TipState& tip, const glm::dvec3& eye_m);

  // Uses a headset's controller as the wand; empty: no controller.
  void hold(const std::optional<input::WandState>& controller) { controller_ = controller; }

  // True if a wand points; used_ns() is the time of its last motion or press. Wand and mouse take turns.
  bool points() const { return wand_.connected && wand_.orientation_valid; }
  std::int64_t used_ns() const { return used_ns_; }
  const input::WandState& state() const { return wand_; }

  // Target that the ray has snapped to, and the buttons pressed since the previous frame.
  std::optional<std::size_t> hovered() const { return pointing_.hovered; }
  bool select_pressed() const { return select_pressed_; }
  bool stop_pressed() const { return stop_pressed_; }  // true: pressed since the previous frame

  glm::dmat4 navigation() const { return navigation_.room_from_scene(); }
  void home() { navigation_.home(); }

  // Tracked head in the room and the time of its data; empty without a tracker or before its first data.
  struct Head {
    scene::HeadPose pose;
    std::int64_t time_ns = 0;
  };
  std::optional<Head> head() const;

  bool tracks_head() const { return dtrack_ != nullptr && head_body_.has_value(); }

  // Logs the tracker's losses over the whole run if there is a tracker.
  void log_losses() const;

 private:
  ViewWand(const exhibit::Stage& stage, const glm::dvec3& grip_m);

  core::Result<void> open_hid(const WandChoice& choice, const std::string& assets_dir, const input::HandPlace& place,
                              const core::Clock& clock);
  core::Result<void> open_dtrack(const WandChoice& choice, const core::Clock& clock);
  void aim_simulated(std::int64_t now_ns);

  std::vector<input::Target> swatches_;
  input::Selector selector_;
  input::Selector::Result pointing_;
  input::Navigation navigation_;
  input::WandState wand_;
  std::optional<input::WandState> controller_;
  bool select_pressed_ = false;
  bool stop_pressed_ = false;
  bool was_locked_ = false;
  bool was_moved_ = false;
  std::int64_t updated_ns_ = 0;
  std::int64_t used_ns_ = 0;
  glm::dvec3 used_direction_{0.0};  // direction of the ray at used_ns_

  input::DtrackSettings tracker_;
  std::optional<std::uint32_t> head_body_;
  const input::DtrackSource* dtrack_ = nullptr;  // owned by one of the threads below
  std::optional<input::TrackerReport> tracker_report_;
  std::unique_ptr<input::WandThread> wand_thread_;
  std::unique_ptr<input::WandThread> head_thread_;  // thread of a tracker used only for the head
  std::optional<input::SimulatedWand> simulated_;
  std::size_t simulated_target_ = 0;
  std::int64_t simulated_next_ns_ = 0;
};

}  // namespace afm::app
