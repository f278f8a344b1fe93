// SPDX-License-Identifier: Apache-2.0
#include "app/view_picture.h"

#include <utility>

#include "app/frame_builder.h"
#include "core/log.h"

namespace afm::app {

namespace {

constexpr std::int64_t kSteadyNs = 250'000'000;  // a window that keeps its size for so long is drawn sharp

render::Layout layout_of(StereoMode mode) {
  switch (mode) {
    case StereoMode::Right:
      return render::Layout::Right;
    case StereoMode::SideBySide:
      return render::Layout::SideBySide;
    case StereoMode::Mono:
    case StereoMode::Left:
      break;
  }
  return render::Layout::Left;
}

std::array<scene::EyeView, 2> eyes_for(const Stage& stage, StereoMode mode) {
  if (mode != StereoMode::Mono) return stage.eyes;
  scene::Wall one_eyed = stage.wall;
  one_eyed.viewers.front().ipd_m = 0.0;
  return *eyes_at_sweet_spot(one_eyed);  // the stage was loaded with this wall and this head
}

}  // namespace

std::uint32_t eyes_beside(StereoMode mode) { return mode == StereoMode::SideBySide ? 2 : 1; }

ViewPicture::ViewPicture(const Stage& stage, render::Window& window, render::Renderer& renderer,
                         render::Presenter& presenter, const PictureSettings& settings)
    : stage_(stage),
      window_(window),
      renderer_(renderer),
      presenter_(presenter),
      settings_(settings),
      eyes_(eyes_for(stage, settings.stereo)),
      eye_size_px_(settings.eye_px) {}

void ViewPicture::fit(std::int64_t now_ns) {
  const glm::uvec2 window_px = window_.size_px();
  if (window_px != window_size_px_) {
    window_size_px_ = window_px;
    window_steady_since_ns_ = now_ns;
  }
  if (settings_.fixed_eye_size || now_ns - window_steady_since_ns_ < kSteadyNs) return;
  const render::RendererOptions options =
      stage_.renderer_options(stage_.eye_width_within(window_px, eyes_beside(settings_.stereo)));
  const glm::uvec2 size(options.eye_width, options.eye_height);
  if (size == eye_size_px_) return;
  eye_size_px_ = size;
  if (auto resized = renderer_.resize(size.x, size.y); !resized) core::log_line(resized.error().message);
}

void ViewPicture::swap_eyes() {
  settings_.swap_eyes = !settings_.swap_eyes;
  core::log_line(settings_.swap_eyes ? "eyes swapped" : "eyes as they were");
}

WallPicture ViewPicture::picture() const {
  const glm::uvec2 picture_px(eye_size_px_.x * eyes_beside(settings_.stereo), eye_size_px_.y);
  WallPicture picture{.place = render::picture_place(glm::max(window_.size_px(), glm::uvec2(1)), picture_px),
                      .layout = layout_of(settings_.stereo),
                      .eyes = eyes_};
  if (settings_.swap_eyes) std::swap(picture.eyes[0], picture.eyes[1]);
  return picture;
}

void ViewPicture::show(const render::FrameState& frame, const std::function<void()>& while_waiting) {
  while_waiting();
  renderer_.render(frame);
  while_waiting();
  presenter_.present(layout_of(settings_.stereo), while_waiting);
  while_waiting();
}

}  // namespace afm::app
