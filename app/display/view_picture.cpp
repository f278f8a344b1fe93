// SPDX-License-Identifier: Apache-2.0
#include "app/display/view_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "cluster/frame_message.h"
#include "core/log.h"
#include "exhibit/cluster/frame_inputs.h"
#include "exhibit/frame/calibration.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/recorded_wall.h"
#include "exhibit/frame/wall_pictures.h"
#include "exhibit/scan/live_scan.h"

namespace afm::app {

namespace {

constexpr std::int64_t kSteadyNs = 250'000'000;  // a window is drawn sharp once its size has been stable for this long

constexpr std::int64_t kMeasureNs = 250'000'000;      // time between two measurements of depth
constexpr std::int64_t kDepthLogNs = 10'000'000'000;  // time between two depth lines in the log

}  // namespace

glm::uvec2 eye_size_for_all(const exhibit::Stage& stage, const std::vector<ViewOutput>& outputs,
                            std::optional<scene::StereoMode> other_mode, const ViewWindows& windows) {
  glm::uvec2 largest(0);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const glm::uvec2 window_px = windows.at(i).size_px();
    if (window_px.x == 0 || window_px.y == 0) continue;
    const scene::StereoMode mode = outputs[i].composition(other_mode, scene::EyeOrder::Straight).mode;
    largest = glm::max(largest, eye_size_for(stage, outputs[i], mode, window_px));
  }
  return largest;
}

ViewPicture::ViewPicture(const exhibit::Stage& stage, const std::vector<ViewOutput>& outputs, render::Context& context,
                         const ViewWindows& windows, render::Renderer& renderer, render::Presenter& presenter,
                         const PictureSettings& settings)
    : stage_(stage),
      outputs_(outputs),
      windows_(windows),
      renderer_(renderer),
      presenter_(presenter),
      settings_(settings),
      head_(stage.wall.viewers.front().sweet_spot),
      eye_size_px_(settings.eye_px),
      drawn_ipd_m_(settings.ipd_m),
      comfort_(settings.comfort_rad),
      saver_(context, renderer),
      depth_meter_(context, renderer) {
  if (settings_.frame_budget_ms > 0) budget_.emplace(settings_.frame_budget_ms, renderer.quality().samples);
  share_out();
}

void ViewPicture::fit(std::int64_t now_ns) {
  if (settings_.headset != nullptr) return;
  if (!follows_) drawn_ipd_m_ = comfort_.ipd_m(settings_.ipd_m, now_ns);
  look_from(head_);
  const glm::uvec2 wanted = eye_size_for_all(stage_, outputs_, other_mode_, windows_);
  if (wanted != wanted_eye_px_) {
    wanted_eye_px_ = wanted;
    windows_steady_since_ns_ = now_ns;
  }
  const bool steady = now_ns - windows_steady_since_ns_ >= kSteadyNs;
  if (settings_.fixed_eye_size || !steady || wanted.x == 0 || wanted == eye_size_px_) return;
  eye_size_px_ = wanted;
  if (auto resized = renderer_.resize(wanted.x, wanted.y); !resized) core::log_line(resized.error().message);
}

// Outputs with the same screen and eyes share one rendering.
void ViewPicture::share_out() {
  shares_.clear();
  pictures_.clear();
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const ViewOutput& output = outputs_[i];
    pictures_.push_back({output.composition(other_mode_, other_order_), output.fit});
    pictures_.back().composition.mesh_lines = calibrating_;
    const bool flat = pictures_.back().composition.mode == scene::StereoMode::Mono;
    const auto same = std::find_if(shares_.begin(), shares_.end(), [&](const Share& share) {
      return share.screen.name == output.screen.name && share.flat == flat;
    });
    if (same != shares_.end()) {
      same->windows.push_back(i);
    } else {
      shares_.push_back({.screen = output.screen, .flat = flat, .eyes = stage_.eyes, .windows = {i}});
    }
  }
  look_from(head_);
  depth_ = {};
}

void ViewPicture::look_from(const scene::HeadPose& head) {
  head_ = head;
  if (settings_.headset != nullptr) return;
  for (Share& share : shares_) {
    if (const auto eyes = exhibit::eyes_before(share.screen, head, share.flat ? 0.0 : drawn_ipd_m_)) share.eyes = *eyes;
  }
}

