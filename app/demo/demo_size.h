// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/sample_model.h"
#include "render/renderer.h"

namespace afm::core {
class Clock;
}
namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

// Renderer of the demonstration's live run, and its size.
struct DemoRenderer {
  render::Renderer renderer;
  render::RendererOptions options;
  double frame_budget_ms = 0;  // time per frame; 0: no budget
  std::string size_reason;     // reason for a size below the usual one; empty: usual or fixed size
};

// Creates the renderer for a size that a person has fixed, or for the usual one. If there is a budget but no fixed
// size, measures some frames with a moving tip first, and draws fewer pixels if they take too long.
core::Result<DemoRenderer> create_demo_renderer(render::Context& context, const exhibit::Stage& stage,
                                                const std::vector<curves::SampleModel>& materials,
                                                std::uint32_t fixed_eye_width, std::optional<double> frame_budget_ms,
                                                const core::Clock& clock);

// Width that keeps a frame within the budget if its time follows its number of pixels; at most the usual width.
std::uint32_t fitting_eye_width(double frame_ms_at_usual_width, double budget_ms);

inline constexpr std::uint32_t kUsualEyeWidth = 960, kLeastEyeWidth = 320;

}  // namespace afm::app
