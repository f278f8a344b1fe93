// SPDX-License-Identifier: Apache-2.0
#include "app/demo/demo_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/options/dynamic_resolution.h"
#include "core/clock.h"
#include "core/percentiles.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "render/renderer.h"

namespace afm::app {

namespace {

constexpr int kTriedFrames = 7;
constexpr std::uint32_t kWidthStep = 16;  // in pixels

// Time of a typical frame while the tip moves, in ms. The first frame draws everything, and is not counted.
double measure_frame_ms(render::Renderer& renderer, const exhibit::Stage& stage,
                        const std::vector<curves::SampleModel>& materials, const core::Clock& clock) {
  const exhibit::FrameBuilder frames(stage.wall_scene, materials, stage.eyes);
  const std::vector<exhibit::CycleCurve> curves(materials.size());
  std::vector<double> taken_ms;
  for (int i = 0; i <= kTriedFrames; ++i) {
    exhibit::Moment moment;
    moment.curves = curves;
    moment.wall.material = 0;
    moment.wall.tip.z_m = materials.front().scaling.release_z_m() * (1.0 - 0.05 * i);
    const std::int64_t start_ns = clock.now_ns();
    renderer.render(frames.build(moment));
    renderer.wait();
    if (i > 0) taken_ms.push_back(static_cast<double>(clock.now_ns() - start_ns) * 1e-6);
  }
  return core::percentiles(std::move(taken_ms)).p50;
}

core::Result<DemoRenderer> create_with(render::Context& context, const exhibit::Stage& stage, std::uint32_t eye_width,
                                       double budget_ms) {
  render::RendererOptions options = stage.renderer_options(eye_width);
  options.time_passes = budget_ms > 0;
  auto renderer = render::Renderer::create(context, stage.wall_scene.scene(), options);
  if (!renderer) return tl::unexpected(renderer.error());
  return DemoRenderer{std::move(*renderer), options, budget_ms, {}};
}

}  // namespace

std::uint32_t fitting_eye_width(double frame_ms_at_usual_width, double budget_ms) {
  const double width = kUsualEyeWidth * std::sqrt(budget_ms / frame_ms_at_usual_width);
  const double stepped = kWidthStep * std::floor(width / kWidthStep);
  return static_cast<std::uint32_t>(std::clamp<double>(stepped, kLeastEyeWidth, kUsualEyeWidth));
}

core::Result<DemoRenderer> create_demo_renderer(render::Context& context, const exhibit::Stage& stage,
                                                const std::vector<curves::SampleModel>& materials,
                                                std::uint32_t fixed_eye_width, std::optional<double> given_budget_ms,
                                                const core::Clock& clock) {
  const bool fixed = fixed_eye_width > 0;
  const double budget_ms = frame_budget_ms(given_budget_ms, fixed, context);
  auto usual = create_with(context, stage, fixed ? fixed_eye_width : kUsualEyeWidth, budget_ms);
  if (!usual || fixed || budget_ms == 0) return usual;
  const double frame_ms = measure_frame_ms(usual->renderer, stage, materials, clock);
  const std::uint32_t width = fitting_eye_width(frame_ms, budget_ms);
  if (width == kUsualEyeWidth) return usual;
  auto smaller = create_with(context, stage, width, budget_ms);
  if (!smaller) return smaller;
  smaller->size_reason = fmt::format(": a frame of {} x {} took {:.0f} ms; --eye-width fixes the size",
                                     usual->options.eye_width, usual->options.eye_height, frame_ms);
  return smaller;
}

}  // namespace afm::app
