// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/display/frame_times.h"
#include "app/display/mouse_wand.h"
#include "app/display/view_outputs.h"
#include "app/display/view_windows.h"
#include "app/options/dynamic_resolution.h"
#include "exhibit/frame/comfort_clamp.h"
#include "exhibit/panels/depth_report.h"
#include "render/depth_meter.h"
#include "render/presenter.h"
#include "render/renderer.h"
#include "render/screenshot_queue.h"

namespace afm::cluster {
struct ShownView;
}
namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

class ViewHeadset;

struct PictureSettings {
  double ipd_m = 0.063;
  glm::uvec2 eye_px{0};                                  // size with which the renderer was created
  bool fixed_eye_size = false;                           // true: size never adapted to the windows
  double comfort_rad = scene::kComfortableDisparityRad;  // largest deviation of the convergence from that for the wall
  double frame_budget_ms = 0;                            // time per frame, kept by lower resolution; 0: no limit
  std::string saved_folder = ".";                        // folder for saved pictures
  ViewHeadset* headset = nullptr;                        // mirrored in the window (left eye); not owned, may be null
};

// Picture of the wall in the live windows: eyes, layout and size. Main thread only.
class ViewPicture {
 public:
  // All arguments except the settings must outlive the object. `outputs` has one entry per window.
  ViewPicture(const exhibit::Stage& stage, const std::vector<ViewOutput>& outputs, render::Context& context,
              const ViewWindows& windows, render::Renderer& renderer, render::Presenter& presenter,
              const PictureSettings& settings);

  // Call once a frame. Gives the eye images as many pixels as the windows can show, once their size is stable, and sets
  // the eye distance at which the newest measured depth is comfortable.
  void fit(std::int64_t now_ns);

  // Sets the eyes of a head anywhere in front of the wall. A screen keeps its picture if the head is behind it. A
  // headset overrides these eyes with its own.
  void look_from(const scene::HeadPose& head);

  void swap_eyes();

  // Direction through the modes that these windows can show.
  enum class Step { Next, Previous };
  void change_mode(Step step);

  // Changes the viewer's eye distance within the human range.
  void widen_eyes(double by_m);

  // Switches between the calibration picture and the scene.
  void toggle_calibration();

  // Saves the next frame of the first window as a new PNG file without delaying the rendering.
  void save();

  // Call instead of show() while the windows are invisible.
  void rest() { times_.hidden(); }

  // Time since which no window has accepted a picture, because the display has no use for one; none while one does.
  std::optional<std::int64_t> refused_since_ns() const { return refused_since_ns_; }

  // Waits for the last screenshots; logs them and the frame times.
  void finish();

  // Projection and area of the next frame in a window.
  WallPicture picture(std::size_t window) const;

  // Current viewer and drawing options, including key changes.
  struct Viewing {
    scene::HeadPose head;
    double ipd_m = 0;
    scene::StereoMode mode = scene::StereoMode::Mono;
    scene::EyeOrder order = scene::EyeOrder::Straight;
  };
  Viewing viewing() const { return {head_, drawn_ipd_m_, mode(), other_order_}; }

  // Viewing for the other machines of a wall, and its counterpart there, which from then on uses the
  // master's measured depth.
  cluster::ShownView told() const;
  void follow(const cluster::ShownView& view);

  // Newest measurement; empty text before the first one, and while both eyes see the same.
  const exhibit::DepthReport& depth() const { return depth_; }

  // Current resolution under the frame budget; empty while nothing is reduced.
  std::optional<render::DataRow> quality_row() const;

  // Draws and shows a frame with its depth meter in all windows; the meter advises `relief`. Calls `while_waiting`
  // often, and `before_showing` after drawing, which may wait for other machines.
  void show(
      render::FrameState& frame, exhibit::Relief relief, std::int64_t now_ns,
      const std::function<void()>& while_waiting, const std::function<void()>& before_showing = [] {});

 private:
  // A picture that is drawn once and shown in one or more windows: one screen, for two eyes or for the midpoint between
  // them.
  struct Share {
    scene::Screen screen;
    bool flat = false;
    std::array<scene::EyeView, 2> eyes;  // left and right, or the midpoint twice
    std::vector<std::size_t> windows;
  };

  scene::StereoMode mode() const { return other_mode_.value_or(outputs_.front().mode); }
  bool can_show(scene::StereoMode mode) const;
  void share_out();
  void measure_depth(exhibit::Relief relief, std::int64_t now_ns);
  void save_newest();
  void show_in_headset(render::FrameState& frame, std::int64_t now_ns, const std::function<void()>& while_waiting);
  void mirror(const std::function<void()>& while_waiting);
  static void log_update(const std::vector<render::SavedPicture>& saved);

  const exhibit::Stage& stage_;
  const std::vector<ViewOutput>& outputs_;
  const ViewWindows& windows_;
  render::Renderer& renderer_;
  render::Presenter& presenter_;
  PictureSettings settings_;
  std::optional<scene::StereoMode> other_mode_;  // mode that overrides the outputs' own; none: no override
  scene::EyeOrder other_order_ = scene::EyeOrder::Straight;
  std::vector<Share> shares_;
  std::vector<render::WindowPicture> pictures_;  // one per window
  scene::HeadPose head_;                         // head for which the eyes are drawn
  glm::uvec2 eye_size_px_;                       // current size in the renderer
  glm::uvec2 wanted_eye_px_{0};
  std::int64_t windows_steady_since_ns_ = 0;
  std::optional<std::int64_t> refused_since_ns_;
  double drawn_ipd_m_;  // eye distance of the drawing: the viewer's, or less for comfort
  exhibit::ComfortClamp comfort_;
  std::optional<DynamicResolution> budget_;
  bool rehearsed_ = false;  // true: drivers prepared by a frame of the least quality
  render::ScreenshotQueue saver_;
  std::size_t to_save_ = 0;       // number of pending requests
  std::size_t saved_number_ = 0;  // number of the newest file
  render::DepthMeter depth_meter_;
  exhibit::DepthReport depth_;
  FrameTimes times_;
  std::int64_t depth_measured_ns_ = 0;
  std::int64_t depth_logged_ns_ = 0;
  std::int64_t mirrored_ns_ = 0;
  bool calibrating_ = false;
  bool follows_ = false;  // true: drawing options from another machine
};

// Eye image size that the windows can show, as large as the largest needs, in `other_mode` or else in the outputs' own
// modes; 0 x 0 while all windows are invisible.
glm::uvec2 eye_size_for_all(const exhibit::Stage& stage, const std::vector<ViewOutput>& outputs,
                            std::optional<scene::StereoMode> other_mode, const ViewWindows& windows);

}  // namespace afm::app
