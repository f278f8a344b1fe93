// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "app/view/pointed.h"
#include "app/view/view_parts.h"
#include "curves/sample_model.h"
#include "input/wand.h"
#include "scene/shared/particle_blocks.h"
#include "scene/shared/scale_modes.h"

namespace afm::app {

class ViewGuide;

// A person's choices in the live window: the sample under the tip, its scale and settings, and the presence of a
// force. Main thread only.
class ViewChoice {
 public:
  struct Settings {
    scene::ScaleMode scale = scene::ScaleMode::Fit;
    std::optional<std::size_t> first_material;  // material selected whenever a servo starts
  };

  // `parts` must outlive the object; `materials` are those with which the servo was started.
  ViewChoice(ViewParts& parts, const std::vector<curves::SampleModel>& materials, const Settings& settings);

  // Samples as the servo renders them.
  const std::vector<curves::SampleModel>& felt() const { return felt_; }

  // Sends changed parameters that have been built, applies those that the servo uses to felt(), and keeps the force of
  // a tapping lever off until the servo has its new law. Call once a frame.
  void follow_edits(std::int64_t now_ns);

  // The guide takes a person's answers first; it must outlive the object.
  void set_guide(ViewGuide& guide) { guide_ = &guide; }
  bool guided() const { return guide_ != nullptr; }
  std::string spoken(const std::string& line) const;  // speech for this line of guidance

  void choose(std::size_t material);
  void choose_first(std::optional<std::size_t> chosen_before);
  void number(std::size_t number);  // handles keys 1 to 9; `number` counts from 0
  void press(const Pointed& pointed, const input::Ray& ray);
  void enter();

  // Function that receives a press beside panels and swatches first; returns true if it has used it.
  using PressOnSample = std::function<bool(const input::Ray& ray)>;
  void set_press_on_sample(PressOnSample press) { press_on_sample_ = std::move(press); }

  void next_scale();

  // Settings among particles for every servo from now on; they take effect like another sample.
  void choose_settings(const scene::PushSettings& settings);
  const scene::PushSettings& settings() const { return settings_; }

  void mark_next_setting();
  void step_setting(int steps);
  void toggle_friction_loop();

  // Makes the servo cut the force now.
  void stop_force();

  // Removes the force: the hand must lift and press Turn-On again.
  void take_force_away(std::int64_t now_ns);

  // Same, whenever there is a force. Call once a frame.
  void keep_force_away(std::int64_t now_ns);

 private:
  void choose_again();

  ViewParts& parts_;
  std::vector<curves::SampleModel> felt_;
  scene::ScaleMode scale_;
  scene::PushSettings settings_{};
  std::optional<std::size_t> first_material_;
  ViewGuide* guide_ = nullptr;
  PressOnSample press_on_sample_;    // unset: no such function
  std::int64_t force_taken_ns_ = 0;  // time of the newest take_force_away()
};

}  // namespace afm::app
