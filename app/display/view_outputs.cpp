// SPDX-License-Identifier: Apache-2.0
#include "app/display/view_outputs.h"
#include "exhibit/frame/exhibit_setup.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace afm::app {

namespace {

using core::ErrorCategory;
using scene::EyeOrder;
using scene::StereoMode;

constexpr const char* kTitle = "TouchAFM";

EyeOrder twice(EyeOrder a, EyeOrder b) { return a == b ? EyeOrder::Straight : EyeOrder::Swapped; }

std::string list_of(const std::vector<render::Monitor>& monitors) {
  std::string list;
  for (std::size_t i = 0; i < monitors.size(); ++i) {
    const scene::PixelRect& rect = monitors[i].rect;
    list += fmt::format("{}{} {} ({} x {} at {}, {})", i == 0 ? "" : ", ", i + 1, monitors[i].name, rect.size_px.x,
                        rect.size_px.y, rect.offset_px.x, rect.offset_px.y);
  }
  return list.empty() ? "none" : list;
}

core::Result<render::WindowOptions> placed(const scene::Output& output, const std::vector<render::Monitor>& monitors) {
  render::WindowOptions window{.title = fmt::format("{}, {}", kTitle, output.name)};
  const std::string who = fmt::format("output \"{}\"", output.name);
  if (!output.monitor.empty()) {
    if (auto filled = fill_monitor(who, output.monitor, monitors, window); !filled)
      return tl::unexpected(filled.error());
    return window;
  }
  if (!render::is_shown(output.rect, monitors)) {
    return core::failure(ErrorCategory::DeviceMissing,
                         fmt::format("{}: no monitor contains its {} x {} pixels at {}, {}; the monitors are: {}; use "
                                     "--size to show the wall in one window",
                                     who, output.rect.size_px.x, output.rect.size_px.y, output.rect.offset_px.x,
                                     output.rect.offset_px.y, list_of(monitors)));
  }
  window.rect = output.rect;
  return window;
}

// Plans one window, which shows one screen: a pair of projectors side by side is one side-by-side picture.
core::Result<std::vector<ViewOutput>> one_window(const scene::Wall& wall, const scene::Screen& stage,
                                                 const exhibit::PictureOptions& options, const WindowOptions& wanted,
                                                 const std::vector<render::Monitor>& monitors) {
  ViewOutput output{.name = {}, .screen = stage, .eye = {}, .window = {.title = kTitle}};
  output.window.full_screen = wanted.full_screen;
  if (wanted.size_px) {
    output.window.width = wanted.size_px->x;
    output.window.height = wanted.size_px->y;
  }
  if (!wanted.monitor.empty()) {
    auto filled = fill_monitor("--monitor", wanted.monitor, monitors, output.window);
    if (!filled) return tl::unexpected(filled.error());
  }
  if (!wall.outputs.empty()) {
    const scene::Output& first = wall.outputs.front();
    output.mode = first.mode == StereoMode::Dual ? StereoMode::SideBySide : first.mode;
    output.order = first.order;
    if (wall.outputs.size() == 1) {
      output.picture_from_output = first.picture_from_output;
      output.warp = first.warp;
    }
    if (!options.mode && first.eye == scene::Eye::Right) output.order = twice(output.order, EyeOrder::Swapped);
  }
  output.mode = options.mode.value_or(output.mode);
  output.order = twice(output.order, options.order);
  if (output.mode != StereoMode::Dual) return std::vector{output};
  output.eye = scene::Eye::Left;
  ViewOutput right = output;
  right.eye = scene::Eye::Right;
  right.window.title += ", right eye";
  return std::vector{std::move(output), std::move(right)};
}

}  // namespace

