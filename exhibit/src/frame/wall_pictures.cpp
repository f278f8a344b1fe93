// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/wall_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <utility>

#include "core/log.h"
#include "render/eye_memory.h"
#include "render/image_file.h"

namespace afm::exhibit {

namespace {

using core::ErrorCategory;
using scene::StereoMode;

// Composition of one output; if the mode has two pictures and the output an eye, only that eye.
render::Composition composition_of(const scene::Output& output, const PictureOptions& options) {
  StereoMode mode = options.mode.value_or(output.mode);
  if (!options.mode && output.eye) mode = *output.eye == scene::Eye::Left ? StereoMode::Left : StereoMode::Right;
  const bool swapped = (output.order == scene::EyeOrder::Swapped) != (options.order == scene::EyeOrder::Swapped);
  return {.mode = mode,
          .order = swapped ? scene::EyeOrder::Swapped : scene::EyeOrder::Straight,
          .picture_from_output = output.picture_from_output,
          .warp = output.warp,
          .blend = output.blend,
          .mesh_lines = options.mesh_lines};
}

glm::uvec2 natural_size(const scene::Screen& screen, StereoMode mode, std::uint32_t eye_width) {
  const auto height = static_cast<std::uint32_t>(std::lround(eye_width * screen.height_m() / screen.width_m()));
  return scene::picture_size(mode, {eye_width, std::max(1U, height)});
}

// Outputs to draw: a pair of projectors that share one screen counts once in other modes.
std::vector<scene::Output> drawn_outputs(const scene::Wall& wall, const PictureOptions& options) {
  std::vector<scene::Output> outputs;
  if (wall.outputs.empty()) {
    for (std::size_t i = 0; i < wall.screens.size(); ++i) {
      scene::Output output;
      output.name = wall.screens[i].name;
      output.screen = i;
      output.mode = StereoMode::SideBySide;
      output.blend = scene::usual_blend(wall, i);
      outputs.push_back(output);
    }
    return outputs;
  }
  for (const scene::Output& output : wall.outputs) {
    const bool second_of_pair =
        options.mode && output.eye && std::any_of(outputs.begin(), outputs.end(), [&](const auto& other) {
          return other.eye && other.screen == output.screen;
        });
    if (!second_of_pair) outputs.push_back(output);
  }
  return outputs;
}

// Scales the plan; adjoining rectangles stay adjoining.
void scale_to(glm::uvec2 size_px, WallPlan& plan) {
  const glm::dvec2 scale = glm::dvec2(size_px) / glm::dvec2(plan.size_px);
  for (OutputPicture& output : plan.outputs) {
    const glm::dvec2 begin(output.rect.offset_px), end = begin + glm::dvec2(output.rect.size_px);
    const glm::uvec2 first(glm::round(begin * scale)), last(glm::round(end * scale));
    output.rect = {glm::ivec2(glm::min(first, size_px - 1U)), glm::max(last - first, glm::uvec2(1))};
  }
  plan.size_px = size_px;
}

void blit(const render::Image& from, glm::uvec2 at, render::Image& onto) {
  const std::size_t columns = std::min<std::size_t>(from.width, onto.width - at.x);
  for (std::size_t y = 0; y < from.height && y + at.y < onto.height; ++y) {
    const auto row = from.rgba.begin() + static_cast<std::ptrdiff_t>(4 * y * from.width);
    std::copy_n(row, 4 * columns,
                onto.rgba.begin() + static_cast<std::ptrdiff_t>(4 * ((y + at.y) * onto.width + at.x)));
  }
}

render::Image black(glm::uvec2 size_px) {
  render::Image image{.width = size_px.x, .height = size_px.y, .rgba = {}};
  image.rgba.resize(std::size_t{4} * size_px.x * size_px.y, 0);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  return image;
}

}  // namespace

core::Result<WallPlan> plan_wall(const scene::Wall& wall, const PictureOptions& options) {
  WallPlan plan;
  glm::ivec2 upper_left(0), lower_right(0);
  bool placed = false;
  std::vector<bool> waiting;
  for (const scene::Output& output : drawn_outputs(wall, options)) {
    const scene::Screen& screen = wall.screens[output.screen];
    OutputPicture picture{output.name, screen, options.mode.value_or(output.mode), composition_of(output, options),
                          output.rect};
    const bool has_rect = output.rect.size_px != glm::uvec2(0);
    const bool exact = scene::frame_packing(picture.composition.mode).has_value();
    if (exact || !has_rect) picture.rect.size_px = natural_size(screen, picture.composition.mode, options.eye_width);
    if (has_rect) {
      const glm::ivec2 end = picture.rect.offset_px + glm::ivec2(picture.rect.size_px);
      upper_left = placed ? glm::min(upper_left, picture.rect.offset_px) : picture.rect.offset_px;
      lower_right = placed ? glm::max(lower_right, end) : end;
      placed = true;
    }
    waiting.push_back(!has_rect);
    plan.outputs.push_back(std::move(picture));
  }
  for (std::size_t i = 0; i < plan.outputs.size(); ++i) {
    scene::PixelRect& rect = plan.outputs[i].rect;
    if (waiting[i]) {
      rect.offset_px = {lower_right.x, upper_left.y};
      lower_right = glm::max(lower_right, rect.offset_px + glm::ivec2(rect.size_px));
    }
  }
  for (OutputPicture& output : plan.outputs) output.rect.offset_px -= upper_left;
  plan.size_px = glm::uvec2(lower_right - upper_left);
  if (!options.size_px) return plan;

  for (const OutputPicture& output : plan.outputs) {
    const bool packed = scene::frame_packing(output.composition.mode).has_value();
    if (packed && plan.size_px != *options.size_px) {
      return core::failure(ErrorCategory::WrongUsage,
                           fmt::format("--size: {} is exactly {}x{} pixels with this wall; leave --size out",
                                       scene::name_of(output.composition.mode), plan.size_px.x, plan.size_px.y));
    }
  }
  scale_to(*options.size_px, plan);
  return plan;
}

core::Result<std::array<scene::EyeView, 2>> eyes_before(const scene::Screen& screen, const scene::HeadPose& head,
                                                        double ipd_m) {
  std::array<scene::EyeView, 2> eyes;
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    const auto view = scene::off_axis_view(screen, scene::eye_position(head, scene::kEyes[i], ipd_m),
                                           scene::DepthConvention::VulkanReversedInfinite, scene::kNearM, 0.0);
    if (!view) return tl::unexpected(view.error());
    eyes[i] = *view;
  }
  return eyes;
}

