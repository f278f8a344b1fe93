// SPDX-License-Identifier: Apache-2.0
#include "passes/soft_shadow.h"

#include <algorithm>

#include "device/barriers.h"
#include "device/pipelines.h"
#include "device/shader_interface.h"
#include "shaders/fullscreen_vert.h"
#include "shaders/soft_shadow_frag.h"

namespace afm::render {
namespace {

constexpr vk::Format kMomentsFormat = vk::Format::eR32G32Sfloat;
constexpr std::int32_t kSide = AFM_SOFT_SHADOW_SIZE;
constexpr std::int32_t kTexelsPerSide = AFM_SHADOW_MAP_SIZE / AFM_SOFT_SHADOW_SIZE;  // the shadow map's in one texel
constexpr vk::Extent2D kSoftSize{AFM_SOFT_SHADOW_SIZE, AFM_SOFT_SHADOW_SIZE};

constexpr ImageUse kMomentsSampled{
    vk::PipelineStageFlagBits2::eVertexShader | vk::PipelineStageFlagBits2::eFragmentShader,
    vk::AccessFlagBits2::eShaderSampledRead, vk::ImageLayout::eShaderReadOnlyOptimal};

DeviceImage create_moments(const Device& device, const char* name) {
  return create_image(device, name,
                      {.format = kMomentsFormat,
                       .extent = kSoftSize,
                       .usage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled});
}

// Creates a sampler with a white border, which means lit.
vk::raii::Sampler create_border_sampler(const Device& device, vk::Filter filter) {
  return vk::raii::Sampler(*device, vk::SamplerCreateInfo{.magFilter = filter,
                                                          .minFilter = filter,
                                                          .addressModeU = vk::SamplerAddressMode::eClampToBorder,
                                                          .addressModeV = vk::SamplerAddressMode::eClampToBorder,
                                                          .addressModeW = vk::SamplerAddressMode::eClampToBorder,
                                                          .borderColor = vk::BorderColor::eFloatOpaqueWhite});
}

vk::raii::DescriptorSetLayout create_source_layout(const Device& device) {
  const vk::DescriptorSetLayoutBinding binding{.binding = AFM_BINDING_TEXTURE,
                                               .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                               .descriptorCount = 1,
                                               .stageFlags = vk::ShaderStageFlagBits::eFragment};
  return vk::raii::DescriptorSetLayout(*device, {.bindingCount = 1, .pBindings = &binding});
}

vk::raii::Pipeline create_softening(const Device& device, vk::PipelineLayout layout, std::uint32_t variant) {
  return create_pipeline(device, {.name = variant == 0 ? "soft shadow, rows" : "soft shadow, columns",
                                  .vertex_code = shaders::fullscreen_vert,
                                  .fragment_code = shaders::soft_shadow_frag,
                                  .layout = layout,
                                  .topology = vk::PrimitiveTopology::eTriangleStrip,
                                  .color_format = kMomentsFormat,
                                  .variant = variant});
}

vk::raii::DescriptorPool create_source_pool(const Device& device) {
  const vk::DescriptorPoolSize size{.type = vk::DescriptorType::eCombinedImageSampler, .descriptorCount = 2};
  return vk::raii::DescriptorPool(*device, {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                            .maxSets = 2,
                                            .poolSizeCount = 1,
                                            .pPoolSizes = &size});
}

vk::raii::DescriptorSets create_source_sets(const Device& device, vk::DescriptorPool pool,
                                            vk::DescriptorSetLayout layout) {
  const std::array layouts{layout, layout};
  return vk::raii::DescriptorSets(*device,
                                  {.descriptorPool = pool, .descriptorSetCount = 2, .pSetLayouts = layouts.data()});
}

// Part of the image between two texels, within it.
vk::Rect2D part_between(std::int32_t left, std::int32_t top, std::int32_t right, std::int32_t bottom) {
  const auto within = [](std::int32_t texel) { return std::clamp(texel, 0, kSide); };
  const vk::Offset2D from{within(left), within(top)};
  return {.offset = from,
          .extent = {static_cast<std::uint32_t>(within(right) - from.x),
                     static_cast<std::uint32_t>(within(bottom) - from.y)}};
}

}  // namespace

SoftShadow::SoftShadow(const Device& device, vk::ImageView depth)
    : device_(device),
      images_{create_moments(device, "shadow along rows"), create_moments(device, "soft shadow")},
      views_{create_view(device, images_[kRows], kColorAspect, 0, 1),
             create_view(device, images_[kColumns], kColorAspect, 0, 1)},
      sampler_(create_border_sampler(device, vk::Filter::eLinear)),
      texel_sampler_(create_border_sampler(device, vk::Filter::eNearest)),
      set_layout_(create_source_layout(device)),
      layout_(create_pipeline_layout(device, {.sets = {&*set_layout_, 1}})),
      pool_(create_source_pool(device)),
      sets_(create_source_sets(device, *pool_, *set_layout_)) {
  const auto write = [&](Step step, vk::ImageView view) {
    const vk::DescriptorImageInfo image{
        .sampler = *texel_sampler_, .imageView = view, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
    device->updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = *sets_[step],
                                                        .dstBinding = AFM_BINDING_TEXTURE,
                                                        .descriptorCount = 1,
                                                        .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                        .pImageInfo = &image},
                                 nullptr);
  };
  write(kRows, depth);
  write(kColumns, *views_[kRows]);
}