bool holds(const scene::Screen& screen, const glm::dvec3& point_m) {
  constexpr double kEdge = 0.01;  // relative to the screen's size
  const glm::dvec3 from_corner_m = point_m - screen.lower_left;
  const auto within = [&](const glm::dvec3& side_m) {
    const double share = glm::dot(from_corner_m, side_m) / glm::dot(side_m, side_m);
    return share >= -kEdge && share <= 1.0 + kEdge;
  };
  const double before_m = std::abs(glm::dot(from_corner_m, screen.normal()));
  return within(screen.lower_right - screen.lower_left) && within(screen.upper_left - screen.lower_left) &&
         before_m <= kEdge * screen.width_m();
}

core::Result<void> fill_monitor(const std::string& who, const std::string& wanted,
                                const std::vector<render::Monitor>& monitors, render::WindowOptions& window) {
  const render::Monitor* const found = render::find_monitor(monitors, wanted);
  if (found == nullptr) {
    return core::failure(ErrorCategory::DeviceMissing, fmt::format("{}: there is no monitor \"{}\"; choose from: {}",
                                                                   who, wanted, list_of(monitors)));
  }
  window.monitor = found->name;
  window.monitor_corner = found->rect.offset_px;
  return {};
}

render::Composition ViewOutput::composition(std::optional<StereoMode> other_mode, EyeOrder other_order) const {
  StereoMode shown = other_mode.value_or(mode);
  if (shown == StereoMode::Dual && eye) shown = *eye == scene::Eye::Left ? StereoMode::Left : StereoMode::Right;
  return {shown, twice(order, other_order), picture_from_output, warp, blend};
}

glm::uvec2 expected_size(const WindowOptions& window, const std::vector<render::Monitor>& monitors) {
  if (!window.monitor.empty()) {
    if (const render::Monitor* found = render::find_monitor(monitors, window.monitor)) return found->rect.size_px;
  }
  if (window.size_px) return *window.size_px;
  if (window.full_screen && !monitors.empty()) return monitors.front().rect.size_px;
  const render::WindowOptions usual;
  return {usual.width, usual.height};
}

core::Result<std::vector<ViewOutput>> plan_view(const scene::Wall& wall, const scene::Screen& stage,
                                                const exhibit::PictureOptions& options, const WindowOptions& window,
                                                const std::vector<render::Monitor>& monitors) {
  const bool one = window.size_px || !window.monitor.empty() || window.full_screen;
  const std::vector<scene::Output>& outputs = wall.outputs;
  if (one || outputs.empty()) return one_window(wall, stage, options, window, monitors);
  if (outputs.size() > render::kMostWindows) {
    return core::failure(ErrorCategory::WrongUsage,
                         fmt::format("the wall has {} outputs; one computer can show {}: remove some, or use --size to "
                                     "show the wall in one window",
                                     outputs.size(), render::kMostWindows));
  }
  std::vector<ViewOutput> plan;
  for (const scene::Output& output : outputs) {
    if (options.mode == StereoMode::Dual && !output.eye) {
      return core::failure(ErrorCategory::WrongUsage,
                           fmt::format("--stereo dual: output \"{}\" of the wall file is not assigned to an eye; "
                                       "define two outputs, with eye = \"left\" and eye = \"right\"",
                                       output.name));
    }
    auto place = placed(output, monitors);
    if (!place) return tl::unexpected(place.error());
    plan.push_back({.name = output.name,
                    .screen = wall.screens[output.screen],
                    .mode = options.mode.value_or(output.mode),
                    .eye = output.eye,
                    .order = twice(output.order, options.order),
                    .picture_from_output = output.picture_from_output,
                    .warp = output.warp,
                    .blend = output.blend,
                    .fit = render::PictureFit::Fill,
                    .window = std::move(*place)});
  }
  return plan;
}

glm::uvec2 eye_size_for(const exhibit::Stage& stage, const ViewOutput& output, StereoMode mode, glm::uvec2 window_px) {
  if (output.fit == render::PictureFit::Proportions) return stage.eye_size_within(mode, window_px);
  return scene::eye_size(mode, window_px);
}

}  // namespace afm::app
