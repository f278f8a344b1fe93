// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/result.h"
#include "haptics/particle_scale.h"
#include "scene/shared/push_tools.h"

namespace afm::scene {
class SharedSegment;
}

namespace afm::haptics {

class FeltParticles;

// Scale of particles, valid ones, with a tool that they allow (scene::tool_refusal). Fails where particle_scale() does,
// and where the tip would be free only above the device.
core::Result<ParticleScale> tool_scale(const scene::SharedParticles& particles, scene::PushTool tool,
                                       const DeviceSpec& device);

// The particles on the sample with the tool in use, and the same with the other tool, built in advance if set, lever
// and device allow it. Empty without particles.
//
// create() allocates; everything else may be called in a tick of the servo, by its thread.
class FeltTools {
 public:
  // Continues where a predecessor in this segment left the particles, which are valid; `scale` is their
  // particle_scale().
  static FeltTools create(scene::SharedSegment& segment, const scene::SharedParticles& particles,
                          const ParticleScale& scale, const DeviceSpec& device);

  FeltTools();
  FeltTools(FeltTools&& other) noexcept;
  FeltTools& operator=(FeltTools&& other) noexcept;
  ~FeltTools();

  explicit operator bool() const noexcept { return used_ != nullptr; }
  FeltParticles* get() const noexcept { return used_.get(); }
  FeltParticles* operator->() const noexcept { return used_.get(); }

  // In use: Push or Grip; OfSet without particles.
  scene::PushTool tool() const noexcept { return tool_; }

  // True if this one can be used, and is not.
  bool changes(scene::PushTool wanted) const noexcept;

  // Uses the other tool: all particles stay where they are, and their strokes can still be taken back. Only without
  // force, and if changes() says so.
  void change() noexcept;

 private:
  std::unique_ptr<FeltParticles> used_, spare_;  // null: none
  scene::PushTool own_ = scene::PushTool::OfSet;
  scene::PushTool tool_ = scene::PushTool::OfSet;
};

}  // namespace afm::haptics
