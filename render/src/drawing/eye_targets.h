// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "device/barriers.h"
#include "device/memory.h"
#include "drawing/eye_pipelines.h"
#include "drawing/pixel_area.h"
#include "render/renderer.h"

namespace afm::render {

// Contains sRGB values, see tone.glsl. Has the byte order of windows, so that a picture can be copied to them.
inline constexpr vk::Format kEyeFormat = vk::Format::eB8G8R8A8Unorm;
inline constexpr vk::Format kEyeLinearFormat = vk::Format::eB8G8R8A8Srgb;  // sampled and filtered as linear light
inline constexpr vk::Format kDepthFormat = vk::Format::eD32Sfloat;
inline constexpr std::uint32_t kBothEyes = 0b11;  // view mask of a multiview pass
// Background of Lighting::KeyAlone.
inline constexpr vk::ClearColorValue kPlainBackground{std::array{0.25F, 0.27F, 0.31F, 1.0F}};

// Settings for drawing the eyes of one frame.
struct EyePassConfig {
  EyePass pass = EyePass::Both;
  std::size_t pass_count = 1;  // 2 with single passes; 1 if both eyes see the same
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  vk::Extent2D extent{};  // size of the drawn room: the eye image's, or less

  bool operator==(const EyePassConfig&) const = default;
};

// Images that the eyes are drawn into: colour and depth in two layers, the left eye's first. Attachments for more
// samples are created at first use. All of them keep their contents, so that a part can be redrawn. Mesa 22.3's
// lavapipe neither draws into layer 1 of a multisampled image as a base layer, nor resolves into one. Single passes
// therefore have attachments of one layer each, and the second pass resolves into separate images, which are copied.
// A room drawn with fewer pixels goes into the upper left part of separate images, which are enlarged into the eyes'
// images before the panels are drawn.
class EyeTargets {
 public:
  EyeTargets(const Device& device, const RendererOptions& options);

  vk::Extent2D extent() const { return extent_; }

  // Ratio of the viewport to the eye image. Clip space shrinks by the same factor, so the picture stays the same, but
  // the scissor cuts triangles at its border instead of clipping, which some devices do wrong (see
  // Device::clips_first_view_only()).
  float guard_band() const { return guard_band_; }

  // Call before recording a frame; the getters below then describe that frame.
  void begin_frame(const EyePassConfig& drawing);

  // Between begin() and end(), draws go into the eyes of that pass: everything, or only the box, whose old contents are
  // kept. Sets viewport and scissor. The eye images can be sampled afterwards.
  void begin(const vk::raii::CommandBuffer& command, std::size_t pass, const std::optional<PixelBox>& box) const;
  void end(const vk::raii::CommandBuffer& command, std::size_t pass, const std::optional<PixelBox>& box) const;

  // Same for the eye images' own pixels, into which the room is enlarged. Keeps nothing of the box. Its
  // depth is that of the pass, which the enlargement fills.
  void begin_enlarged(const vk::raii::CommandBuffer& command, std::size_t pass,
                      const std::optional<PixelBox>& box) const;
  void end_enlarged(const vk::raii::CommandBuffer& command, std::size_t pass) const;

  const EyePassConfig& drawing() const { return drawing_; }

  // True if the room is drawn with fewer pixels than the eye images have.
  bool reduced() const { return drawing_.extent != extent_; }

  // Area of the eye images that depends on an area of the drawn room.
  PixelArea enlarged(const PixelArea& drawn) const;

  // Colour and depth of the reduced room, sampled in eShaderReadOnlyOptimal.
  vk::ImageView room() const { return *reduced_color_.both; }
  vk::ImageView room_depth() const { return *depth_.both; }

  // True if both eyes see the same, which is stored in the left eye's images.
  bool same_eyes() const { return drawing_.pass == EyePass::Single && drawing_.pass_count == 1; }

  struct EyeImage {
    vk::Image image;
    std::uint32_t layer = 0;
  };
  EyeImage eye(scene::Eye eye) const;

  // Copies a box of an eye's colour into an image in eTransferDstOptimal that shows the eye's first pixel at `place`.
  // Call between begin_copies() and end_copies().
  void begin_copies(const vk::raii::CommandBuffer& command) const;
  void copy(const vk::raii::CommandBuffer& command, scene::Eye eye, const PixelBox& box, vk::Image to,
            std::uint32_t layer, vk::Offset2D place) const;
  void end_copies(const vk::raii::CommandBuffer& command) const;

  // Copies an eye's depth of drawing().extent, as in depth(), into an image in eTransferDstOptimal.
  void copy_depth(const vk::raii::CommandBuffer& command, scene::Eye eye, vk::Image to, std::uint32_t layer) const;

  // Colour of both layers, the left eye's first: as stored, and in kEyeLinearFormat. If both eyes see the same, only
  // the first layer is drawn.
  vk::ImageView both_eyes() const { return *color_.both; }
  vk::ImageView both_eyes_linear() const { return *color_.linear; }

  // Reversed infinite depth of each drawn pixel's first sample, 0 where nothing was drawn. View of this eye only, in
  // kDepthFormat, sampled in eShaderReadOnlyOptimal.
  vk::ImageView depth(scene::Eye eye) const { return *depth_.single[layer(eye)]; }

 private:
  struct Target {
    DeviceImage image;
    vk::raii::ImageView both{nullptr}, linear{nullptr};  // views of both layers; `linear` only for colour
    std::vector<vk::raii::ImageView> single;             // one per layer
  };
  struct Multisampled {
    DeviceImage color, depth;
    vk::raii::ImageView color_view{nullptr}, depth_view{nullptr};
  };
  // Layers that a pass draws into: both or one.
  struct Filled {
    const Target& color;
    const Target& depth;
    std::uint32_t layer = 0;
    LayerRange layers;
  };
  Filled filled(std::size_t pass) const;
  const Target& drawn_color() const { return reduced() ? reduced_color_ : color_; }
  LayerRange layers_of(std::size_t pass) const;
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
  bool plain_background_;
  Target color_;
  Target depth_;
  Target second_color_;  // resolve target of the second single pass
  Target second_depth_;
  Target reduced_color_;                      // reduced room; its depth is in depth_
  Target enlarged_depth_;                     // depth of the enlarged room
  std::array<Multisampled, 3> multisampled_;  // one with two layers, then one for each single pass
  EyePassConfig drawing_;
};

}  // namespace afm::render
