// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/felt_cycles.h"
#include "app/frame_builder.h"
#include "app/key_list.h"
#include "app/live_servo.h"
#include "app/mouse_hand.h"
#include "app/mouse_wand.h"
#include "app/parameter_edits.h"
#include "app/servo_link.h"
#include "app/session_folder.h"
#include "app/session_recorder.h"
#include "app/simulated_person.h"
#include "app/stage_setup.h"
#include "core/clock.h"
#include "render/presenter.h"

namespace afm::app {

enum class StereoMode { Mono, Left, Right, SideBySide };

struct ViewSettings {
  StereoMode stereo = StereoMode::Mono;
  bool swap_eyes = false;
  HandSource hand = HandSource::Mouse;
  glm::uvec2 eye_px{0};         // as the renderer was made
  bool fixed_eye_size = false;  // else the eyes get as many pixels as the window has for them
  double most_frames_per_s = 60.0;
  scene::ScaleMode scale = scene::ScaleMode::Fit;  // M goes on to the next
  std::optional<std::size_t> first_material;       // chosen whenever a servo has been started
  std::string record_folder;                       // for the sessions of what is felt; empty: none is kept
};

// The live window: a person's mouse points, chooses and moves the hand of the servo; every frame shows the newest state
// of the tip. The main thread alone.
class LiveView {
 public:
  using ServoStarter = std::function<core::Result<std::unique_ptr<ServoLink>>()>;

  // All but the settings must outlive it.
  LiveView(const Stage& stage, const std::vector<FeltMaterial>& materials, render::Window& window,
           render::Renderer& renderer, render::Presenter& presenter, ServoStarter start_servo, const core::Clock& clock,
           const ViewSettings& settings);

  // Until the window is closed, Escape, SIGINT or SIGTERM. Fails when the servo cannot be started, and at the end if it
  // has died and was not started again.
  core::Result<void> run();

 private:
  core::Result<void> start_servo();
  void lose_servo(const core::Error& error, std::int64_t now_ns);
  void handle(const render::WindowEvent& event, std::int64_t now_ns);
  void handle_key(render::Key key);
  void click(const glm::dvec2& cursor_px);
  void choose(std::size_t material);
  void next_scale();
  void reset();

  void fit_renderer(std::int64_t now_ns);
  std::uint32_t eyes_beside() const;  // how many eyes stand beside each other in the picture
  WallPicture picture() const;
  double hand_m_per_px() const;
  HandSource hand() const;
  void move_hand(const glm::dvec2& cursor_px, std::int64_t now_ns);
  void take_news(std::int64_t now_ns);
  void keep_session();
  void draw(const glm::dvec2& cursor_px, std::int64_t now_ns);

  // What a ray points at: a target of the open parameter panel, the tab that opens it, or a swatch.
  struct Pointed {
    std::optional<render::ControlTarget> control;
    bool tab = false;
    std::optional<std::size_t> swatch;
    glm::dvec3 point_m{0.0};  // in the room
  };
  Pointed pointed_at(const input::Ray& ray);
  std::optional<std::size_t> material() const;  // the one under the tip
  Moment moment(const Pointed& pointed, std::int64_t now_ns) const;
  void follow_edits();
  void add_parameters(const Pointed& pointed, render::FrameState& frame);
  void arrange_panels(render::FrameState& frame) const;
  void pace(std::int64_t frame_start_ns) const;

  const Stage& stage_;
  render::Window& window_;
  render::Renderer& renderer_;
  render::Presenter& presenter_;
  ServoStarter start_servo_;
  const core::Clock& clock_;
  ViewSettings settings_;
  std::vector<FeltMaterial> felt_;  // as the servo feels them
  FrameBuilder frames_;
  std::vector<input::Target> swatches_;
  std::array<scene::EyeView, 2> eyes_;  // left and right of the stage, or twice the middle
  MouseWand wand_;
  MouseHand hand_;
  SimulatedPerson person_;  // moves the hand with HandSource::Simulated

  std::unique_ptr<ServoLink> servo_;
  std::optional<core::Error> servo_error_;  // the servo has ended
  std::deque<std::int64_t> restarts_ns_;    // of servos that died, within the last minute
  TipStream stream_;
  FeltCycles cycles_;
  ParameterEdits edits_;
  std::optional<SessionFolder> folder_;
  SessionRecorder recorder_;
  scene::ServoState told_state_ = scene::ServoState::Disarmed;
  std::string guidance_;  // as it was told last

  glm::uvec2 eye_size_px_;  // as the renderer draws
  glm::uvec2 window_size_px_{0};
  std::int64_t window_steady_since_ns_ = 0;
  std::int64_t hand_moved_ns_ = 0;
  bool leaving_ = false;
  bool panels_hidden_ = false;
  bool keys_shown_ = false;
  bool parameters_shown_ = false;
};

}  // namespace afm::app
