// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/wall_drawing.h"

#include <utility>

namespace afm::exhibit {

WallDrawing::WallDrawing(const scene::Wall& wall, const PictureOptions& options, render::Context context, WallPlan plan)
    : wall_(&wall), options_(options), context_(std::move(context)), plan_(std::move(plan)) {}

core::Result<WallDrawing> WallDrawing::open(const scene::Wall& wall, const PictureOptions& options) {
  auto context = render::Context::open({.gpu = options.gpu});
  if (!context) return tl::unexpected(context.error());
  if (options.size_px) {
    const auto checked = check_picture_size(*options.size_px, context->largest_picture_px());
    if (!checked) return tl::unexpected(checked.error());
  }
  auto plan = plan_wall(wall, options);
  if (!plan) return tl::unexpected(plan.error());
  return WallDrawing(wall, options, std::move(*context), std::move(*plan));
}

core::Result<void> WallDrawing::write(const scene::Scene& scene, double panel_millimetre_m, const BuildFrame& build,
                                      const std::string& path) {
  auto renderer = render::Renderer::create(context_, scene, renderer_options(context_, plan_, panel_millimetre_m));
  if (!renderer) return tl::unexpected(renderer.error());
  const auto pictures = draw_wall(*renderer, plan_, wall_->viewers.front(), options_, build);
  if (!pictures) return tl::unexpected(pictures.error());
  return write_wall(*pictures, path);
}

}  // namespace afm::exhibit
