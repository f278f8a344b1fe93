// SPDX-License-Identifier: Apache-2.0
#include "passes/scene_materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "device/shader_interface.h"

namespace afm::render {
namespace {

constexpr auto kUniform = vk::DescriptorType::eUniformBuffer;
constexpr auto kSampled = vk::DescriptorType::eCombinedImageSampler;
static_assert(AFM_TEXTURE_SLOTS == scene::kTextureSlots);

vk::raii::DescriptorSetLayout create_layout(const Device& device) {
  const std::array bindings{vk::DescriptorSetLayoutBinding{.binding = AFM_BINDING_MATERIAL,
                                                           .descriptorType = kUniform,
                                                           .descriptorCount = 1,
                                                           .stageFlags = vk::ShaderStageFlagBits::eFragment},
                            vk::DescriptorSetLayoutBinding{.binding = AFM_BINDING_TEXTURES,
                                                           .descriptorType = kSampled,
                                                           .descriptorCount = AFM_TEXTURE_SLOTS,
                                                           .stageFlags = vk::ShaderStageFlagBits::eFragment}};
  return vk::raii::DescriptorSetLayout(
      *device, {.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()});
}

// Reflectance at normal incidence; KHR_materials_ior lets 0 stand for a mirror.
float reflectance(float ior) {
  const float ratio = (ior - 1.0F) / (ior + 1.0F);
  return ratio * ratio;
}

// KHR_texture_transform: translation * rotation * scale.
void write_rows(const scene::TextureUse& use, glm::vec4* rows) {
  const float cosine = std::cos(use.rotation_rad), sine = std::sin(use.rotation_rad);
  rows[0] = {cosine * use.scale.x, sine * use.scale.y, use.offset.x, static_cast<float>(use.coordinates)};
  rows[1] = {-sine * use.scale.x, cosine * use.scale.y, use.offset.y, 0.0F};
}

MaterialBlock block_of(const scene::Material& material) {
  MaterialBlock block{};
  block.specular = glm::vec4(material.specular_color, material.specular);
  block.clearcoat = glm::vec4(material.clearcoat, material.clearcoat_roughness, material.clearcoat_normal_scale, 0.0F);
  block.iridescence = glm::vec4(material.iridescence, material.iridescence_ior, material.iridescence_thickness_nm.x,
                                material.iridescence_thickness_nm.y);
  block.scales = glm::vec4(material.normal_scale, material.occlusion_strength, reflectance(material.ior),
                           material.alpha_cutoff.value_or(0.0F));
  for (std::size_t slot = 0; slot < scene::kTextureSlots; ++slot) {
    write_rows(material.textures[slot], &block.uv_rows[2 * slot]);
  }
  return block;
}

}  // namespace

SceneMaterials::SceneMaterials(const Device& device, const scene::Scene& scene)
    : layout_(create_layout(device)), textures_(device, scene) {
  const auto count = static_cast<std::uint32_t>(std::max<std::size_t>(scene.materials.size(), 1));
  const auto alignment = device.physical().getProperties().limits.minUniformBufferOffsetAlignment;
  const vk::DeviceSize stride = (sizeof(MaterialBlock) + alignment - 1) / alignment * alignment;
  blocks_ = create_host_buffer(device, "materials", count * stride, vk::BufferUsageFlagBits::eUniformBuffer);
  const std::array sizes{vk::DescriptorPoolSize{.type = kUniform, .descriptorCount = count},
                         vk::DescriptorPoolSize{.type = kSampled, .descriptorCount = count * AFM_TEXTURE_SLOTS}};
  pool_ = vk::raii::DescriptorPool(*device, {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                             .maxSets = count,
                                             .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                             .pPoolSizes = sizes.data()});
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    sets_.push_back(std::move(
        vk::raii::DescriptorSets(*device, {.descriptorPool = *pool_, .descriptorSetCount = 1, .pSetLayouts = &*layout_})
            .front()));
    const MaterialBlock block = block_of(scene.materials[i]);
    std::memcpy(blocks_.mapped + i * stride, &block, sizeof(block));
    write_set(device, scene.materials[i], i, stride);
  }
}

void SceneMaterials::write_set(const Device& device, const scene::Material& material, std::size_t index,
                               vk::DeviceSize stride) const {
  const vk::DescriptorBufferInfo block{
      .buffer = *blocks_.buffer, .offset = index * stride, .range = sizeof(MaterialBlock)};
  std::array<vk::DescriptorImageInfo, scene::kTextureSlots> images;
  for (std::size_t slot = 0; slot < images.size(); ++slot) {
    const auto& texture = material.textures[slot].texture;
    images[slot] = texture ? textures_.descriptor(*texture, scene::is_srgb(static_cast<scene::TextureSlot>(slot)))
                           : textures_.white();
  }
  const std::array writes{vk::WriteDescriptorSet{.dstSet = *sets_[index],
                                                 .dstBinding = AFM_BINDING_MATERIAL,
                                                 .descriptorCount = 1,
                                                 .descriptorType = kUniform,
                                                 .pBufferInfo = &block},
                          vk::WriteDescriptorSet{.dstSet = *sets_[index],
                                                 .dstBinding = AFM_BINDING_TEXTURES,
                                                 .descriptorCount = static_cast<std::uint32_t>(images.size()),
                                                 .descriptorType = kSampled,
                                                 .pImageInfo = images.data()}};
  device->updateDescriptorSets(writes, nullptr);
}

}  // namespace afm::render
