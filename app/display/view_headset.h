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

// Where the wearer of a headset stands: on the room's floor below the wall's sweet spot, looking at the screen.
scene::HeadPose room_from_headset_floor(const scene::Wall& wall, const scene::Screen& screen);

// An eye as it is drawn, and the rectangle at the wall's distance that fills its picture.
struct MirroredEye {
  std::array<scene::EyeView, 2> eyes;
  scene::Screen screen;
};

// The headset of the live view: its frames, its controller as a wand, and whether its wearer sees anything. Main thread
// only.
class ViewHeadset {
 public:
  // All must outlive it.
  static core::Result<std::unique_ptr<ViewHeadset>> begin(const exhibit::Stage& stage, render::HeadsetRuntime& runtime,
                                                          render::Context& context, render::Renderer& renderer,
                                                          const core::Clock& clock);

  // Once a loop, before the frame is built: waits for the runtime's next frame. Logs what has happened.
  void follow(const std::function<void()>& while_waiting);

  // The runtime has asked for a frame in this turn, which is drawn for locate_eyes() and then shown.
  bool wants_picture() const { return turn_ == render::Headset::Turn::Frame; }
  // The eyes of that frame; where they are lost, or none is wanted, both eyes of somebody at the sweet spot.
  MirroredEye locate_eyes(const std::function<void()>& while_waiting);
  // As FrameState::panels_apart, of that frame.
  std::size_t panels_apart() const { return wants_picture() ? headset_->most_panels() : 0; }
  void show();

  // Nobody sees the picture, or it stands still: the hand must be free. At once where the headset is off, lost or
  // frozen; where its runtime hides the picture, has lost the eyes or lends no image, or the graphics device hangs,
  // once that has lasted for as long as a picture may stand still. A slow picture is seen.
  bool blind(std::int64_t now_ns) const;

  // Of this turn, for the frame log: shown, hidden, frozen, off; and of what is shown, Headset::pose_age_ns().
  const char* turn_word() const;
  std::optional<double> pose_age_s() const;

  // The controller, as every other wand; none while the headset has none.
  std::optional<input::WandState> wand(std::int64_t now_ns) const;

  // Between the eyes, as they were located last.
  const scene::HeadPose& head() const { return head_; }

  void pulse() { headset_->pulse(); }

 private:
  ViewHeadset(const exhibit::Stage& stage, const render::HeadsetRuntime& runtime, const core::Clock& clock);
  void log_messages();
  void log_turn(render::Headset::Turn before) const;
  void note_unseen();

  const core::Clock& clock_;
  double wall_m_;  // how far away the screen is from the sweet spot
  scene::HeadPose room_from_floor_;
  scene::HeadPose head_;
  MirroredEye resting_;
  std::unique_ptr<render::Headset> headset_;
  render::Headset::Turn turn_ = render::Headset::Turn::Off;
  std::optional<std::int64_t> unseen_since_ns_ = 0;  // when the last picture was drawn for nobody; none: it is seen
  PictureAge picture_age_;
};

}  // namespace afm::app
