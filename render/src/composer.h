// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "eye_targets.h"
#include "render/composition.h"
#include "render/frame.h"
#include "render/renderer.h"

namespace afm::render {

// Where a picture is drawn.
struct ComposePlace {
  vk::Extent2D target;      // the whole image
  vk::Rect2D area;          // what the picture fills
  glm::ivec2 screen_px{0};  // where the target's first pixel lies on its screen
  std::uint32_t layer = 0;  // of modes with two pictures: 1 is the right eye's place
};

// Puts the two eye images into one picture: byte for byte where it is drawn at its own size. Every stereo mode is a
// mode of one full-screen shader.
class Composer {
 public:
  Composer(const Device& device, const EyeTargets& eyes);

  // The picture, or both, of the eyes' newest contents; waits for it. The device can make an image of that size.
  std::vector<Image> compose(const Composition& composition, const ReadArea& area);

  // To be called when the eye images have been made anew and nothing is in flight.
  void eyes_changed();

  // The picture's own size.
  vk::Extent2D extent(scene::StereoMode mode) const;

  // For targets of another format than the eyes'.
  vk::raii::Pipeline create_pipeline_for(vk::Format format) const;

  // Draws the picture, scaled to fill its area; inside a rendering of the target.
  void record(const vk::raii::CommandBuffer& command, vk::Pipeline pipeline, const Composition& composition,
              const ComposePlace& place) const;

 private:
  const DeviceImage& target(vk::Extent2D extent, std::uint32_t layers);

  const Device& device_;
  const EyeTargets& eyes_;
  vk::raii::DescriptorSetLayout set_layout_;
  vk::raii::PipelineLayout layout_;
  vk::raii::Pipeline pipeline_;
  vk::raii::Sampler sampler_;
  Buffer anaglyphs_;
  vk::raii::DescriptorPool pool_;
  vk::raii::DescriptorSet set_{nullptr};
  DeviceImage target_;  // of the last size that was asked for
};

}  // namespace afm::render
