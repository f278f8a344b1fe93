// SPDX-License-Identifier: Apache-2.0
#include "passes/scene_textures.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "device/barriers.h"

namespace afm::render {
namespace {

constexpr ImageUse kLevelUnused{vk::PipelineStageFlagBits2::eNone, vk::AccessFlagBits2::eNone,
                                vk::ImageLayout::eUndefined};
constexpr ImageUse kLevelWritten{vk::PipelineStageFlagBits2::eAllTransfer, vk::AccessFlagBits2::eTransferWrite,
                                 vk::ImageLayout::eTransferDstOptimal};
constexpr ImageUse kLevelRead{vk::PipelineStageFlagBits2::eAllTransfer, vk::AccessFlagBits2::eTransferRead,
                              vk::ImageLayout::eTransferSrcOptimal};
constexpr ImageUse kTextureSampled{vk::PipelineStageFlagBits2::eFragmentShader, vk::AccessFlagBits2::eShaderSampledRead,
                                   vk::ImageLayout::eShaderReadOnlyOptimal};

vk::ImageMemoryBarrier2 level_barrier(vk::Image image, std::uint32_t level, const ImageUse& before,
                                      const ImageUse& after) {
  auto barrier = image_barrier(image, kColorAspect, before, after);
  barrier.subresourceRange.baseMipLevel = level;
  barrier.subresourceRange.levelCount = 1;
  return barrier;
}

vk::Offset3D corner(vk::Extent2D extent, std::uint32_t level) {
  return {static_cast<std::int32_t>(std::max(extent.width >> level, 1U)),
          static_cast<std::int32_t>(std::max(extent.height >> level, 1U)), 1};
}

// Computes each level from the one above; blits of an sRGB image average light instead of encoded values.
void record_mipmaps(const vk::raii::CommandBuffer& command, const DeviceImage& image, std::uint32_t levels) {
  for (std::uint32_t level = 1; level < levels; ++level) {
    record_barriers(command, {level_barrier(*image.image, level - 1, kLevelWritten, kLevelRead)});
    vk::ImageBlit blit{.srcSubresource = {.aspectMask = kColorAspect, .mipLevel = level - 1, .layerCount = 1},
                       .dstSubresource = {.aspectMask = kColorAspect, .mipLevel = level, .layerCount = 1}};
    blit.srcOffsets[1] = corner(image.extent, level - 1);
    blit.dstOffsets[1] = corner(image.extent, level);
    command.blitImage(*image.image, vk::ImageLayout::eTransferSrcOptimal, *image.image,
                      vk::ImageLayout::eTransferDstOptimal, blit, vk::Filter::eLinear);
    record_barriers(command, {level_barrier(*image.image, level - 1, kLevelRead, kTextureSampled)});
  }
  record_barriers(command, {level_barrier(*image.image, levels - 1, kLevelWritten, kTextureSampled)});
}

vk::Filter filter(scene::TextureFilter wanted) {
  return wanted == scene::TextureFilter::Nearest ? vk::Filter::eNearest : vk::Filter::eLinear;
}

vk::SamplerAddressMode address(scene::TextureWrap wrap) {
  switch (wrap) {
    case scene::TextureWrap::MirroredRepeat:
      return vk::SamplerAddressMode::eMirroredRepeat;
    case scene::TextureWrap::ClampToEdge:
      return vk::SamplerAddressMode::eClampToEdge;
    default:
      return vk::SamplerAddressMode::eRepeat;
  }
}

vk::raii::Sampler create_sampler(const Device& device, const scene::Texture& texture) {
  const bool smooth = texture.between_mips == scene::TextureFilter::Linear;
  return vk::raii::Sampler(*device, vk::SamplerCreateInfo{.magFilter = filter(texture.magnified),
                                                          .minFilter = filter(texture.minified),
                                                          .mipmapMode = smooth ? vk::SamplerMipmapMode::eLinear
                                                                               : vk::SamplerMipmapMode::eNearest,
                                                          .addressModeU = address(texture.wrap_u),
                                                          .addressModeV = address(texture.wrap_v),
                                                          .maxLod = texture.between_mips ? VK_LOD_CLAMP_NONE : 0.25F});
}

}  // namespace

SceneTextures::Uploaded SceneTextures::upload(const Device& device, const scene::Image& image, bool srgb) {
  using Usage = vk::ImageUsageFlagBits;
  const std::uint32_t levels = static_cast<std::uint32_t>(std::bit_width(std::max(image.width, image.height)));
  Uploaded uploaded;
  uploaded.image = create_image(device, "texture " + image.name,
                                {.format = srgb ? vk::Format::eR8G8B8A8Srgb : vk::Format::eR8G8B8A8Unorm,
                                 .extent = {image.width, image.height},
                                 .usage = Usage::eTransferDst | Usage::eTransferSrc | Usage::eSampled,
                                 .mip_levels = levels});
  uploaded.view = create_view(device, uploaded.image, kColorAspect, 0, 1);
  const Buffer staging =
      create_host_buffer(device, "texture staging", image.rgba.size(), vk::BufferUsageFlagBits::eTransferSrc);
  std::memcpy(staging.mapped, image.rgba.data(), image.rgba.size());
  device.run_once([&](const vk::raii::CommandBuffer& command) {
    record_barriers(command, {image_barrier(*uploaded.image.image, kColorAspect, kLevelUnused, kLevelWritten)});
    command.copyBufferToImage(
        *staging.buffer, *uploaded.image.image, vk::ImageLayout::eTransferDstOptimal,
        vk::BufferImageCopy{.imageSubresource = {.aspectMask = kColorAspect, .mipLevel = 0, .layerCount = 1},
                            .imageExtent = {image.width, image.height, 1}});
    record_mipmaps(command, uploaded.image, levels);
  });
  return uploaded;
}

SceneTextures::SceneTextures(const Device& device, const scene::Scene& scene)
    : white_(upload(device, {.name = "white", .width = 1, .height = 1, .rgba = {255, 255, 255, 255}}, false)),
      white_sampler_(create_sampler(device, {})) {
  for (const scene::Texture& texture : scene.textures) {
    image_of_.push_back(texture.image);
    samplers_.push_back(create_sampler(device, texture));
  }
  for (const scene::PbrMaterial& material : scene.materials) {
    for (std::size_t slot = 0; slot < scene::kTextureSlots; ++slot) {
      const auto& texture = material.textures[slot].texture;
      if (!texture) {
        continue;
      }
      const std::pair key(image_of_.at(*texture), scene::kTextureSlotTraits[slot].is_srgb);
      if (images_.find(key) == images_.end()) {
        images_.emplace(key, upload(device, scene.images.at(key.first), key.second));
      }
    }
  }
}

vk::DescriptorImageInfo SceneTextures::descriptor(std::uint32_t texture, bool srgb) const {
  return {.sampler = *samplers_[texture],
          .imageView = *images_.at({image_of_[texture], srgb}).view,
          .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
}

vk::DescriptorImageInfo SceneTextures::white() const {
  return {
      .sampler = *white_sampler_, .imageView = *white_.view, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
}

}  // namespace afm::render