cluster::ShownView ViewPicture::told() const {
  using Shown = cluster::ShownView;
  Shown view{.ipd_m = settings_.ipd_m, .drawn_ipd_m = drawn_ipd_m_};
  view.head = exhibit::pose_of(head_);
  exhibit::set_depth(depth_, view);
  if (other_mode_) view.mode = static_cast<std::int32_t>(*other_mode_);
  if (other_order_ == scene::EyeOrder::Swapped) view.flags |= Shown::kSwapped;
  if (calibrating_) view.flags |= Shown::kCalibration;
  return view;
}

void ViewPicture::follow(const cluster::ShownView& view) {
  using Shown = cluster::ShownView;
  follows_ = true;
  settings_.ipd_m = view.ipd_m;
  drawn_ipd_m_ = view.drawn_ipd_m;
  head_ = exhibit::head_of(view.head);
  auto mode = view.mode < 0 ? std::nullopt : std::optional(static_cast<scene::StereoMode>(view.mode));
  if (mode && !can_show(*mode)) mode.reset();  // mode impossible here: the output's own
  const bool swapped = (view.flags & Shown::kSwapped) != 0;
  const auto order = swapped ? scene::EyeOrder::Swapped : scene::EyeOrder::Straight;
  const bool calibrating = (view.flags & Shown::kCalibration) != 0;
  const bool other = mode != other_mode_ || order != other_order_ || calibrating != calibrating_;
  other_mode_ = mode;
  other_order_ = order;
  calibrating_ = calibrating;
  if (other) {
    share_out();
  } else {
    look_from(head_);
  }
  depth_ = exhibit::depth_of(view);
}

void ViewPicture::swap_eyes() {
  const bool straight = other_order_ == scene::EyeOrder::Straight;
  other_order_ = straight ? scene::EyeOrder::Swapped : scene::EyeOrder::Straight;
  share_out();
  core::log_line(straight ? "eyes swapped" : "eyes not swapped");
}

// True if the windows can show the mode; mode dual needs a window for each eye.
bool ViewPicture::can_show(scene::StereoMode mode) const {
  const bool pairs = std::all_of(outputs_.begin(), outputs_.end(), [](const auto& output) { return output.eye; });
  return presenter_.check_mode(mode) && (mode != scene::StereoMode::Dual || pairs);
}

void ViewPicture::change_mode(Step step) {
  constexpr std::size_t kCount = scene::kStereoModes.size();
  auto index = static_cast<std::size_t>(mode());
  do {
    index = (index + (step == Step::Next ? 1 : kCount - 1)) % kCount;
  } while (!can_show(scene::kStereoModes[index].mode));
  // the first output's own mode restores the other outputs' modes too
  other_mode_ = scene::kStereoModes[index].mode;
  if (other_mode_ == outputs_.front().mode) other_mode_.reset();
  share_out();
  core::log_line(fmt::format("stereo: {}", scene::kStereoModes[index].name));
}

void ViewPicture::widen_eyes(double by_m) {
  settings_.ipd_m = std::clamp(settings_.ipd_m + by_m, scene::kSmallestIpdM, scene::kLargestIpdM);
  look_from(head_);
  depth_ = {};
  core::log_line(fmt::format("between the eyes: {:.0f} mm", settings_.ipd_m * 1e3));
}

void ViewPicture::toggle_calibration() {
  calibrating_ = !calibrating_;
  for (render::WindowPicture& picture : pictures_) picture.composition.mesh_lines = calibrating_;
}

WallPicture ViewPicture::picture(std::size_t window) const {
  const auto share = std::find_if(shares_.begin(), shares_.end(), [&](const Share& candidate) {
    return std::find(candidate.windows.begin(), candidate.windows.end(), window) != candidate.windows.end();
  });
  const render::WindowPicture& shown = pictures_[window];
  const glm::uvec2 window_px = glm::max(windows_.at(window).size_px(), glm::uvec2(1));
  const glm::uvec2 picture_px = scene::picture_size(shown.composition.mode, eye_size_px_);
  return {.place = render::picture_place(window_px, picture_px, shown.fit),
          .composition = shown.composition,
          .eyes = share->eyes,
          .screen = share->screen};
}

