// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "device/barriers.h"
#include "device/memory.h"

namespace afm::render {

// Use of the textures between one painting and the next.
inline constexpr ImageUse kPanelSampled{vk::PipelineStageFlagBits2::eFragmentShader,
                                        vk::AccessFlagBits2::eShaderSampledRead,
                                        vk::ImageLayout::eShaderReadOnlyOptimal};

// Image of the panels' drawing, with the descriptor set that samples it.
struct PanelTexture {
  DeviceImage image;
  vk::raii::ImageView view{nullptr};
  vk::raii::DescriptorPool pool{nullptr};  // pool for one set, because panels come and go with the labels
  vk::raii::DescriptorSet set{nullptr};
};

// Creates a texture of one layer; `request` gains the use as a sampled image. `layout` is that of a set with one
// combined image and sampler at AFM_BINDING_TEXTURE.
PanelTexture create_panel_texture(const Device& device, const std::string& name, ImageRequest request,
                                  vk::DescriptorSetLayout layout, vk::Sampler sampler);

}  // namespace afm::render
