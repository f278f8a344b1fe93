// SPDX-License-Identifier: Apache-2.0
#include "panels/panel_texture.h"

#include <utility>

#include "device/shader_interface.h"

namespace afm::render {

PanelTexture create_panel_texture(const Device& device, const std::string& name, ImageRequest request,
                                  vk::DescriptorSetLayout layout, vk::Sampler sampler) {
  request.usage |= vk::ImageUsageFlagBits::eSampled;
  PanelTexture texture;
  texture.image = create_image(device, name, request);
  texture.view = create_view(device, texture.image, kColorAspect, 0, 1);
  const vk::DescriptorPoolSize size{.type = vk::DescriptorType::eCombinedImageSampler, .descriptorCount = 1};
  texture.pool = vk::raii::DescriptorPool(*device, {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                                    .maxSets = 1,
                                                    .poolSizeCount = 1,
                                                    .pPoolSizes = &size});
  vk::raii::DescriptorSets sets(*device,
                                {.descriptorPool = *texture.pool, .descriptorSetCount = 1, .pSetLayouts = &layout});
  texture.set = std::move(sets.front());
  const vk::DescriptorImageInfo image{
      .sampler = sampler, .imageView = *texture.view, .imageLayout = kPanelSampled.layout};
  device->updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = *texture.set,
                                                      .dstBinding = AFM_BINDING_TEXTURE,
                                                      .descriptorCount = 1,
                                                      .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                      .pImageInfo = &image},
                               nullptr);
  return texture;
}

}  // namespace afm::render
