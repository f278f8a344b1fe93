// SPDX-License-Identifier: Apache-2.0
#include "passes/frame_slot.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace afm::render {
namespace {

constexpr auto kDynamicUniform = vk::DescriptorType::eUniformBufferDynamic;

constexpr std::uint32_t kMostPasses = 2;

// Smallest stride of blocks of `size` bytes that a dynamic offset allows.
std::uint32_t aligned_stride(const Device& device, std::size_t size) {
  const auto alignment = device.physical().getProperties().limits.minUniformBufferOffsetAlignment;
  return static_cast<std::uint32_t>((size + alignment - 1) / alignment * alignment);
}

vk::raii::DescriptorPool create_frame_pool(const Device& device, std::uint32_t sets) {
  const std::array sizes{
      vk::DescriptorPoolSize{.type = vk::DescriptorType::eUniformBuffer, .descriptorCount = sets},
      vk::DescriptorPoolSize{.type = kDynamicUniform, .descriptorCount = 1},
      vk::DescriptorPoolSize{.type = vk::DescriptorType::eCombinedImageSampler, .descriptorCount = sets}};
  return vk::raii::DescriptorPool(*device, {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                            .maxSets = sets,
                                            .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                            .pPoolSizes = sizes.data()});
}

void write_uniforms(const Device& device, vk::DescriptorSet set, std::uint32_t binding, vk::DescriptorType type,
                    const vk::DescriptorBufferInfo& uniforms) {
  device->updateDescriptorSets(
      vk::WriteDescriptorSet{
          .dstSet = set, .dstBinding = binding, .descriptorCount = 1, .descriptorType = type, .pBufferInfo = &uniforms},
      nullptr);
}

void write_frame(const Device& device, vk::DescriptorSet set, const Buffer& uniforms) {
  write_uniforms(device, set, AFM_BINDING_FRAME, vk::DescriptorType::eUniformBuffer,
                 {.buffer = *uniforms.buffer, .range = VK_WHOLE_SIZE});
}

void write_shadow(const Device& device, vk::DescriptorSet set, const SoftShadow& shadow) {
  const vk::DescriptorImageInfo shadow_info = shadow.descriptor();
  device->updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = set,
                                                      .dstBinding = AFM_BINDING_SHADOW,
                                                      .descriptorCount = 1,
                                                      .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                      .pImageInfo = &shadow_info},
                               nullptr);
}

enum class ShadowUse { Read, Drawn };

vk::raii::DescriptorSetLayout create_frame_set_layout(const Device& device, ShadowUse use) {
  const auto both = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
  std::vector<vk::DescriptorSetLayoutBinding> bindings{{.binding = AFM_BINDING_FRAME,
                                                        .descriptorType = vk::DescriptorType::eUniformBuffer,
                                                        .descriptorCount = 1,
                                                        .stageFlags = both}};
  if (use == ShadowUse::Read) {
    bindings.push_back({.binding = AFM_BINDING_SHADOW,
                        .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                        .descriptorCount = 1,
                        .stageFlags = both});
  }
  return vk::raii::DescriptorSetLayout(
      *device, {.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()});
}

vk::raii::DescriptorSetLayout create_draw_set_layout(const Device& device) {
  const vk::DescriptorSetLayoutBinding binding{.binding = AFM_BINDING_DRAW,
                                               .descriptorType = kDynamicUniform,
                                               .descriptorCount = 1,
                                               .stageFlags = vk::ShaderStageFlagBits::eVertex};
  return vk::raii::DescriptorSetLayout(*device, {.bindingCount = 1, .pBindings = &binding});
}

}  // namespace

FrameSetLayouts::FrameSetLayouts(const Device& device)
    : eyes(create_frame_set_layout(device, ShadowUse::Read)),
      shadow(create_frame_set_layout(device, ShadowUse::Drawn)),
      draw(create_draw_set_layout(device)) {}

