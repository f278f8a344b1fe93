// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "memory.h"
#include "render/renderer.h"

namespace afm::render {

inline constexpr vk::Format kEyeFormat = vk::Format::eR8G8B8A8Unorm;  // holds sRGB values, see tone.glsl
inline constexpr vk::Format kDepthFormat = vk::Format::eD32Sfloat;

// The images that eyes are drawn into. With Multiview one set of two layers; with TwoPasses a set for each eye, because
// Mesa 22.3's lavapipe leaves garbage in layer 1 of a multisampled image that is drawn as a base layer.
class EyeTargets {
 public:
  EyeTargets(const Device& device, const RendererOptions& options);

  std::size_t pass_count() const { return sets_.size(); }
  std::uint32_t view_mask() const { return sets_.size() == 1 ? 0b11U : 0U; }
  vk::Extent2D extent() const { return extent_; }
  vk::SampleCountFlagBits samples() const { return samples_; }

  // How much larger than the eye image the viewport is; clip space is shrunk by as much, so that the picture stays and
  // triangles across its border are cut by the scissor instead of being clipped. Mesa 22.3's lavapipe draws a clipped
  // triangle into the first view of a multiview pass only; what crosses the near plane is still lost there.
  float guard_band() const { return guard_band_; }

  // Everything between them is drawn into the eyes of that pass; viewport and scissor are set. Afterwards the eye
  // images can be sampled.
  void begin(const vk::raii::CommandBuffer& command, std::size_t pass) const;
  void end(const vk::raii::CommandBuffer& command, std::size_t pass) const;

  struct EyeImage {
    vk::Image image;
    std::uint32_t layer = 0;
    vk::ImageView view;  // of this eye alone
  };
  EyeImage eye(scene::Eye eye) const;

  // Reversed infinite depth of each pixel's first sample, 0 where nothing was drawn; kDepthFormat, as eye() sampled or
  // copied from in eShaderReadOnlyOptimal.
  EyeImage depth(scene::Eye eye) const;

 private:
  struct Set {
    DeviceImage multisampled;  // this and its depth are unused at one sample
    DeviceImage multisampled_depth;
    DeviceImage depth;
    DeviceImage resolved;
    vk::raii::ImageView multisampled_view{nullptr};
    vk::raii::ImageView multisampled_depth_view{nullptr};
    vk::raii::ImageView depth_view{nullptr};
    vk::raii::ImageView resolved_view{nullptr};
    std::vector<vk::raii::ImageView> eye_views;  // one a layer
    std::vector<vk::raii::ImageView> eye_depth_views;
  };
  struct Place {
    const Set* set = nullptr;
    std::uint32_t layer = 0;
  };
  Place place(scene::Eye eye) const;
  Set create_set(const Device& device, std::uint32_t layers) const;

  vk::Extent2D extent_;
  vk::SampleCountFlagBits samples_ = vk::SampleCountFlagBits::e1;
  float guard_band_ = 1.0F;
  std::vector<Set> sets_;
};

}  // namespace afm::render
