// SPDX-License-Identifier: Apache-2.0
#include "render/depth_meter.h"

#include <array>
#include <cstring>
#include <limits>
#include <utility>

#include "core/check.h"
#include "device/barriers.h"
#include "device/device_error.h"
#include "device/memory.h"
#include "device/pipelines.h"
#include "device/shader_interface.h"
#include "renderer/renderer_parts.h"
#include "shaders/depth_range_comp.h"

namespace afm::render {
namespace {

constexpr std::uint32_t kGroupPixels = 64;  // 8 invocations of 8 pixels in each direction: shaders/depth_range.comp

// Depths as bits of floats, as the shader stores them.
struct DepthBits {
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t greatest = 0;
};

vk::raii::DescriptorSetLayout create_range_set_layout(const Device& device) {
  const auto binding = [](std::uint32_t index, vk::DescriptorType type) {
    return vk::DescriptorSetLayoutBinding{.binding = index,
                                          .descriptorType = type,
                                          .descriptorCount = 1,
                                          .stageFlags = vk::ShaderStageFlagBits::eCompute};
  };
  const std::array bindings{binding(AFM_BINDING_TEXTURE, vk::DescriptorType::eCombinedImageSampler),
                            binding(AFM_BINDING_RIGHT_EYE, vk::DescriptorType::eCombinedImageSampler),
                            binding(AFM_BINDING_DEPTH_RANGE, vk::DescriptorType::eStorageBuffer)};
  return vk::raii::DescriptorSetLayout(
      *device, {.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()});
}

vk::raii::DescriptorPool create_range_pool(const Device& device) {
  const std::array sizes{
      vk::DescriptorPoolSize{.type = vk::DescriptorType::eCombinedImageSampler, .descriptorCount = 2},
      vk::DescriptorPoolSize{.type = vk::DescriptorType::eStorageBuffer, .descriptorCount = 1}};
  return vk::raii::DescriptorPool(*device, {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                            .maxSets = 1,
                                            .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                            .pPoolSizes = sizes.data()});
}

vk::raii::Pipeline create_range_pipeline(const Device& device, vk::PipelineLayout layout) {
  const vk::raii::ShaderModule module(
      *device, {.codeSize = sizeof(shaders::depth_range_comp), .pCode = std::data(shaders::depth_range_comp)});
  vk::raii::Pipeline pipeline(
      *device, nullptr,
      vk::ComputePipelineCreateInfo{
          .stage = {.stage = vk::ShaderStageFlagBits::eCompute, .module = *module, .pName = "main"}, .layout = layout});
  device.set_name(pipeline, "depth range");
  return pipeline;
}

void record_barrier(const vk::raii::CommandBuffer& command, const vk::MemoryBarrier2& barrier) {
  command.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
}

}  // namespace

// Members in the order of creation.
struct DepthMeter::Parts {
  Parts(const Device& the_device, Renderer& the_renderer)
      : device(the_device),
        renderer(the_renderer),
        set_layout(create_range_set_layout(device)),
        layout(create_pipeline_layout(device, {.sets = {&*set_layout, 1},
                                               .push_stages = vk::ShaderStageFlagBits::eCompute,
                                               .push_size = sizeof(glm::ivec4)})),
        pipeline(create_range_pipeline(device, *layout)),
        sampler(*device, vk::SamplerCreateInfo{.addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                               .addressModeV = vk::SamplerAddressMode::eClampToEdge}),
        range(
            create_readback_buffer(device, "depth range", sizeof(DepthBits), vk::BufferUsageFlagBits::eStorageBuffer)),
        pool(create_range_pool(device)),
        commands_pool(*device, vk::CommandPoolCreateInfo{.queueFamilyIndex = device.queue_family()}),
        commands(std::move(vk::raii::CommandBuffers(*device, {.commandPool = *commands_pool,
                                                              .level = vk::CommandBufferLevel::ePrimary,
                                                              .commandBufferCount = 1})
                               .front())),
        finished(*device, vk::FenceCreateInfo{}) {
    set = std::move(vk::raii::DescriptorSets(
                        *device, {.descriptorPool = *pool, .descriptorSetCount = 1, .pSetLayouts = &*set_layout})
                        .front());
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() { device.wait_idle(); }

  void bind(const EyeTargets& eyes);
  void record(const EyeTargets& eyes);
  void collect();

  const Device& device;
  Renderer& renderer;
  vk::raii::DescriptorSetLayout set_layout;
  vk::raii::PipelineLayout layout;
  vk::raii::Pipeline pipeline;
  vk::raii::Sampler sampler;
  Buffer range;
  vk::raii::DescriptorPool pool;
  vk::raii::DescriptorSet set{nullptr};
  vk::raii::CommandPool commands_pool;
  vk::raii::CommandBuffer commands;
  vk::raii::Fence finished;
  bool under_way = false;
  double near_m = 0;  // near plane of the measured frame
  std::optional<DepthRange> newest;
};

// Binds the eyes' images, which may have been recreated since the last time.
void DepthMeter::Parts::bind(const EyeTargets& eyes) {
  const auto depth = [&](scene::Eye eye) {
    return vk::DescriptorImageInfo{
        .sampler = *sampler, .imageView = eyes.depth(eye), .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
  };
  const std::array images{depth(scene::Eye::Left), depth(scene::Eye::Right)};
  const vk::DescriptorBufferInfo buffer{.buffer = *range.buffer, .range = VK_WHOLE_SIZE};
  const vk::WriteDescriptorSet left{.dstSet = *set,
                                    .dstBinding = AFM_BINDING_TEXTURE,
                                    .descriptorCount = 1,
                                    .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                    .pImageInfo = &images[0]};
  const vk::WriteDescriptorSet right{.dstSet = *set,
                                     .dstBinding = AFM_BINDING_RIGHT_EYE,
                                     .descriptorCount = 1,
                                     .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                     .pImageInfo = &images[1]};
  const vk::WriteDescriptorSet result{.dstSet = *set,
                                      .dstBinding = AFM_BINDING_DEPTH_RANGE,
                                      .descriptorCount = 1,
                                      .descriptorType = vk::DescriptorType::eStorageBuffer,
                                      .pBufferInfo = &buffer};
  device->updateDescriptorSets({left, right, result}, nullptr);
}

void DepthMeter::Parts::record(const EyeTargets& eyes) {
  const vk::Extent2D drawn = eyes.drawing().extent;
  commands_pool.reset();
  commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});