FrameSlot::FrameSlot(const Device& device, const FrameSetLayouts& layouts, const SoftShadow& shadow,
                     const SceneGeometry& geometry)
    : pool_(*device, vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                               .queueFamilyIndex = device.queue_family()}),
      commands_(*device, {.commandPool = *pool_, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 4}),
      draw_stride_(aligned_stride(device, sizeof(DrawBlock))),
      largest_point_px_(device.largest_point_px()),
      draw_blocks_(create_host_buffer(device, "draws", std::max<std::size_t>(geometry.draws().size(), 1) * draw_stride_,
                                      vk::BufferUsageFlagBits::eUniformBuffer)),
      descriptor_pool_(create_frame_pool(device, kMostPasses + 2)) {
  const auto allocate = [&](vk::DescriptorSetLayout of) {
    return std::move(vk::raii::DescriptorSets(
                         *device, {.descriptorPool = *descriptor_pool_, .descriptorSetCount = 1, .pSetLayouts = &of})
                         .front());
  };
  for (std::uint32_t pass = 0; pass < kMostPasses; ++pass) {
    uniforms_.push_back(
        create_host_buffer(device, "frame uniforms", sizeof(FrameBlock), vk::BufferUsageFlagBits::eUniformBuffer));
    sets_.push_back(allocate(*layouts.eyes));
    write_frame(device, *sets_.back(), uniforms_.back());
    write_shadow(device, *sets_.back(), shadow);
  }
  if (geometry.copy_count() > 0) {
    copies_ = create_host_buffer(device, "copies", geometry.copy_count() * sizeof(MeshCopy),
                                 vk::BufferUsageFlagBits::eVertexBuffer);
    written_copies_.resize(geometry.copy_count());
    std::memcpy(copies_.mapped, written_copies_.data(), copies_.size);
  }
  if (geometry.shape_count() > 0) {
    shapes_ = create_host_buffer(device, "shapes", geometry.shape_count() * sizeof(scene::Vertex),
                                 vk::BufferUsageFlagBits::eVertexBuffer);
    written_shapes_.resize(geometry.shape_count());
    std::memcpy(shapes_.mapped, written_shapes_.data(), shapes_.size);
  }
  shadow_set_ = allocate(*layouts.shadow);
  write_frame(device, *shadow_set_, uniforms_.front());
  draw_set_ = allocate(*layouts.draw);
  write_uniforms(device, *draw_set_, AFM_BINDING_DRAW, kDynamicUniform,
                 {.buffer = *draw_blocks_.buffer, .range = sizeof(DrawBlock)});
}

bool FrameSlot::Recorded::take(const DrawList& new_draws, const EyePassConfig& new_drawing, std::uint64_t new_panels) {
  if (anything && draws == new_draws && drawing == new_drawing && panels == new_panels) {
    return false;
  }
  draws = new_draws;
  drawing = new_drawing;
  panels = new_panels;
  anything = true;
  return true;
}

void FrameSlot::write(const FrameState& frame, std::span<const DrawBlock> blocks, std::span<const MeshCopy> copies,
                      std::span<const scene::Vertex> shapes, const EyePassConfig& drawing, float guard_band) {
  const glm::vec2 size(static_cast<float>(drawing.extent.width), static_cast<float>(drawing.extent.height));
  for (std::size_t pass = 0; pass < uniforms_.size(); ++pass) {
    FrameBlock block = make_frame_block(frame, pass, size, guard_band);
    block.punctual_count.y = largest_point_px_;
    block.punctual_count.z = guard_band;
    std::memcpy(uniforms_[pass].mapped, &block, sizeof(block));
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    std::memcpy(draw_blocks_.mapped + i * draw_stride_, &blocks[i], sizeof(DrawBlock));
  }
  // compared with a copy in memory: the buffer itself may be slow to read
  for (std::size_t i = 0; i < copies.size(); ++i) {
    if (copies[i] == written_copies_[i]) continue;
    written_copies_[i] = copies[i];
    std::memcpy(copies_.mapped + i * sizeof(MeshCopy), &copies[i], sizeof(MeshCopy));
  }
  if (!shapes.empty() && std::memcmp(written_shapes_.data(), shapes.data(), shapes.size_bytes()) != 0) {
    std::copy(shapes.begin(), shapes.end(), written_shapes_.begin());
    std::memcpy(shapes_.mapped, shapes.data(), shapes.size_bytes());
  }
}

}  // namespace afm::render
