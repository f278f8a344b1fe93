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
  glm::uvec2 eye_px{0};         // as the renderer was made
  bool fixed_eye_size = false;  // else the eyes get as many pixels as the windows have for them
  double comfort_rad = scene::kComfortableDisparityRad;  // how much more or less the eyes may turn in than for the wall
  double frame_budget_ms = 0;                            // frames are drawn coarser to stay within it; 0: as they are
  std::string saved_folder = ".";                        // for the pictures that are saved
  ViewHeadset* headset = nullptr;                        // whose left eye the window mirrors; must outlive it; none
};

// Picture of the wall in the live windows: eyes, layout and size. Main thread only.
class ViewPicture {
 public:
  // All but the settings must outlive it. `outputs` has one entry a window.
  ViewPicture(const exhibit::Stage& stage, const std::vector<ViewOutput>& outputs, render::Context& context,
              const ViewWindows& windows, render::Renderer& renderer, render::Presenter& presenter,
              const PictureSettings& settings);

  // Once a frame: the eye images get the pixels that the windows have for them, once those have stopped changing; and
  // the eyes the distance at which the depth that was measured last is comfortable.
  void fit(std::int64_t now_ns);

  // The eyes of a head somewhere before the wall; behind a screen, its picture stays as it was. With a headset they are
  // its own.
  void look_from(const scene::HeadPose& head);

  void swap_eyes();

  // The next mode that these windows can show, or the one before.
  enum class Step { Next, Previous };
  void change_mode(Step step);

  // Changes the viewer's eye distance, within the human range.
  void widen_eyes(double by_m);

  // Shows the calibration picture instead of the scene, or the scene again.
  void toggle_calibration();

  // Saves the next frame of the first window as a new PNG file without delaying the drawing.
  void save();

  // To be called instead of show() while the windows are invisible.
  void rest() { times_.hidden(); }

  // Waits for the last screenshots; logs them and the frame times.
  void finish();

  // Projection and area of the next frame in a window.
  WallPicture picture(std::size_t window) const;

  // For whom and how it is drawn now, with the keys' changes.
  struct Viewing {
    scene::HeadPose head;
    double ipd_m = 0;
    scene::StereoMode mode = scene::StereoMode::Mono;
    scene::EyeOrder order = scene::EyeOrder::Straight;
  };
  Viewing viewing() const { return {head_, drawn_ipd_m_, mode(), other_order_}; }

  // The same for the other machines of a wall, and there: from then on the depth is the one that was told.
  cluster::ShownView told() const;
  void follow(const cluster::ShownView& view);

  // As measured last; without text before the first measurement, and where both eyes see the same.
  const exhibit::DepthReport& depth() const { return depth_; }

  // Current resolution under the frame budget; empty without a budget.
  std::optional<render::DataRow> quality_row() const;

  // Draws and shows a frame in all windows, with the depth meter in it, which advises `relief`; calls `while_waiting`
  // often, and `before_showing` once all is drawn: it may wait until other machines have drawn it too.
  void show(
      render::FrameState& frame, exhibit::Relief relief, std::int64_t now_ns,
      const std::function<void()>& while_waiting, const std::function<void()>& before_showing = [] {});

 private:
  // A picture that is drawn once and shown in one or more windows: a screen for two eyes or for the midpoint between
  // them.
  struct Share {
    scene::Screen screen;
    bool flat = false;
    std::array<scene::EyeView, 2> eyes;  // left and right, or twice the middle
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
  std::optional<scene::StereoMode> other_mode_;  // than the outputs' own
  scene::EyeOrder other_order_ = scene::EyeOrder::Straight;
  std::vector<Share> shares_;
  std::vector<render::WindowPicture> pictures_;  // one a window
  scene::HeadPose head_;                         // the eyes are drawn for
  glm::uvec2 eye_size_px_;                       // as the renderer draws
  glm::uvec2 wanted_eye_px_{0};
  std::int64_t windows_steady_since_ns_ = 0;
  double drawn_ipd_m_;  // what the eyes are drawn for: the viewer's, or less for comfort
  exhibit::ComfortClamp comfort_;
  std::optional<DynamicResolution> budget_;
  render::ScreenshotQueue saver_;
  std::size_t to_save_ = 0;       // pictures that were asked for
  std::size_t saved_number_ = 0;  // of the newest file
  render::DepthMeter depth_meter_;
  exhibit::DepthReport depth_;
  FrameTimes times_;
  std::int64_t depth_measured_ns_ = 0;
  std::int64_t depth_logged_ns_ = 0;
  std::int64_t mirrored_ns_ = 0;
  bool calibrating_ = false;
  bool follows_ = false;  // another machine decides how it is drawn
};

// The eye images that the windows have room for, as large as the largest of them needs, in another mode than the
// outputs' own if there is one; 0 x 0 as long as nobody sees any.
glm::uvec2 eye_size_for_all(const exhibit::Stage& stage, const std::vector<ViewOutput>& outputs,
                            std::optional<scene::StereoMode> other_mode, const ViewWindows& windows);

}  // namespace afm::app
