// SPDX-License-Identifier: Apache-2.0
#include "app/view_picture.h"

#include <glm/common.hpp>

#include "app/frame_builder.h"
#include "core/log.h"

namespace afm::app {

namespace {

constexpr std::int64_t kSteadyNs = 250'000'000;  // a window that keeps its size for so long is drawn sharp

std::array<scene::EyeView, 2> eyes_for(const Stage& stage, scene::StereoMode mode) {
  if (mode != scene::StereoMode::Mono) return stage.eyes;
  scene::Wall one_eyed = stage.wall;
  one_eyed.viewers.front().ipd_m = 0.0;
  return *eyes_at_sweet_spot(one_eyed);  // the stage was loaded with this wall and this head
}

}  // namespace

ViewPicture::ViewPicture(const Stage& stage, render::Window& window, render::Renderer& renderer,
                         render::Presenter& presenter, const PictureSettings& settings)
    : stage_(stage),
      window_(window),
      renderer_(renderer),
      presenter_(presenter),
      settings_(settings),
      eyes_(eyes_for(stage, settings.composition.mode)),
      eye_size_px_(settings.eye_px) {
  if (settings_.frame_budget_ms > 0) budget_.emplace(settings_.frame_budget_ms, renderer.detail().samples);
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
  const double ipd_m = settings_.composition.mode == scene::StereoMode::Mono ? 0.0 : stage_.wall.viewers.front().ipd_m;
  std::array<scene::EyeView, 2> eyes;
  for (const scene::Eye eye : scene::kEyes) {
    const auto view = scene::off_axis_view(stage_.wall.screens.front(), scene::eye_position(head, eye, ipd_m),
                                           scene::DepthConvention::VulkanReversedInfinite, scene::kNearM, 0.0);
    if (!view) return;
    eyes[static_cast<std::size_t>(eye)] = *view;
  }
  eyes_ = eyes;
}

void ViewPicture::swap_eyes() {
  const bool straight = settings_.composition.order == scene::EyeOrder::Straight;
  settings_.composition.order = straight ? scene::EyeOrder::Swapped : scene::EyeOrder::Straight;
  core::log_line(straight ? "eyes swapped" : "eyes as they were");
}

WallPicture ViewPicture::picture() const {
  const glm::uvec2 picture_px = scene::picture_size(settings_.composition.mode, eye_size_px_);
  return {.place = render::picture_place(glm::max(window_.size_px(), glm::uvec2(1)), picture_px),
          .composition = settings_.composition,
          .eyes = eyes_};
}

void ViewPicture::show(const render::FrameState& frame, const std::function<void()>& while_waiting) {
  while_waiting();
  renderer_.render(frame);
  while_waiting();
  presenter_.present(settings_.composition, while_waiting);
  while_waiting();
  if (budget_) budget_->follow(renderer_);
}

std::optional<render::DataRow> ViewPicture::detail_row() const {
  return budget_ ? std::optional(budget_->row()) : std::nullopt;
}

}  // namespace afm::app
