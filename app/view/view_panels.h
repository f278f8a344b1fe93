// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/view/key_list.h"
#include "app/view/parameter_edits.h"
#include "app/view/pointed.h"
#include "input/selection.h"
#include "input/wand.h"
#include "render/frame.h"
#include "scene/shared/tip_blocks.h"

namespace afm::cluster {
struct ShownPanels;
}
namespace afm::curves {
class CurveMap;
struct MapCurve;
}  // namespace afm::curves
namespace afm::exhibit {
enum class Centerpiece;
enum class MapQuantity;
class FrictionHistory;
class LiveScan;
struct Moment;
struct Stage;
class SwingDial;
class WallScene;
}  // namespace afm::exhibit

namespace afm::app {

// Panel to the right of the sample; Sources: the data with their sources and reasons.
enum class RightPanel { Data, Parameters, FrictionLoop, Sources };

// Visible panels of the live window, and the parameters edited in one of them. One thread.
class ViewPanels {
 public:
  // `wall_scene` must outlive the object; `materials` are those with which the servo was started; `key_list` fills the
  // panel of F1.
  ViewPanels(const exhibit::WallScene& wall_scene, const std::vector<curves::SampleModel>& materials, KeyList key_list);

  void toggle_keys() {
    keys_shown_ = !keys_shown_;
    keys_known_ = true;
  }
  // Returns whether the list of keys was shown.
  bool close_keys() { return std::exchange(keys_shown_, false); }
  void toggle_parameters() { toggle(RightPanel::Parameters); }
  // Returns whether the panel is now visible.
  bool toggle_friction_loop() { return toggle(RightPanel::FrictionLoop); }
  // Toggles the sources of the numbers, and the reasons for them, below each; logs whether they are shown.
  void toggle_sources();
  // Replaces the parameters by the settings of a scan; null: restores them. The scan must outlive the object.
  void set_scan(exhibit::LiveScan* scan) { scan_ = scan; }

  // Sets the name of the graphics device, for a note of the parameters; initially empty: no note.
  void set_drawn_by(std::string device) { drawn_by_ = std::move(device); }

  // Friction history for the loop's panel; must outlive the object.
  void set_friction(const exhibit::FrictionHistory* friction) { friction_ = friction; }

  // Marks the next row for the keys, or changes the marked row by steps. Both open the panel. `material` is the one
  // under the tip.
  void mark_next(std::size_t material);
  void step_marked(int steps, std::size_t material, servo::ServoClient* servo);

  // Shows the next quantity of the force map in its picture; logs the reason if there is none.
  void next_map_picture();
  // Picture of a pixel's map, with the pixel marked and the quantity shown.
  const render::MapPicture& picture_of(const curves::MapCurve& pixel);
  // Shows a quantity in that picture, as recorded in a session.
  void show_map_quantity(const curves::MapCurve& pixel, exhibit::MapQuantity quantity);
  exhibit::MapQuantity map_quantity() const { return quantity_; }

  void toggle_all() { hidden_ = !hidden_; }

  // In a lesson, hides the parameters and the tab that opens them.
  void use_for(WallUse use) { use_ = use; }

  // Removes the staff keys from the list of keys.
  void show_visitors_keys_only() { unattended_ = true; }

  // Name of the topmost panel: "keys", "none", "parameters", "friction-loop", "sources" or "samples".
  std::string shown() const;
  void show(std::string_view panels);

  // `wall_point_m` is the intersection of the ray with the wall's plane. `material` is the one under the tip.
  Pointed pointed_at(const input::Ray& ray, const glm::dvec3& wall_point_m, std::optional<std::size_t> material);

  // Handles a press on a panel or its tab. Sends a change to the servo, if it is not null.
  void press(const Pointed& pointed, std::size_t material, servo::ServoClient* servo);

  // Call once a frame: takes and logs the changed parameters that have been built (ParameterEdits::take_built()).
  void take_built(servo::ServoClient& servo);

  ParameterEdits& edits() { return edits_; }

  // State of the panels for the other machines of a wall, and its counterpart there. `pointed` and `hand` as in
  // add_to().
  cluster::ShownPanels told(const Pointed& pointed, HandSource hand) const;
  struct Told {
    Pointed pointed;
    HandSource hand = HandSource::Mouse;
  };
  Told follow(const cluster::ShownPanels& panels);

  // Adds a short note below the left panel, unless the panels are hidden: the caption of the sound; without a caption,
  // a hint on how to leave the current view and, until F1 was used, how to list the keys.
  void add_note(render::FrameState& frame, exhibit::Centerpiece centerpiece, const std::string& caption) const;

  // Adds the current panels to a frame: the parameters or the tab that opens them, the curve computed from changed
  // parameters, and the keys. Removes hidden panels. `letters` as in KeyList.
  void add_to(render::FrameState& frame, const Pointed& pointed, std::optional<std::size_t> material,
              const std::string& material_title, const scene::TipState& tip, HandSource hand,
              std::string_view letters = {});

 private:
  bool toggle(RightPanel panel) {
    right_ = right_ == panel ? RightPanel::Data : panel;
    return right_ == panel;
  }
  // True if only the banner, and perhaps the list of keys, is shown.
  bool covered() const { return hidden_ || keys_shown_; }
  const exhibit::Phrases& phrases() const;
  render::ControlPanel control_panel(std::size_t material, const std::string& title, exhibit::ChangeState state);
  void change(const render::ControlTarget& target, std::size_t material, servo::ServoClient* servo);
  void add_parameters(render::FrameState& frame, const Pointed& pointed, std::size_t material);
  void add_right(render::FramePanels& panels, const Pointed& pointed, std::size_t material,
                 const std::string& material_title, const scene::TipState& tip);
  render::PanelPlacement right_place() const;  // place of the panel that replaces the data, or is beside them
  template <class Content>
  void show_right(render::FramePanels& panels, render::PanelSlot<Content>& slot, Content content) const;
  template <class Copy, class Panels, class Shown>
  static void copy_state(const Copy& copy, Panels& panels, Shown& shown);

  const exhibit::WallScene& wall_scene_;
  std::vector<input::Target> swatches_;
  ParameterEdits edits_;
  KeyList key_list_;
  exhibit::LiveScan* scan_ = nullptr;
  const exhibit::FrictionHistory* friction_ = nullptr;
  std::shared_ptr<exhibit::SwingDial> dial_;  // never null
  std::string drawn_by_;
  std::shared_ptr<const curves::CurveMap> pictured_;  // map in picture_; null: none yet
  exhibit::MapQuantity quantity_{};                   // quantity in picture_
  render::MapPicture picture_;
  std::size_t marked_ = 0;
  bool marking_ = false;  // true: row marked by a key
  bool hidden_ = false;
  bool keys_shown_ = false;
  bool unattended_ = false;
  bool keys_known_ = false;
  WallUse use_ = WallUse::Free;
  RightPanel right_ = RightPanel::Data;
};

// Inputs for a frame's panels in addition to its Moment.
struct Panelled {
  Pointed pointed;
  HandSource hand = HandSource::Mouse;
  scene::TipState tip{};
};

// Adds all panels, and the note with the caption, as on every machine of a wall.
void add_panels(const exhibit::Stage& stage, ViewPanels& panels, const exhibit::Moment& moment,
                const Panelled& panelled, const std::string& caption, render::FrameState& frame);

}  // namespace afm::app
