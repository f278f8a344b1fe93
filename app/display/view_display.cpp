// SPDX-License-Identifier: Apache-2.0
#include "app/display/view_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/display/instructor_window.h"
#include "app/display/view_headset.h"
#include "app/options/dynamic_resolution.h"
#include "core/log.h"
#include "exhibit/frame/exhibit_setup.h"
#include "haptics/realtime.h"
#include "render/monitor.h"
#include "render/renderer.h"

namespace afm::app {

namespace {

void log_start(const render::RendererOptions& drawing, double budget_ms, const std::string& device,
               const char* keys_hint, const render::SaverInhibition& awake) {
  const std::string coarser =
      budget_ms > 0 ? fmt::format(", fewer while a frame takes more than {:g} ms (--frame-budget)", budget_ms) : "";
  core::log_line(fmt::format("drawing {} x {} pixels for each eye on {}{}; {}", drawing.eye_width, drawing.eye_height,
                             device, coarser, keys_hint));
  if (awake.works()) return;
  core::log_line(fmt::format("the screen saver may blank the wall: X's: {}; org.freedesktop.ScreenSaver: {}",
                             awake.x_server().said, awake.session().said));
}

core::Result<render::Context> open_context(const DisplayOptions& options, render::HeadsetRuntime* runtime) {
  haptics::favour_drawing();  // before the driver starts its threads
  return render::Context::open({.validation = options.validate ? render::Validation::On : render::Validation::Off,
                                .presentation = render::Presentation::Window,
                                .gpu = options.picture.gpu,
                                .runtime = runtime});
}

}  // namespace

ViewDisplay::ViewDisplay() = default;

ViewDisplay::~ViewDisplay() = default;

// Sizes for the windows as opened. Panels are as sharp as the screen with the finest pixels.
render::RendererOptions ViewDisplay::drawing(const exhibit::Stage& stage, const DisplayOptions& options) const {
  render::RendererOptions drawing;
  if (options.eye_width > 0) {
    drawing = stage.renderer_options(options.eye_width);
  } else {
    const glm::uvec2 eye_px = glm::max(eye_size_for_all(stage, outputs_, std::nullopt, *windows_), glm::uvec2(1));
    double narrowest_m = outputs_.front().screen.width_m();
    for (const ViewOutput& output : outputs_) narrowest_m = std::min(narrowest_m, output.screen.width_m());
    drawing.eye_width = eye_px.x;
    drawing.eye_height = eye_px.y;
    drawing.panel_texels_per_m = 2.0 * eye_px.x / narrowest_m;
    drawing.panel_millimetre_m = stage.wall_scene.panel_millimetre_m();
  }
  return drawing;
}

// Uses the eye size that the runtime recommends. Panels are as sharp as its pixels are at the wall's distance.
render::RendererOptions ViewDisplay::drawing_in_headset(const exhibit::Stage& stage, glm::uvec2 eye_px) {
  const double wall_m = glm::distance(stage.wall.viewers.front().sweet_spot.position_m, stage.screen.center());
  render::RendererOptions drawing;
  drawing.eye_width = eye_px.x;
  drawing.eye_height = eye_px.y;
  drawing.panel_texels_per_m = 2.0 * eye_px.x / (2.0 * wall_m);
  drawing.panel_millimetre_m = stage.wall_scene.panel_millimetre_m();
  return drawing;
}

// Rejects a mode that the display cannot show, and logs when the machines of a wall change their pictures.
core::Result<void> ViewDisplay::check_outputs(render::Swap swap) const {
  if (swap == render::Swap::WithOthers) {
    core::log_line(presenter_->swaps_with_others()
                       ? "cluster: pictures change together with the other machines' (VK_NV_present_barrier)"
                       : "cluster: pictures change once all machines have drawn theirs; without VK_NV_present_barrier");
  }
  for (const ViewOutput& output : outputs_) {
    if (auto shown = presenter_->check_mode(output.mode); !shown) return shown;
  }
  return {};
}

core::Result<std::unique_ptr<ViewDisplay>> ViewDisplay::open(const exhibit::Stage& stage, const DisplayOptions& options,
                                                             render::HeadsetRuntime* runtime,
                                                             const core::Clock& clock) {
  const auto monitors = render::list_monitors();
  if (!monitors) return tl::unexpected(monitors.error());
  exhibit::PictureOptions picture = options.picture;
  if (runtime != nullptr) picture.mode = scene::StereoMode::Left;
  auto outputs = plan_view(stage.wall, stage.screen, picture, options.window, *monitors);
  if (!outputs) return tl::unexpected(outputs.error());
  std::unique_ptr<ViewDisplay> display(new ViewDisplay());
  display->outputs_ = std::move(*outputs);
  auto windows = ViewWindows::open(display->outputs_);
  if (!windows) return tl::unexpected(windows.error());
  display->windows_ = std::move(*windows);
  if (!options.instructor.empty()) {
    auto window = InstructorWindow::open_window(options.instructor, *monitors);
    if (!window) return tl::unexpected(window.error());
    display->instructor_window_ = std::move(*window);
  }
  auto context = open_context(options, runtime);
  if (!context) return tl::unexpected(context.error());
  display->context_ = std::move(*context);
  render::RendererOptions drawing =
      runtime != nullptr ? drawing_in_headset(stage, runtime->eye_px()) : display->drawing(stage, options);
  const bool mixes_light = runtime != nullptr && options.contrast == render::PanelContrast::Normal;
  const double budget_ms =
      runtime != nullptr ? 0.0 : frame_budget_ms(options.frame_budget_ms, options.eye_width > 0, *display->context_);
  drawing.time_passes = budget_ms > 0;
  drawing.panel_contrast = mixes_light ? render::PanelContrast::Opaque : options.contrast;
  auto renderer = render::Renderer::create(*display->context_, stage.wall_scene.scene(), drawing);
  if (!renderer) return tl::unexpected(renderer.error());
  display->renderer_ = std::move(*renderer);
  auto presenter =
      render::Presenter::create(*display->context_, *display->renderer_, display->windows_->all(), options.swap);
  if (!presenter) return tl::unexpected(presenter.error());
  display->presenter_ = std::move(*presenter);
  if (auto shown = display->check_outputs(options.swap); !shown) return tl::unexpected(shown.error());
  if (runtime != nullptr) {
    auto headset = ViewHeadset::begin(stage, *runtime, *display->context_, *display->renderer_, clock);
    if (!headset) return tl::unexpected(headset.error());
    display->headset_ = std::move(*headset);
  }
  display->picture_.emplace(stage, display->outputs_, *display->context_, *display->windows_, *display->renderer_,
                            *display->presenter_,
                            PictureSettings{.ipd_m = options.picture.ipd_m.value_or(stage.wall.viewers.front().ipd_m),
                                            .eye_px = {drawing.eye_width, drawing.eye_height},
                                            .fixed_eye_size = options.eye_width > 0,
                                            .comfort_rad = glm::radians(options.comfort_deg),
                                            .frame_budget_ms = budget_ms,
                                            .saved_folder = options.saved_folder,
                                            .headset = display->headset_.get()});
  if (display->instructor_window_) {
    auto instructor =
        InstructorWindow::create(*display->context_, *display->instructor_window_, stage.phrases(), options.contrast);
    if (!instructor) return tl::unexpected(instructor.error());
    display->instructor_ = std::move(*instructor);
  }
  log_start(drawing, budget_ms, display->context_->device_name(), options.keys_hint, display->awake_);
  return display;
}

}  // namespace afm::app