void SoftShadow::draw(const vk::raii::CommandBuffer& command, Step step, const vk::Rect2D& part) {
  if (!*pipelines_[step]) pipelines_[step] = create_softening(device_, *layout_, step);
  const vk::RenderingAttachmentInfo color{.imageView = *views_[step],
                                          .imageLayout = kColorDrawn.layout,
                                          .loadOp = vk::AttachmentLoadOp::eDontCare,
                                          .storeOp = vk::AttachmentStoreOp::eStore};
  command.beginRendering({.renderArea = part, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &color});
  set_viewport(command, kSoftSize);
  command.setScissor(0, part);
  command.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_[step]);
  command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, *sets_[step], nullptr);
  command.draw(4, 1, 0, 0);
  command.endRendering();
}

void SoftShadow::record(const vk::raii::CommandBuffer& command, const vk::Rect2D& changed) {
  if (changed.extent.width == 0 || changed.extent.height == 0) return;
  const auto right = changed.offset.x + static_cast<std::int32_t>(changed.extent.width);
  const auto bottom = changed.offset.y + static_cast<std::int32_t>(changed.extent.height);
  const std::int32_t from_x = changed.offset.x / kTexelsPerSide - AFM_PENUMBRA_REACH;
  const std::int32_t from_y = changed.offset.y / kTexelsPerSide - AFM_PENUMBRA_REACH;
  const std::int32_t to_x = (right + kTexelsPerSide - 1) / kTexelsPerSide + AFM_PENUMBRA_REACH;
  const std::int32_t to_y = (bottom + kTexelsPerSide - 1) / kTexelsPerSide + AFM_PENUMBRA_REACH;
  const bool whole = changed.extent.width == AFM_SHADOW_MAP_SIZE && changed.extent.height == AFM_SHADOW_MAP_SIZE;

  record_barriers(command,
                  {image_barrier(*images_[kRows].image, kColorAspect, kMomentsSampled.discarded(), kColorDrawn)});
  // the columns reach beyond the part that is theirs
  draw(command, kRows, part_between(from_x, from_y - AFM_PENUMBRA_REACH, to_x, to_y + AFM_PENUMBRA_REACH));
  record_barriers(command, {image_barrier(*images_[kRows].image, kColorAspect, kColorDrawn, kMomentsSampled),
                            image_barrier(*images_[kColumns].image, kColorAspect,
                                          whole ? kMomentsSampled.discarded() : kMomentsSampled, kColorDrawn)});
  draw(command, kColumns, part_between(from_x, from_y, to_x, to_y));
  record_barriers(command, {image_barrier(*images_[kColumns].image, kColorAspect, kColorDrawn, kMomentsSampled)});
}

void SoftShadow::leave_empty() const {
  device_.run_once([&](const vk::raii::CommandBuffer& command) {
    record_barriers(command, {image_barrier(*images_[kColumns].image, kColorAspect, ImageUse{}, kMomentsSampled)});
  });
}

vk::DescriptorImageInfo SoftShadow::descriptor() const {
  return {.sampler = *sampler_, .imageView = *views_[kColumns], .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
}

}  // namespace afm::render
