// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "app/depth_report.h"
#include "app/frame_budget.h"
#include "app/mouse_wand.h"
#include "app/stage_setup.h"
#include "render/depth_meter.h"
#include "render/presenter.h"
#include "render/renderer.h"

namespace afm::app {

struct PictureSettings {
  render::Composition composition{.mode = scene::StereoMode::Mono};
  double ipd_m = 0.063;
  glm::uvec2 eye_px{0};         // as the renderer was made
  bool fixed_eye_size = false;  // else the eyes get as many pixels as the window has for them
  double frame_budget_ms = 0;   // frames are drawn coarser to stay within it; 0: as they are
};

// How the live window shows the wall: for which eyes, in which layout, how large. The main thread alone.
class ViewPicture {
 public:
  // All but the settings must outlive it.
  ViewPicture(const Stage& stage, render::Context& context, render::Window& window, render::Renderer& renderer,
              render::Presenter& presenter, const PictureSettings& settings);

  // Once a frame: the eye images get the pixels that the window has for them, once it has stopped changing.
  void fit(std::int64_t now_ns);

  // The eyes of a head somewhere before the wall; behind it, the picture stays as it was.
  void look_from(const scene::HeadPose& head);

  void swap_eyes();

  // The next mode that this window can show, or the one before.
  enum class Step { Next, Previous };
  void change_mode(Step step);

  // Of the viewer's eyes, within what people have.
  void widen_eyes(double by_m);

  // The picture for setting up the screen, instead of the scene.
  void toggle_calibration();

  // What the next frame is drawn for, and where it will lie in the window.
  WallPicture picture() const;

  // How finely frames are drawn to stay within the budget; nothing without one.
  std::optional<render::DataRow> detail_row() const;

  // Draws and shows a frame, with the depth meter in it; calls `while_waiting` often.
  void show(render::FrameState& frame, std::int64_t now_ns, const std::function<void()>& while_waiting);

 private:
  bool flat() const { return settings_.composition.mode == scene::StereoMode::Mono; }
  void measure_depth(std::int64_t now_ns);

  const Stage& stage_;
  render::Window& window_;
  render::Renderer& renderer_;
  render::Presenter& presenter_;
  PictureSettings settings_;
  scene::HeadPose head_;                // the eyes are drawn for
  std::array<scene::EyeView, 2> eyes_;  // left and right, or twice the middle
  glm::uvec2 eye_size_px_;              // as the renderer draws
  glm::uvec2 window_size_px_{0};
  std::int64_t window_steady_since_ns_ = 0;
  std::optional<FrameBudget> budget_;
  render::DepthMeter depth_meter_;
  DepthReport depth_;
  std::int64_t depth_measured_ns_ = 0;
  std::int64_t depth_logged_ns_ = 0;
  bool calibrating_ = false;
};

}  // namespace afm::app
