// SPDX-License-Identifier: Apache-2.0
#include "haptics/felt_particles.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "haptics/felt_groove.h"
#include "haptics/scaling.h"
#include "scene/shared/push_tools.h"
#include "scene/shared/shared_segment.h"

namespace afm::haptics {

namespace {

using scene::PushTool;

PushTool other_tool(PushTool tool) { return tool == PushTool::Grip ? PushTool::Push : PushTool::Grip; }

std::unique_ptr<scene::SharedParticles> with_tool(const scene::SharedParticles& particles, PushTool tool) {
  auto held = std::make_unique<scene::SharedParticles>(particles);
  scene::hold(tool, *held);
  return held;
}

// Where a predecessor left them.
void resume(FeltParticles& felt, scene::SharedSegment& segment) {
  const scene::ServoSide side = segment.servo_side();
  std::vector<scene::ParticlePage> pages;
  while (pages.size() < felt.pages().size()) {
    const auto page = side.last_particle_page(static_cast<std::uint32_t>(pages.size()));
    if (!page) return;
    pages.push_back(*page);
  }
  felt.resume(pages);
}

}  // namespace

core::Result<ParticleScale> tool_scale(const scene::SharedParticles& particles, PushTool tool,
                                       const DeviceSpec& device) {
  auto scale = particle_scale(*with_tool(particles, tool), device);
  if (!scale) return scale;
  if (auto clear = Scaling::check_clear(*scale, device); !clear) return tl::unexpected(clear.error());
  return scale;
}

std::unique_ptr<FeltTools> FeltTools::create(scene::SharedSegment& segment, const scene::SharedParticles& particles,
                                             const ParticleScale& scale, const DeviceSpec& device) {
  auto tools = std::make_unique<FeltTools>();
  if (particles.count == 0) return tools;
  tools->used_ = std::make_unique<FeltParticles>(particles, scale, groove_limits(device));
  resume(*tools->used_, segment);
  tools->own_ = tools->tool_ = scene::own_tool(scene::push_setup(particles));
  const PushTool other = other_tool(tools->own_);
  if (scene::tool_refusal(particles, other)) return tools;
  const auto other_scale = tool_scale(particles, other, device);
  if (!other_scale) return tools;
  tools->spare_ = std::make_unique<FeltParticles>(*with_tool(particles, other), *other_scale, groove_limits(device));
  return tools;
}

bool FeltTools::changes(PushTool wanted) const noexcept {
  return spare_ != nullptr && (wanted == PushTool::OfSet ? own_ : wanted) != tool_;
}

void FeltTools::change() noexcept {
  spare_->take_over(*used_);
  std::swap(used_, spare_);
  tool_ = other_tool(tool_);
}

}  // namespace afm::haptics