std::uint32_t affordable_samples(render::Context& context, glm::uvec2 eye_px) {
  const std::uint32_t samples = render::samples_within_memory(context, eye_px);
  if (samples < 4) {
    core::log_line(fmt::format("one sample a pixel: {} has no memory for four in eye images of {}x{} pixels",
                               context.device_name(), eye_px.x, eye_px.y));
  }
  return samples;
}

render::RendererOptions renderer_options(render::Context& context, const WallPlan& plan, double panel_millimetre_m) {
  const OutputPicture& first = plan.outputs.front();
  const glm::uvec2 eye_px = scene::eye_size(first.composition.mode, first.rect.size_px);
  constexpr std::uint32_t kLeastPanels = 64,
                          kMostPanels = 8192;  // size of the eye images above which letters get no sharper
  render::RendererOptions options;
  options.eye_width = eye_px.x;
  options.eye_height = eye_px.y;
  glm::uvec2 largest(0);
  for (const OutputPicture& output : plan.outputs) {
    const glm::uvec2 size = scene::eye_size(output.composition.mode, output.rect.size_px);
    if (render::eye_memory_bytes(size, 4) > render::eye_memory_bytes(largest, 4)) largest = size;
  }
  options.samples = affordable_samples(context, largest);
  options.panel_texels_per_m = 0.0;
  for (const OutputPicture& output : plan.outputs) {
    const std::uint32_t across = scene::eye_size(output.composition.mode, output.rect.size_px).x;
    options.panel_texels_per_m = std::max(
        options.panel_texels_per_m, 2.0 * std::clamp(across, kLeastPanels, kMostPanels) / output.screen.width_m());
  }
  options.panel_millimetre_m = panel_millimetre_m;
  return options;
}

core::Result<std::vector<render::Image>> draw_wall(render::Renderer& renderer, const WallPlan& plan,
                                                   const scene::Viewer& viewer, const PictureOptions& options,
                                                   const BuildFrame& build) {
  const bool two = std::any_of(plan.outputs.begin(), plan.outputs.end(), [](const OutputPicture& output) {
    return scene::has_two_pictures(output.composition.mode);
  });
  std::vector<render::Image> pictures(two ? 2 : 1, black(plan.size_px));
  for (const OutputPicture& output : plan.outputs) {
    const StereoMode mode = output.composition.mode;
    const double ipd_m = mode == StereoMode::Mono ? 0.0 : options.ipd_m.value_or(viewer.ipd_m);
    const auto eyes = eyes_before(output.screen, viewer.sweet_spot, ipd_m);
    if (!eyes) return tl::unexpected(eyes.error());
    const glm::uvec2 eye_px = scene::eye_size(mode, output.rect.size_px);
    if (auto resized = renderer.resize(eye_px.x, eye_px.y); !resized) return tl::unexpected(resized.error());
    renderer.render(build(output, *eyes));
    const render::ReadArea area{.size_px = output.rect.size_px, .screen_px = output.rect.offset_px};
    const glm::uvec2 at(output.rect.offset_px);
    if (scene::has_two_pictures(mode)) {
      const auto pair = renderer.read_pair(output.composition, area);
      for (std::size_t i = 0; i < pictures.size(); ++i) blit(pair.at(i), at, pictures[i]);
    } else {
      const render::Image one = renderer.read_composed(output.composition, area);
      for (render::Image& picture : pictures) blit(one, at, picture);
    }
  }
  return pictures;
}

core::Result<void> write_wall(const std::vector<render::Image>& pictures, const std::string& path) {
  if (pictures.size() == 1) return render::write_png(pictures.front(), path);
  const std::filesystem::path whole(path);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const std::string name = whole.stem().string() + (i == 0 ? "-left" : "-right") + whole.extension().string();
    if (auto written = render::write_png(pictures[i], whole.parent_path() / name); !written) return written;
  }
  return {};
}

core::Result<void> check_picture_size(glm::uvec2 size_px, std::uint32_t largest) {
  if (size_px.x > 0 && size_px.y > 0 && size_px.x <= largest && size_px.y <= largest) return {};
  return core::failure(
      ErrorCategory::WrongUsage,
      fmt::format("--size: {}x{} pixels cannot be drawn here; choose 1 to {} each way", size_px.x, size_px.y, largest));
}

}  // namespace afm::exhibit
