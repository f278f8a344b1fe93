// SPDX-License-Identifier: Apache-2.0
#include "composition/corrections.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/common.hpp>
#include <iterator>
#include <span>

#include "device/barriers.h"
#include "device/shader_interface.h"

namespace afm::render {
namespace {

// Sizes kept for one mesh and blending: two windows, a saved picture, and a spare.
constexpr std::ptrdiff_t kMostKept = 4;

constexpr int kTilePx = 64;

constexpr ImageUse kFreshMap{};
constexpr ImageUse kSampledMap{vk::PipelineStageFlagBits2::eFragmentShader, vk::AccessFlagBits2::eShaderSampledRead,
                               vk::ImageLayout::eShaderReadOnlyOptimal};

static_assert(scene::Blend::kMostScreens == AFM_MOST_BLENDED);

BlendBlock blend_block(const scene::Blend* blend) {
  BlendBlock block{};
  if (blend == nullptr) return block;
  const auto by_edge = [](const std::array<double, 4>& v) { return glm::vec4(v[0], v[1], v[2], v[3]); };
  for (std::size_t i = 0; i < blend->fields.size(); ++i) {
    const scene::Blend::Field& field = blend->fields[i];
    block.box[i] = glm::vec4(glm::dvec4(field.low, field.high));
    block.begin[i] = by_edge(field.begin);
    block.width[i] = by_edge(field.width);
    block.black[i].x = static_cast<float>(field.black);
  }
  block.light = glm::vec4(blend->fields.size(), blend->gamma.value_or(0.0), blend->brightest_black,
                          1.0 - (blend->brightest_black - blend->darkest_black));
  return block;
}

vk::raii::DescriptorSetLayout create_correction_layout(const Device& device) {
  const std::array bindings{vk::DescriptorSetLayoutBinding{.binding = AFM_BINDING_WARP,
                                                           .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                           .descriptorCount = 1,
                                                           .stageFlags = vk::ShaderStageFlagBits::eFragment},
                            vk::DescriptorSetLayoutBinding{.binding = AFM_BINDING_BLEND,
                                                           .descriptorType = vk::DescriptorType::eUniformBuffer,
                                                           .descriptorCount = 1,
                                                           .stageFlags = vk::ShaderStageFlagBits::eFragment}};
  return vk::raii::DescriptorSetLayout(
      *device, {.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()});
}

vk::raii::DescriptorPool create_correction_pool(const Device& device) {
  const std::array sizes{
      vk::DescriptorPoolSize{.type = vk::DescriptorType::eCombinedImageSampler, .descriptorCount = 1},
      vk::DescriptorPoolSize{.type = vk::DescriptorType::eUniformBuffer, .descriptorCount = 1}};
  return vk::raii::DescriptorPool(*device, {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                            .maxSets = 1,
                                            .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                            .pPoolSizes = sizes.data()});
}

DeviceImage upload_map(const Device& device, vk::Extent2D extent, const std::vector<glm::vec4>& map) {
  DeviceImage image = create_image(device, "warp map",
                                   {.format = vk::Format::eR32G32B32A32Sfloat,
                                    .extent = extent,
                                    .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst});
  const auto bytes = std::as_bytes(std::span(map));
  const Buffer staging =
      create_host_buffer(device, "warp map staging", bytes.size(), vk::BufferUsageFlagBits::eTransferSrc);
  std::memcpy(staging.mapped, bytes.data(), bytes.size());
  device.run_once([&](const vk::raii::CommandBuffer& command) {
    record_barriers(command, {image_barrier(*image.image, kColorAspect, kFreshMap, kCopiedTo)});
    command.copyBufferToImage(*staging.buffer, *image.image, kCopiedTo.layout,
                              vk::BufferImageCopy{.imageSubresource = {.aspectMask = kColorAspect, .layerCount = 1},
                                                  .imageExtent = {extent.width, extent.height, 1}});
    record_barriers(command, {image_barrier(*image.image, kColorAspect, kCopiedTo, kSampledMap)});
  });
  return image;
}

}  // namespace

Correction::Correction(const Device& device, vk::DescriptorSetLayout layout, vk::Sampler sampler,
                       const Composition& composition, vk::Extent2D eye_px)
    : warp_(composition.warp), blend_(composition.blend), eye_px_(eye_px), pool_(create_correction_pool(device)) {
  if (warp_) {
    const std::vector<glm::vec4> map = scene::warp_map(*warp_, {eye_px.width, eye_px.height});
    map_ = upload_map(device, eye_px, map);
    find_tiles(map);
  } else {
    map_ = upload_map(device, {1, 1}, {glm::vec4(0.0F)});
  }
  view_ = create_view(device, map_, kColorAspect, 0, 1);
  const BlendBlock block = blend_block(blend_.get());
  block_ =
      upload_buffer(device, "blending", std::as_bytes(std::span(&block, 1)), vk::BufferUsageFlagBits::eUniformBuffer);
  set_ = std::move(
      vk::raii::DescriptorSets(*device, {.descriptorPool = *pool_, .descriptorSetCount = 1, .pSetLayouts = &layout})
          .front());
  const vk::DescriptorImageInfo image{.sampler = sampler, .imageView = *view_, .imageLayout = kSampledMap.layout};
  const vk::DescriptorBufferInfo buffer{.buffer = *block_.buffer, .range = VK_WHOLE_SIZE};
  device->updateDescriptorSets(
      std::array{vk::WriteDescriptorSet{.dstSet = *set_,
                                        .dstBinding = AFM_BINDING_WARP,
                                        .descriptorCount = 1,
                                        .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                        .pImageInfo = &image},
                 vk::WriteDescriptorSet{.dstSet = *set_,
                                        .dstBinding = AFM_BINDING_BLEND,
                                        .descriptorCount = 1,
                                        .descriptorType = vk::DescriptorType::eUniformBuffer,
                                        .pBufferInfo = &buffer}},
      nullptr);
}

void Correction::find_tiles(const std::vector<glm::vec4>& map) {
  const glm::ivec2 size(static_cast<int>(eye_px_.width), static_cast<int>(eye_px_.height));
  for (glm::ivec2 from(0); from.y < size.y; from.y += kTilePx) {
    for (from.x = 0; from.x < size.x; from.x += kTilePx) {
      Tile tile{.pixels = {from, glm::min(from + kTilePx, size)}, .low = glm::vec2(1.0F), .high = glm::vec2(0.0F)};
      for (int y = from.y; y < tile.pixels.high.y; ++y) {
        for (int x = from.x; x < tile.pixels.high.x; ++x) {
          const glm::vec4& shown = map[static_cast<std::size_t>(y) * eye_px_.width + static_cast<std::size_t>(x)];
          if (!(shown.w > 0.0F)) continue;
          tile.low = glm::min(tile.low, glm::vec2(shown));
          tile.high = glm::max(tile.high, glm::vec2(shown));
        }
      }
      if (tile.low.x <= tile.high.x && tile.low.y <= tile.high.y) tiles_.push_back(tile);
    }
  }
}

void Correction::add_moved(const PixelBox& box, vk::Extent2D eye, const glm::ivec2& at, PixelTiles& tiles) const {
  constexpr int kFilterPx = 2;  // reach of the filter, including rounding
  const glm::dvec2 size(eye.width, eye.height);
  for (const Tile& tile : tiles_) {
    const PixelBox shown{glm::ivec2(glm::floor(glm::dvec2(tile.low) * size)) - kFilterPx,
                         glm::ivec2(glm::ceil(glm::dvec2(tile.high) * size)) + kFilterPx};
    if (!shown.within(box).empty()) tiles.add({tile.pixels.low + at, tile.pixels.high + at});
  }
}

Corrections::Corrections(const Device& device)
    : device_(device), layout_(create_correction_layout(device)), sampler_(*device, vk::SamplerCreateInfo{}) {
  newest_first_.emplace_front(device_, *layout_, *sampler_, Composition{}, vk::Extent2D{1, 1});
}

const Correction& Corrections::find(const Composition& composition, vk::Extent2D eye_px) {
  const auto found = std::find_if(newest_first_.begin(), newest_first_.end(),
                                  [&](const Correction& known) { return known.serves(composition, eye_px); });
  if (found != newest_first_.end()) {
    newest_first_.splice(newest_first_.begin(), newest_first_, found);
    return newest_first_.front();
  }
  forget_oldest(composition);
  return newest_first_.emplace_front(device_, *layout_, *sampler_, composition, eye_px);
}

// Limits the number of maps, since resizing a window creates one for every size.
void Corrections::forget_oldest(const Composition& composition) {
  const auto of_same = [&](const Correction& known) { return known.corrects_as(composition); };
  if (std::count_if(newest_first_.begin(), newest_first_.end(), of_same) < kMostKept) return;
  device_.finish_all();
  const auto oldest = std::find_if(newest_first_.rbegin(), newest_first_.rend(), of_same);
  newest_first_.erase(std::next(oldest).base());
}

}  // namespace afm::render
