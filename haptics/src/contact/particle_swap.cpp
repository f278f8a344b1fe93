// SPDX-License-Identifier: Apache-2.0
#include "haptics/felt_particles.h"

#include <fmt/core.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/log.h"
#include "haptics/felt_groove.h"
#include "haptics/scaling.h"
#include "scene/shared/push_values.h"
#include "scene/shared/shared_segment.h"

namespace afm::haptics {

using scene::PushSettings;
using scene::SharedParticles;

namespace {

std::unique_ptr<SharedParticles> with_settings(const SharedParticles& particles, const PushSettings& settings) {
  auto adjusted = std::make_unique<SharedParticles>(particles);
  scene::adjust(settings, *adjusted);
  return adjusted;
}

core::Result<ParticleScale> scale_of(const SharedParticles& adjusted, const DeviceSpec& device) {
  auto scale = particle_scale(adjusted, device);
  if (!scale) return scale;
  if (auto clear = Scaling::check_clear(*scale, device); !clear) return tl::unexpected(clear.error());
  return scale;
}

// Restores the particles to the state left by a predecessor.
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

struct ParticleSwap::Built {
  Built(const PushSettings& with, const SharedParticles& particles, const ParticleScale& scale,
        const DeviceSpec& device)
      : settings(with), felt(particles, scale, groove_limits(device)) {}

  PushSettings settings;  // complete settings of these particles
  FeltParticles felt;
};

core::Result<ParticleScale> adjusted_scale(const SharedParticles& particles, const PushSettings& settings,
                                           const DeviceSpec& device) {
  return scale_of(*with_settings(particles, settings), device);
}

std::unique_ptr<ParticleSwap> ParticleSwap::create(scene::SharedSegment& segment, const SharedParticles& particles,
                                                   const ParticleScale& scale, const DeviceSpec& device) {
  auto swap = std::make_unique<ParticleSwap>();
  if (particles.count == 0) return swap;
  swap->particles_ = std::make_unique<const SharedParticles>(particles);
  swap->device_ = device;
  swap->own_ = scene::own_tool(scene::push_setup(particles));
  swap->settings_ = swap->built_ = swap->in_full({});
  swap->used_ = std::make_unique<Built>(swap->settings_, particles, scale, device);
  resume(swap->used_->felt, segment);
  return swap;
}

ParticleSwap::ParticleSwap() = default;

ParticleSwap::~ParticleSwap() {
  delete offered_.load();
  delete retired_.load();
}

FeltParticles* ParticleSwap::used() const noexcept { return used_ ? &used_->felt : nullptr; }

PushSettings ParticleSwap::in_full(const PushSettings& wanted) const noexcept {
  PushSettings full = wanted;
  if (full.tool == scene::PushTool::OfSet) full.tool = own_;
  return full;
}

bool ParticleSwap::changes(const PushSettings& wanted) noexcept {
  if (!used_) return false;
  if (!ready_ && offered_.load(std::memory_order_relaxed) != nullptr) {
    ready_.reset(offered_.exchange(nullptr, std::memory_order_acquire));
  }
  if (!ready_ || retired_.load(std::memory_order_relaxed) != nullptr) return false;
  if (ready_->settings == in_full(wanted) && ready_->settings != settings_) return true;
  retired_.store(ready_.release(), std::memory_order_release);  // no longer requested
  return false;
}

void ParticleSwap::change() noexcept {
  ready_->felt.take_over(used_->felt);
  std::swap(used_, ready_);
  settings_ = used_->settings;
  retired_.store(ready_.release(), std::memory_order_release);
}

void ParticleSwap::build(const PushSettings& wanted) {
  delete retired_.exchange(nullptr, std::memory_order_acquire);
  if (!particles_ || in_full(wanted) == built_) return;
  built_ = in_full(wanted);
  const auto leave = [](const std::string& why) {
    core::log_line(fmt::format("the settings among the particles are unchanged: {}", why));
  };
  if (const auto refused = scene::refusal(*particles_, built_)) return leave(refused->text);
  const auto adjusted = with_settings(*particles_, built_);
  const auto scale = scale_of(*adjusted, device_);
  if (!scale) return leave(scale.error().message);
  auto built = std::make_unique<Built>(built_, *adjusted, *scale, device_);
  delete offered_.exchange(built.release(), std::memory_order_acq_rel);
}

}  // namespace afm::haptics
