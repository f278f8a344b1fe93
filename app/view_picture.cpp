// SPDX-License-Identifier: Apache-2.0
#include "app/view_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/calibration.h"
#include "core/log.h"

namespace afm::app {

namespace {

constexpr std::int64_t kSteadyNs = 250'000'000;  // a window that keeps its size for so long is drawn sharp

constexpr std::int64_t kMeasureNs = 250'000'000;      // between two measurements of depth
constexpr std::int64_t kDepthLogNs = 10'000'000'000;  // between two lines in the log

}  // namespace

ViewPicture::ViewPicture(const Stage& stage, render::Context& context, render::Window& window,
                         render::Renderer& renderer, render::Presenter& presenter, const PictureSettings& settings)
    : stage_(stage),
      window_(window),
      renderer_(renderer),
      presenter_(presenter),
      settings_(settings),
      head_(stage.wall.viewers.front().sweet_spot),
      eyes_(stage.eyes),
      eye_size_px_(settings.eye_px),
      depth_meter_(context, renderer) {
  if (settings_.frame_budget_ms > 0) budget_.emplace(settings_.frame_budget_ms, renderer.detail().samples);
  look_from(head_);
}

void ViewPicture::fit(std::int64_t now_ns) {
  const glm::uvec2 window_px = window_.size_px();
  if (window_px != window_size_px_) {
    window_size_px_ = window_px;
    window_steady_since_ns_ = now_ns;
  }
  if (settings_.fixed_eye_size || now_ns - window_steady_since_ns_ < kSteadyNs) return;
  const glm::uvec2 size = stage_.eye_size_within(settings_.composition.mode, glm::max(window_px, glm::uvec2(1)));
  if (size == eye_size_px_) return;
  eye_size_px_ = size;
  if (auto resized = renderer_.resize(size.x, size.y); !resized) core::log_line(resized.error().message);
}

void ViewPicture::look_from(const scene::HeadPose& head) {
  const auto eyes = eyes_before(stage_.screen, head, flat() ? 0.0 : settings_.ipd_m);
  if (!eyes) return;
  head_ = head;
  eyes_ = *eyes;
}

void ViewPicture::swap_eyes() {
  const bool straight = settings_.composition.order == scene::EyeOrder::Straight;
  settings_.composition.order = straight ? scene::EyeOrder::Swapped : scene::EyeOrder::Straight;
  core::log_line(straight ? "eyes swapped" : "eyes as they were");
}

void ViewPicture::change_mode(Step step) {
  constexpr std::size_t kCount = scene::kStereoModes.size();
  auto index = static_cast<std::size_t>(settings_.composition.mode);
  do {
    index = (index + (step == Step::Next ? 1 : kCount - 1)) % kCount;
  } while (!presenter_.check_mode(scene::kStereoModes[index].mode));
  settings_.composition.mode = scene::kStereoModes[index].mode;
  look_from(head_);
  depth_ = {};
  core::log_line(fmt::format("stereo: {}", scene::kStereoModes[index].name));
}

void ViewPicture::widen_eyes(double by_m) {
  settings_.ipd_m = std::clamp(settings_.ipd_m + by_m, scene::kSmallestIpdM, scene::kLargestIpdM);
  look_from(head_);
  depth_ = {};
  core::log_line(fmt::format("between the eyes: {:.0f} mm", settings_.ipd_m * 1e3));
}

void ViewPicture::toggle_calibration() { calibrating_ = !calibrating_; }

WallPicture ViewPicture::picture() const {
  const glm::uvec2 picture_px = scene::picture_size(settings_.composition.mode, eye_size_px_);
  return {.place = render::picture_place(glm::max(window_.size_px(), glm::uvec2(1)), picture_px),
          .composition = settings_.composition,
          .eyes = eyes_};
}

// What an earlier frame asked of the eyes; tells the log when that begins to be too much, and now and then.
void ViewPicture::measure_depth(std::int64_t now_ns) {
  if (flat() || calibrating_ || now_ns - depth_measured_ns_ < kMeasureNs) return;
  depth_measured_ns_ = now_ns;
  if (const auto range = depth_meter_.newest()) {
    const bool was_hard = depth_.hard;
    const glm::dvec3 middle = 0.5 * (eyes_[0].eye_position_m + eyes_[1].eye_position_m);
    const double distance_m = glm::dot(middle - stage_.screen.lower_left, stage_.screen.normal());
    depth_ = report_depth(*range, distance_m, settings_.ipd_m);
    if ((depth_.hard && !was_hard) || now_ns - depth_logged_ns_ >= kDepthLogNs) {
      core::log_line(depth_.text);
      depth_logged_ns_ = now_ns;
    }
  }
  depth_meter_.measure();
}

void ViewPicture::show(render::FrameState& frame, std::int64_t now_ns, const std::function<void()>& while_waiting) {
  if (calibrating_) {
    show_calibration(stage_.screen, settings_.composition.mode, settings_.ipd_m, frame);
  } else if (!flat()) {
    frame.labels.push_back(depth_label(depth_, stage_.screen));
  }
  while_waiting();
  renderer_.render(frame);
  measure_depth(now_ns);
  while_waiting();
  presenter_.present(settings_.composition, while_waiting);
  while_waiting();
  if (budget_) budget_->follow(renderer_);
}

std::optional<render::DataRow> ViewPicture::detail_row() const {
  return budget_ ? std::optional(budget_->row()) : std::nullopt;
}

}  // namespace afm::app
