// SPDX-License-Identifier: Apache-2.0
#include "passes/scene_materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/check.h"
#include "device/shader_interface.h"

namespace afm::render {
namespace {

// Uniform block of material.frag: its fields, a vec4 each, then two rows of each texture's transform.
constexpr std::size_t kFields = [] {
  std::size_t count = 0;
  scene::for_each_pbr_field([&](const auto& field) { count += field.use == scene::PbrUse::Plain ? 0U : 1U; });
  return count;
}();
using MaterialBlock = std::array<glm::vec4, kFields + 2 * scene::kTextureSlots>;

vk::raii::DescriptorSetLayout create_layout(const Device& device) {
  const std::array bindings{vk::DescriptorSetLayoutBinding{.binding = AFM_BINDING_MATERIAL,
                                                           .descriptorType = vk::DescriptorType::eUniformBuffer,
                                                           .descriptorCount = 1,
                                                           .stageFlags = vk::ShaderStageFlagBits::eFragment},
                            vk::DescriptorSetLayoutBinding{.binding = AFM_BINDING_TEXTURES,
                                                           .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                           .descriptorCount = scene::kTextureSlots,
                                                           .stageFlags = vk::ShaderStageFlagBits::eFragment}};
  return vk::raii::DescriptorSetLayout(
      *device, {.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()});
}

glm::vec4 packed(float number) { return {number, 0.0F, 0.0F, 0.0F}; }
glm::vec4 packed(const glm::vec2& pair) { return {pair, 0.0F, 0.0F}; }
glm::vec4 packed(const glm::vec3& color) { return {color, 0.0F}; }
glm::vec4 packed(const std::optional<float>& number) { return packed(number.value_or(0.0F)); }

// KHR_texture_transform: translation * rotation * scale.
void write_rows(const scene::TextureUse& use, glm::vec4* rows) {
  const float cosine = std::cos(use.rotation_rad), sine = std::sin(use.rotation_rad);
  rows[0] = {cosine * use.scale.x, sine * use.scale.y, use.offset.x, static_cast<float>(use.coordinates)};
  rows[1] = {-sine * use.scale.x, cosine * use.scale.y, use.offset.y, 0.0F};
}

MaterialBlock block_of(const scene::PbrMaterial& material) {
  MaterialBlock block{};
  std::size_t next = 0;
  scene::for_each_pbr_field([&](const auto& field) {
    if constexpr (requires { packed(material.*field.member); }) {
      if (field.use != scene::PbrUse::Plain) {
        block.at(next++) = packed(material.*field.member);
      }
    }
  });
  AFM_CHECK(next == kFields);
  for (std::size_t slot = 0; slot < scene::kTextureSlots; ++slot) {
    write_rows(material.textures[slot], &block[kFields + 2 * slot]);
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
  const std::array sizes{
      vk::DescriptorPoolSize{.type = vk::DescriptorType::eUniformBuffer, .descriptorCount = count},
      vk::DescriptorPoolSize{.type = vk::DescriptorType::eCombinedImageSampler,
                             .descriptorCount = count * static_cast<std::uint32_t>(scene::kTextureSlots)}};
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

void SceneMaterials::write_set(const Device& device, const scene::PbrMaterial& material, std::size_t index,
                               vk::DeviceSize stride) const {
  const vk::DescriptorBufferInfo block{
      .buffer = *blocks_.buffer, .offset = index * stride, .range = sizeof(MaterialBlock)};
  std::array<vk::DescriptorImageInfo, scene::kTextureSlots> images;
  for (std::size_t slot = 0; slot < images.size(); ++slot) {
    const auto& texture = material.textures[slot].texture;
    images[slot] =
        texture ? textures_.descriptor(*texture, scene::kTextureSlotTraits[slot].is_srgb) : textures_.white();
  }
  const std::array writes{vk::WriteDescriptorSet{.dstSet = *sets_[index],
                                                 .dstBinding = AFM_BINDING_MATERIAL,
                                                 .descriptorCount = 1,
                                                 .descriptorType = vk::DescriptorType::eUniformBuffer,
                                                 .pBufferInfo = &block},
                          vk::WriteDescriptorSet{.dstSet = *sets_[index],
                                                 .dstBinding = AFM_BINDING_TEXTURES,
                                                 .descriptorCount = static_cast<std::uint32_t>(images.size()),
                                                 .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                 .pImageInfo = images.data()}};
  device->updateDescriptorSets(writes, nullptr);
}

}  // namespace afm::render
