// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "eye_targets.h"
#include "render/frame.h"
#include "render/renderer.h"

namespace afm::render {

// Puts the two eye images into one picture: byte for byte where it is drawn at its own size. Every layout is a mode of
// one full-screen shader.
class Composer {
 public:
  Composer(const Device& device, const EyeTargets& eyes);

  // The picture of the eyes' newest contents; waits for it.
  Image compose(Layout layout);

  // To be called when the eye images have been made anew and nothing is in flight.
  void eyes_changed();

  // The picture's own size.
  vk::Extent2D extent(Layout layout) const;

  // For targets of another format than the eyes'.
  vk::raii::Pipeline create_pipeline_for(vk::Format format) const;

  // Draws the picture into `place` of a target of `target` pixels, scaled to fill it; inside a rendering of that
  // target.
  void record(const vk::raii::CommandBuffer& command, vk::Pipeline pipeline, Layout layout, vk::Extent2D target,
              const vk::Rect2D& place) const;

 private:
  struct Target {
    DeviceImage image;
    vk::raii::ImageView view{nullptr};
  };
  const Target& target(Layout layout);

  const Device& device_;
  const EyeTargets& eyes_;
  vk::raii::DescriptorSetLayout set_layout_;
  vk::raii::PipelineLayout layout_;
  vk::raii::Pipeline pipeline_;
  vk::raii::Sampler sampler_;
  vk::raii::DescriptorPool pool_;
  vk::raii::DescriptorSet set_{nullptr};
  std::map<Layout, Target> targets_;  // made when first asked for
};

}  // namespace afm::render