// Measures the effort of the eyes in an earlier frame. Logs when it becomes excessive, and at intervals.
void ViewPicture::measure_depth(exhibit::Relief relief, std::int64_t now_ns) {
  if (follows_ || shares_.front().flat || calibrating_ || now_ns - depth_measured_ns_ < kMeasureNs) return;
  depth_measured_ns_ = now_ns;
  if (const auto range = depth_meter_.newest()) {
    const bool was_hard = depth_.hard;
    const Share& first = shares_.front();
    const glm::dvec3 middle = 0.5 * (first.eyes[0].eye_position_m + first.eyes[1].eye_position_m);
    const double distance_m = glm::dot(middle - first.screen.lower_left, first.screen.normal());
    comfort_.measured(*range, distance_m, settings_.ipd_m);
    depth_ = exhibit::report_depth(*range, distance_m, comfort_.settled_ipd_m(settings_.ipd_m), relief);
    if ((depth_.hard && !was_hard) || now_ns - depth_logged_ns_ >= kDepthLogNs) {
      core::log_line(exhibit::depth_text(depth_, stage_.english));
      depth_logged_ns_ = now_ns;
    }
  }
  depth_meter_.measure();
}

void ViewPicture::save() { ++to_save_; }

// Saves the picture as seen on the screen, neither warped nor blended. A mode with one picture per eye is saved side by
// side. A picture that does not fit into the saver's queue waits for a later frame.
void ViewPicture::save_newest() {
  log_update(saver_.collect());
  if (to_save_ == 0) return;
  const render::Composition& shown = pictures_.front().composition;
  render::Composition composition{.mode = shown.mode, .order = shown.order};
  if (scene::has_two_pictures(composition.mode)) composition.mode = scene::StereoMode::SideBySide;
  std::string path;
  do {
    path = fmt::format("{}/touchafm-{:03}.png", settings_.saved_folder, ++saved_number_);
  } while (std::filesystem::exists(path));
  if (saver_.save(composition, path)) {
    --to_save_;
  } else {
    --saved_number_;
  }
}

void ViewPicture::finish() {
  if (const std::string text = times_.text(); !text.empty()) core::log_line(text);
  log_update(saver_.finish());
  if (to_save_ > 0) core::log_line(fmt::format("{} screenshots were not saved: the program ended too soon", to_save_));
}

void ViewPicture::log_update(const std::vector<render::SavedPicture>& saved) {
  for (const render::SavedPicture& picture : saved) {
    core::log_line(picture.written ? "saved " + picture.path : picture.written.error().message);
  }
}

void ViewPicture::show(render::FrameState& frame, exhibit::Relief relief, std::int64_t now_ns,
                       const std::function<void()>& while_waiting, const std::function<void()>& before_showing) {
  if (settings_.headset != nullptr) return show_in_headset(frame, now_ns, while_waiting);
  if (!calibrating_ && !shares_.front().flat)
    frame.labels.push_back(exhibit::depth_label(depth_, stage_.screen, stage_.phrases()));
  while_waiting();
  if (!presenter_.begin(pictures_, while_waiting)) {
    times_.hidden();
    if (!refused_since_ns_) refused_since_ns_ = now_ns;
    before_showing();
    return;
  }
  for (const Share& share : shares_) {
    frame.eyes = share.eyes;
    if (calibrating_) {
      const scene::StereoMode mode = other_mode_.value_or(outputs_[share.windows.front()].mode);
      exhibit::show_calibration(share.screen, mode, settings_.ipd_m, stage_.phrases(), frame);
    }
    if (budget_ && !std::exchange(rehearsed_, true)) budget_->rehearse(renderer_, frame);
    renderer_.render(frame);
    while_waiting();
    if (&share == &shares_.front()) {
      measure_depth(relief, now_ns);
      save_newest();
    }
    while_waiting();
    presenter_.draw(share.windows, while_waiting);
    while_waiting();
  }
  before_showing();
  presenter_.show();
  refused_since_ns_.reset();
  times_.shown(now_ns);
  while_waiting();
  if (budget_) budget_->follow(renderer_);
}

std::optional<render::DataRow> ViewPicture::quality_row() const {
  return budget_ && budget_->reduced() ? std::optional(budget_->row(stage_.phrases())) : std::nullopt;
}

}  // namespace afm::app
