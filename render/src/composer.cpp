// SPDX-License-Identifier: Apache-2.0
#include "composer.h"

#include <array>

#include "barriers.h"
#include "pipelines.h"
#include "readback.h"
#include "shader_interface.h"
#include "shaders/compose_frag.h"
#include "shaders/fullscreen_vert.h"

namespace afm::render {
namespace {

constexpr auto kColor = vk::ImageAspectFlagBits::eColor;

vk::raii::DescriptorSetLayout create_set_layout(const Device& device) {
  const std::array bindings{vk::DescriptorSetLayoutBinding{.binding = AFM_BINDING_TEXTURE,
                                                           .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                           .descriptorCount = 1,
                                                           .stageFlags = vk::ShaderStageFlagBits::eFragment},
                            vk::DescriptorSetLayoutBinding{.binding = AFM_BINDING_RIGHT_EYE,
                                                           .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                           .descriptorCount = 1,
                                                           .stageFlags = vk::ShaderStageFlagBits::eFragment}};
  return vk::raii::DescriptorSetLayout(
      *device, {.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()});
}

vk::raii::DescriptorPool create_pool(const Device& device) {
  const vk::DescriptorPoolSize size{.type = vk::DescriptorType::eCombinedImageSampler, .descriptorCount = 2};
  return vk::raii::DescriptorPool(*device, {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                            .maxSets = 1,
                                            .poolSizeCount = 1,
                                            .pPoolSizes = &size});
}

std::int32_t shader_mode(Layout layout) {
  switch (layout) {
    case Layout::Left:
      return AFM_LAYOUT_LEFT;
    case Layout::Right:
      return AFM_LAYOUT_RIGHT;
    case Layout::SideBySide:
      break;
  }
  return AFM_LAYOUT_SIDE_BY_SIDE;
}

}  // namespace

Composer::Composer(const Device& device, const EyeTargets& eyes)
    : device_(device),
      eyes_(eyes),
      set_layout_(create_set_layout(device)),
      layout_(create_pipeline_layout(device, {.sets = {&*set_layout_, 1},
                                              .push_stages = vk::ShaderStageFlagBits::eFragment,
                                              .push_size = sizeof(ComposeBlock)})),
      pipeline_(create_pipeline_for(kEyeFormat)),
      sampler_(*device, vk::SamplerCreateInfo{.magFilter = vk::Filter::eLinear,
                                              .minFilter = vk::Filter::eLinear,
                                              .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                              .addressModeV = vk::SamplerAddressMode::eClampToEdge}),
      pool_(create_pool(device)) {
  set_ = std::move(vk::raii::DescriptorSets(
                       *device, {.descriptorPool = *pool_, .descriptorSetCount = 1, .pSetLayouts = &*set_layout_})
                       .front());
  eyes_changed();
}

void Composer::eyes_changed() {
  targets_.clear();
  for (const auto eye : scene::kEyes) {
    const vk::DescriptorImageInfo image{
        .sampler = *sampler_, .imageView = eyes_.eye(eye).view, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
    device_->updateDescriptorSets(
        vk::WriteDescriptorSet{
            .dstSet = *set_,
            .dstBinding = eye == scene::Eye::Left ? std::uint32_t{AFM_BINDING_TEXTURE} : AFM_BINDING_RIGHT_EYE,
            .descriptorCount = 1,
            .descriptorType = vk::DescriptorType::eCombinedImageSampler,
            .pImageInfo = &image},
        nullptr);
  }
}

vk::Extent2D Composer::extent(Layout layout) const {
  const vk::Extent2D eye = eyes_.extent();
  return layout == Layout::SideBySide ? vk::Extent2D{eye.width * 2, eye.height} : eye;
}

vk::raii::Pipeline Composer::create_pipeline_for(vk::Format format) const {
  return create_pipeline(device_, {.name = "compose",
                                   .vertex_code = shaders::fullscreen_vert,
                                   .fragment_code = shaders::compose_frag,
                                   .layout = *layout_,
                                   .topology = vk::PrimitiveTopology::eTriangleStrip,
                                   .color_format = format});
}

void Composer::record(const vk::raii::CommandBuffer& command, vk::Pipeline pipeline, Layout layout, vk::Extent2D target,
                      const vk::Rect2D& place) const {
  const vk::Extent2D eye = eyes_.extent();
  const vk::Extent2D drawn = eyes_.drawing().extent;
  const vk::Extent2D picture = extent(layout);
  const ComposeBlock block{
      .mode = glm::ivec4(shader_mode(layout), static_cast<int>(eye.width), static_cast<int>(eye.height),
                         eyes_.same_eyes() ? 1 : 0),
      .drawn = glm::vec4(drawn.width, drawn.height, 0.0F, 0.0F) / glm::vec4(eye.width, eye.height, 1.0F, 1.0F),
      .placement = glm::vec4(place.offset.x, place.offset.y,
                             static_cast<float>(picture.width) / static_cast<float>(place.extent.width),
                             static_cast<float>(picture.height) / static_cast<float>(place.extent.height))};
  command.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
  set_viewport(command, target);
  command.setScissor(0, place);
  command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, *set_, nullptr);
  command.pushConstants<ComposeBlock>(*layout_, vk::ShaderStageFlagBits::eFragment, 0, block);
  command.draw(4, 1, 0, 0);
}

const Composer::Target& Composer::target(Layout layout) {
  const auto found = targets_.find(layout);
  if (found != targets_.end()) {
    return found->second;
  }
  Target target;
  target.image = create_image(device_, "composed",
                              {.format = kEyeFormat,
                               .extent = extent(layout),
                               .usage = vk::ImageUsageFlagBits::eColorAttachment |
                                        vk::ImageUsageFlagBits::eTransferSrc | vk::ImageUsageFlagBits::eSampled});
  target.view = create_view(device_, target.image, kColor, 0, 1);
  return targets_.emplace(layout, std::move(target)).first->second;
}

Image Composer::compose(Layout layout) {
  const Target& composed = target(layout);
  const ImageUse discarded{vk::PipelineStageFlagBits2::eCopy, vk::AccessFlagBits2::eNone, vk::ImageLayout::eUndefined};
  const ImageUse drawn{vk::PipelineStageFlagBits2::eColorAttachmentOutput, vk::AccessFlagBits2::eColorAttachmentWrite,
                       vk::ImageLayout::eColorAttachmentOptimal};
  const ImageUse shown{vk::PipelineStageFlagBits2::eFragmentShader, vk::AccessFlagBits2::eShaderSampledRead,
                       vk::ImageLayout::eShaderReadOnlyOptimal};
  device_.run_once([&](const vk::raii::CommandBuffer& command) {
    record_barriers(command, {image_barrier(*composed.image.image, kColor, discarded, drawn)});
    const vk::RenderingAttachmentInfo color{.imageView = *composed.view,
                                            .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                            .loadOp = vk::AttachmentLoadOp::eDontCare,
                                            .storeOp = vk::AttachmentStoreOp::eStore};
    command.beginRendering({.renderArea = {.extent = composed.image.extent},
                            .layerCount = 1,
                            .colorAttachmentCount = 1,
                            .pColorAttachments = &color});
    record(command, *pipeline_, layout, composed.image.extent, {.extent = composed.image.extent});
    command.endRendering();
    record_barriers(command, {image_barrier(*composed.image.image, kColor, drawn, shown)});
  });
  return read_back(device_, *composed.image.image, 0, composed.image.extent);
}

}  // namespace afm::render