  // the frame prepared its depth for fragment shaders and copies; the next frame waits for those
  constexpr auto kReaders = vk::PipelineStageFlagBits2::eFragmentShader | vk::PipelineStageFlagBits2::eCopy;
  constexpr auto kCompute = vk::PipelineStageFlagBits2::eComputeShader;
  record_barrier(
      commands,
      {.srcStageMask = kReaders, .dstStageMask = kCompute, .dstAccessMask = vk::AccessFlagBits2::eShaderSampledRead});
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout, 0, *set, nullptr);
  commands.pushConstants<glm::ivec4>(*layout, vk::ShaderStageFlagBits::eCompute, 0,
                                     glm::ivec4(drawn.width, drawn.height, 0, 0));
  commands.dispatch((drawn.width + kGroupPixels - 1) / kGroupPixels, (drawn.height + kGroupPixels - 1) / kGroupPixels,
                    1);
  record_barrier(commands, {.srcStageMask = kCompute,
                            .srcAccessMask = vk::AccessFlagBits2::eShaderStorageWrite,
                            .dstStageMask = vk::PipelineStageFlagBits2::eHost | kReaders,
                            .dstAccessMask = vk::AccessFlagBits2::eHostRead});
  commands.end();
}

void DepthMeter::Parts::collect() {
  device->resetFences(*finished);
  under_way = false;
  DepthBits bits;
  std::memcpy(&bits, range.mapped, sizeof(bits));
  newest.reset();
  if (bits.greatest == 0) return;
  const auto metres = [this](std::uint32_t depth_bits) {
    float depth = 0;
    std::memcpy(&depth, &depth_bits, sizeof(depth));
    return near_m / static_cast<double>(depth);  // reversed infinite depth
  };
  newest = DepthRange{.nearest_m = metres(bits.greatest), .farthest_m = metres(bits.least)};
}

DepthMeter::DepthMeter(Context& context, Renderer& renderer)
    : parts_(std::make_unique<Parts>(context.device(), renderer)) {}
DepthMeter::DepthMeter(DepthMeter&&) noexcept = default;
DepthMeter& DepthMeter::operator=(DepthMeter&&) noexcept = default;
DepthMeter::~DepthMeter() = default;

void DepthMeter::measure() {
  newest();
  Parts& parts = *parts_;
  const Renderer::Parts& drawn = *parts.renderer.parts_;
  if (parts.under_way || !drawn.eyes_drawn) return;
  rethrow_as_device_failure(parts.device, "measuring depth", [&] {
    const DepthBits empty;
    std::memcpy(parts.range.mapped, &empty, sizeof(empty));
    parts.bind(drawn.eyes);
    parts.record(drawn.eyes);
    const vk::CommandBufferSubmitInfo submit{.commandBuffer = *parts.commands};
    parts.device.queue().submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1, .pCommandBufferInfos = &submit},
                                 *parts.finished);
    parts.near_m = drawn.near_m;
    parts.under_way = true;
  });
}

std::optional<DepthRange> DepthMeter::newest() {
  Parts& parts = *parts_;
  if (parts.under_way && parts.finished.getStatus() == vk::Result::eSuccess) parts.collect();
  return parts.newest;
}

void DepthMeter::wait() {
  Parts& parts = *parts_;
  if (!parts.under_way) return;
  parts.device.wait_for(parts.finished);
  parts.collect();
}

}  // namespace afm::render
