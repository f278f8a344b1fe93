// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "device/barriers.h"
#include "device/memory.h"
#include "passes/eye_pipelines.h"
#include "passes/pixel_area.h"
#include "render/renderer.h"

namespace afm::render {

// Holds sRGB values, see tone.glsl. In the order in which windows have their bytes, so that a picture can be copied
// there.
inline constexpr vk::Format kEyeFormat = vk::Format::eB8G8R8A8Unorm;
inline constexpr vk::Format kEyeLinearFormat = vk::Format::eB8G8R8A8Srgb;  // sampled and filtered as linear light
inline constexpr vk::Format kDepthFormat = vk::Format::eD32Sfloat;
inline constexpr std::uint32_t kBothEyes = 0b11;  // the view mask of a multiview pass

// Settings for drawing the eyes of one frame.
struct EyePassConfig {
  EyePass pass = EyePass::Both;
  std::size_t pass_count = 1;  // of single passes: 2, or 1 where both eyes see the same
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  vk::Extent2D extent{};  // drawn, from the upper left corner on

  bool operator==(const EyePassConfig&) const = default;
};

// The images that eyes are drawn into: colour and depth of two layers, the left eye's first. What is drawn with more
// samples goes through attachments that are made when first needed. All of them keep what is drawn, so that a part of
// it can be drawn again. Mesa 22.3's lavapipe neither draws into layer 1 of a multisampled image as a base layer, nor
// resolves into one: so single passes have attachments of one layer each, and the second one resolves into separate
// images, which are copied.
class EyeTargets {
 public:
  EyeTargets(const Device& device, const RendererOptions& options);

  vk::Extent2D extent() const { return extent_; }

  // Ratio of the viewport to the eye image; clip space is shrunk by the same factor, so that the picture stays and
  // triangles across its border are cut by the scissor instead of being clipped, which some devices do wrong (see
  // Device::clips_first_view_only()).
  float guard_band() const { return guard_band_; }

  // To be called before a frame is recorded; from then on the getters below speak of that frame.
  void begin_frame(const EyePassConfig& drawing);

  // Everything between them is drawn into the eyes of that pass, all of them or what lies in the box: it holds then
  // what was drawn before. Viewport and scissor are set. Afterwards the eye images can be sampled.
  void begin(const vk::raii::CommandBuffer& command, std::size_t pass, const std::optional<PixelBox>& box) const;
  void end(const vk::raii::CommandBuffer& command, std::size_t pass, const std::optional<PixelBox>& box) const;

  const EyePassConfig& drawing() const { return drawing_; }

  // Both eyes see the same, and it lies in the left one's images.
  bool same_eyes() const { return drawing_.pass == EyePass::Single && drawing_.pass_count == 1; }

  struct EyeImage {
    vk::Image image;
    std::uint32_t layer = 0;
  };
  // Only drawing().extent of it is drawn.
  EyeImage eye(scene::Eye eye) const;

  // Copies a box of an eye's colour into an image that lies in eTransferDstOptimal and shows the eye's first pixel at
  // `place`; between begin_copies() and end_copies().
  void begin_copies(const vk::raii::CommandBuffer& command) const;
  void copy(const vk::raii::CommandBuffer& command, scene::Eye eye, const PixelBox& box, vk::Image to,
            std::uint32_t layer, vk::Offset2D place) const;
  void end_copies(const vk::raii::CommandBuffer& command) const;

  // Copies an eye's depth, as depth() has it, into an image that lies in eTransferDstOptimal.
  void copy_depth(const vk::raii::CommandBuffer& command, scene::Eye eye, vk::Image to, std::uint32_t layer) const;

  // Of the colour in both layers, the left eye's first: as it is stored, and in kEyeLinearFormat. Where both eyes see
  // the same, only the first is drawn.
  vk::ImageView both_eyes() const { return *color_.both; }
  vk::ImageView both_eyes_linear() const { return *color_.linear; }

  // Reversed infinite depth of each pixel's first sample, 0 where nothing was drawn; kDepthFormat, of this eye alone,
  // to be sampled in eShaderReadOnlyOptimal.
  vk::ImageView depth(scene::Eye eye) const { return *depth_.single[layer(eye)]; }

 private:
  struct Target {
    DeviceImage image;
    vk::raii::ImageView both{nullptr}, linear{nullptr};  // the latter of colour alone
    std::vector<vk::raii::ImageView> single;             // one a layer
  };
  struct Multisampled {
    DeviceImage color, depth;
    vk::raii::ImageView color_view{nullptr}, depth_view{nullptr};
  };
  // Layers that a pass fills: both or one.
  struct Filled {
    const Target& color;
    const Target& depth;
    std::uint32_t layer = 0;
    LayerRange layers;
  };
  Filled filled(std::size_t pass) const;
  bool copies(std::size_t pass) const { return resolves() && pass == 1; }
  void copy_second(const vk::raii::CommandBuffer& command, const PixelBox& box) const;
  Target create_target(const char* name, vk::Format format, std::uint32_t layers) const;
  Multisampled create_multisampled(std::uint32_t layers) const;
  const Multisampled& multisampled(std::size_t pass) const {
    return multisampled_[drawing_.pass == EyePass::Both ? 0 : 1 + pass];
  }
  std::uint32_t layer(scene::Eye eye) const { return eye == scene::Eye::Left || same_eyes() ? 0 : 1; }
  bool resolves() const { return drawing_.samples != vk::SampleCountFlagBits::e1; }

  const Device* device_;
  vk::Extent2D extent_;
  float guard_band_ = 1.0F;
  Target color_;
  Target depth_;
  Target second_color_;  // where the second of two passes resolves into
  Target second_depth_;
  std::array<Multisampled, 3> multisampled_;  // of two layers, and of one for each pass
  EyePassConfig drawing_;
};

}  // namespace afm::render
