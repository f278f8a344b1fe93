// SPDX-License-Identifier: Apache-2.0
#include "drawing/enlarger.h"

#include <array>
#include <glm/vec2.hpp>
#include <utility>

#include "device/pipelines.h"
#include "device/shader_interface.h"
#include "shaders/enlarge_frag.h"
#include "shaders/enlarge_frag_one_view.h"
#include "shaders/fullscreen_vert.h"

namespace afm::render {
namespace {

vk::raii::DescriptorSetLayout create_enlarging_set_layout(const Device& device) {
  const auto binding = [](std::uint32_t index) {
    return vk::DescriptorSetLayoutBinding{.binding = index,
                                          .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                          .descriptorCount = 1,
                                          .stageFlags = vk::ShaderStageFlagBits::eFragment};
  };
  const std::array bindings{binding(AFM_BINDING_TEXTURE), binding(AFM_BINDING_ROOM_DEPTH)};
  return vk::raii::DescriptorSetLayout(
      *device, {.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()});
}

vk::raii::DescriptorPool create_enlarging_pool(const Device& device) {
  const vk::DescriptorPoolSize size{.type = vk::DescriptorType::eCombinedImageSampler, .descriptorCount = 2};
  return vk::raii::DescriptorPool(*device, {.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                            .maxSets = 1,
                                            .poolSizeCount = 1,
                                            .pPoolSizes = &size});
}

vk::raii::Sampler create_edge_sampler(const Device& device, vk::Filter filter) {
  return vk::raii::Sampler(*device, vk::SamplerCreateInfo{.magFilter = filter,
                                                          .minFilter = filter,
                                                          .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                                          .addressModeV = vk::SamplerAddressMode::eClampToEdge});
}

}  // namespace

Enlarger::Enlarger(const Device& device)
    : device_(device),
      set_layout_(create_enlarging_set_layout(device)),
      layout_(create_pipeline_layout(device, {.sets = {&*set_layout_, 1},
                                              .push_stages = vk::ShaderStageFlagBits::eFragment,
                                              .push_size = sizeof(EnlargeBlock)})),
      pipeline_(device,
                {.name = "enlarge",
                 .layout = *layout_,
                 .topology = vk::PrimitiveTopology::eTriangleStrip,
                 .depth = DepthUse::TestAndWrite,
                 .depth_compare = vk::CompareOp::eAlways},
                {shaders::fullscreen_vert, shaders::fullscreen_vert},
                {shaders::enlarge_frag, shaders::enlarge_frag_one_view}),
      color_sampler_(create_edge_sampler(device, vk::Filter::eLinear)),
      depth_sampler_(create_edge_sampler(device, vk::Filter::eNearest)),
      pool_(create_enlarging_pool(device)) {
  set_ = std::move(vk::raii::DescriptorSets(
                       *device, {.descriptorPool = *pool_, .descriptorSetCount = 1, .pSetLayouts = &*set_layout_})
                       .front());
}

void Enlarger::bind(const EyeTargets& eyes) {
  const auto write = [this](std::uint32_t binding, vk::Sampler sampler, vk::ImageView view) {
    const vk::DescriptorImageInfo image{
        .sampler = sampler, .imageView = view, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
    device_->updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = *set_,
                                                         .dstBinding = binding,
                                                         .descriptorCount = 1,
                                                         .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                         .pImageInfo = &image},
                                  nullptr);
  };
  write(AFM_BINDING_TEXTURE, *color_sampler_, eyes.room());
  write(AFM_BINDING_ROOM_DEPTH, *depth_sampler_, eyes.room_depth());
  bound_ = true;
}

void Enlarger::record(const vk::raii::CommandBuffer& command, const EyeTargets& eyes, std::size_t pass) {
  if (!bound_) bind(eyes);
  const EyePassConfig& drawing = eyes.drawing();
  const glm::vec2 drawn(drawing.extent.width, drawing.extent.height);
  const glm::vec2 scale = drawn / glm::vec2(eyes.extent().width, eyes.extent().height);
  const EnlargeBlock block{.drawn = {scale, drawn}, .layer = {static_cast<int>(pass), 0, 0, 0}};
  command.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline_.get(drawing.pass, vk::SampleCountFlagBits::e1));
  command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, *set_, nullptr);
  command.pushConstants<EnlargeBlock>(*layout_, vk::ShaderStageFlagBits::eFragment, 0, block);
  command.draw(4, 1, 0, 0);
}

}  // namespace afm::render
