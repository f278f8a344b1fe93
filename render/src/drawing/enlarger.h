// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "drawing/eye_pipelines.h"
#include "drawing/eye_targets.h"

namespace afm::render {

// Enlarges a room that was drawn with fewer pixels into the eyes' images, so that everything drawn over it afterwards,
// such as small text, has all pixels.
class Enlarger {
 public:
  explicit Enlarger(const Device& device);

  // Call when the eye images have been recreated and nothing is in flight.
  void eyes_changed() { bound_ = false; }

  // Fills the scissor with colour and depth of the room; call between begin_enlarged() and end_enlarged() of the eyes.
  void record(const vk::raii::CommandBuffer& command, const EyeTargets& eyes, std::size_t pass);

 private:
  void bind(const EyeTargets& eyes);

  const Device& device_;
  vk::raii::DescriptorSetLayout set_layout_;
  vk::raii::PipelineLayout layout_;
  EyePipeline pipeline_;
  vk::raii::Sampler color_sampler_, depth_sampler_;
  vk::raii::DescriptorPool pool_;
  vk::raii::DescriptorSet set_{nullptr};
  bool bound_ = false;  // true: the set contains the current eye images
};

}  // namespace afm::render
