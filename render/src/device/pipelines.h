// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "device/device.h"

namespace afm::render {

enum class Blending { Opaque, Premultiplied };
enum class DepthUse { None, TestAndWrite, TestOnly };

// Parameters that differ between the renderer's graphics pipelines. Viewport, scissor, cull mode and front face are
// dynamic.
struct PipelineRequest {
  std::string name;
  std::span<const std::uint32_t> vertex_code{};
  std::span<const std::uint32_t> fragment_code{};  // empty: depth only
  vk::PipelineLayout layout{};
  std::span<const vk::VertexInputBindingDescription> bindings{};
  std::span<const vk::VertexInputAttributeDescription> attributes{};
  vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleList;
  vk::Format color_format = vk::Format::eUndefined;  // format of the colour image; eUndefined: none
  vk::Format depth_format = vk::Format::eUndefined;
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  std::uint32_t view_mask = 0;
  Blending blending = Blending::Opaque;
  DepthUse depth = DepthUse::None;
  vk::CompareOp depth_compare = vk::CompareOp::eGreater;  // reversed depth
  std::uint32_t variant = 0;                              // value of AFM_CONSTANT_VARIANT in both shaders
  bool one_light = false;                                 // value of AFM_CONSTANT_ONE_LIGHT
};

vk::raii::Pipeline create_pipeline(const Device& device, const PipelineRequest& request);

struct LayoutRequest {
  std::span<const vk::DescriptorSetLayout> sets{};
  vk::ShaderStageFlags push_stages{};
  std::uint32_t push_size = 0;
};

vk::raii::PipelineLayout create_pipeline_layout(const Device& device, const LayoutRequest& request);

// Sets the scissor to the whole target, and a viewport `guard_band` times as large with the same centre; disables
// culling.
void set_viewport(const vk::raii::CommandBuffer& command, vk::Extent2D extent, float guard_band = 1.0F);

}  // namespace afm::render
