// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "app/display/picture_age.h"
#include "core/clock.h"
#include "input/wand.h"
#include "render/headset.h"
#include "scene/display/wall.h"

namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

// Origin of the headset's floor in the room: below the wall's sweet spot, facing the screen.
scene::HeadPose room_from_headset_floor(const scene::Wall& wall, const scene::Screen& screen);

// An eye's view and the rectangle at the wall's distance that fills its picture.
struct MirroredEye {
  std::array<scene::EyeView, 2> eyes;
  scene::Screen screen;
};

// The live view's headset: its frames, its controller as a wand, and whether its wearer sees the picture. Main thread
// only.
class ViewHeadset {
 public:
  // All arguments must outlive the object.
  static core::Result<std::unique_ptr<ViewHeadset>> begin(const exhibit::Stage& stage, render::HeadsetRuntime& runtime,
                                                          render::Context& context, render::Renderer& renderer,
                                                          const core::Clock& clock);

  // Call once a loop, before building the frame: waits for the runtime's next frame and logs events.
  void follow(const std::function<void()>& while_waiting);

  // True if the runtime requests a frame in this turn: draw it for locate_eyes(), then show it.
  bool wants_picture() const { return turn_ == render::Headset::Turn::Frame; }
  // Eyes for the requested frame. If tracking is lost or no frame is requested: both eyes of a viewer at the sweet
  // spot.
  MirroredEye locate_eyes(const std::function<void()>& while_waiting);
  // Value of FrameState::panels_apart for the requested frame.
  std::size_t panels_apart() const { return wants_picture() ? headset_->most_panels() : 0; }
  void show();

  // True if the hand must be free because nobody sees the picture, or it is frozen. True at once if the headset
  // is off, lost or frozen; after the time that a picture may be frozen if the runtime hides the picture, has lost
  // the eyes or provides no image, or the graphics device hangs. A slow picture counts as seen.
  bool blind(std::int64_t now_ns) const;

  // For the frame log: the state in this turn (shown, hidden, frozen, off), and Headset::pose_age_ns() of the shown
  // frame.
  const char* turn_word() const;
  std::optional<double> pose_age_s() const;

  // Controller as a wand; empty if it is not connected.
  std::optional<input::WandState> wand(std::int64_t now_ns) const;

  // Pose between the eyes at their newest location.
  const scene::HeadPose& head() const { return head_; }

  void pulse() { headset_->pulse(); }

 private:
  ViewHeadset(const exhibit::Stage& stage, const render::HeadsetRuntime& runtime, const core::Clock& clock);
  void log_messages();
  void log_turn(render::Headset::Turn before) const;
  void note_unseen();

  const core::Clock& clock_;
  double wall_m_;  // distance from the sweet spot to the screen
  scene::HeadPose room_from_floor_;
  scene::HeadPose head_;
  MirroredEye resting_;
  std::unique_ptr<render::Headset> headset_;
  render::Headset::Turn turn_ = render::Headset::Turn::Off;
  std::optional<std::int64_t> unseen_since_ns_ = 0;  // beginning of blindness; empty while the picture is seen
  PictureAge picture_age_;
};

}  // namespace afm::app
