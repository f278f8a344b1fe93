// SPDX-License-Identifier: Apache-2.0
#include "panels/panel_brush.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>

#include "device/barriers.h"
#include "device/pipelines.h"
#include "shaders/canvas_frag.h"
#include "shaders/canvas_vert.h"
#include "shaders/grid_frag.h"

namespace afm::render {
namespace {

constexpr std::array<vk::VertexInputBindingDescription, 1> kPanelBindings{
    {{.binding = 0, .stride = sizeof(ImDrawVert)}}};
constexpr std::array<vk::VertexInputAttributeDescription, 3> kPanelAttributes{
    {{.location = 0, .format = vk::Format::eR32G32Sfloat, .offset = offsetof(ImDrawVert, pos)},
     {.location = 1, .format = vk::Format::eR32G32Sfloat, .offset = offsetof(ImDrawVert, uv)},
     {.location = 2, .format = vk::Format::eR8G8B8A8Unorm, .offset = offsetof(ImDrawVert, col)}}};

vk::raii::Pipeline create_canvas_pipeline(const Device& device, const char* name,
                                          std::span<const std::uint32_t> fragment, vk::PipelineLayout layout) {
  return create_pipeline(device, {.name = name,
                                  .vertex_code = shaders::canvas_vert,
                                  .fragment_code = fragment,
                                  .layout = layout,
                                  .bindings = kPanelBindings,
                                  .attributes = kPanelAttributes,
                                  .color_format = kPanelFormat,
                                  .blending = Blending::Premultiplied});
}

}  // namespace

// Frees the context. After a frame cut short by an exception the atlas is locked, and Dear ImGui frees no locked atlas.
void PanelBrush::ContextDeleter::operator()(ImGuiContext* context) const {
  ImGui::SetCurrentContext(context);
  ImGui::GetIO().Fonts->Locked = false;
  ImGui::DestroyContext(context);
}

PanelBrush::PanelBrush(const Device& device, PanelFonts fonts, const Layouts& layouts)
    : fonts_(std::move(fonts)),
      imgui_(ImGui::CreateContext(fonts_.atlas.get())),
      canvas_(create_canvas_pipeline(device, "panel canvas", shaders::canvas_frag, layouts.canvas)),
      grids_(create_canvas_pipeline(device, "panel grids", shaders::grid_frag, layouts.canvas)) {
  take_up();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  upload_atlas(device, layouts);
}

void PanelBrush::upload_atlas(const Device& device, const Layouts& layouts) {
  unsigned char* pixels = nullptr;
  int width = 0;
  int height = 0;
  fonts_.atlas->GetTexDataAsAlpha8(&pixels, &width, &height);
  const vk::Extent2D extent{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
  const std::size_t bytes = std::size_t{extent.width} * extent.height;
  const Buffer staging = create_host_buffer(device, "font atlas staging", bytes, vk::BufferUsageFlagBits::eTransferSrc);
  std::memcpy(staging.mapped, pixels, bytes);
  atlas_ = create_panel_texture(
      device, "font atlas",
      {.format = vk::Format::eR8Unorm, .extent = extent, .usage = vk::ImageUsageFlagBits::eTransferDst},
      layouts.texture, layouts.sampler);
  const ImageUse fresh{};
  device.run_once([&](const vk::raii::CommandBuffer& command) {
    record_barriers(command, {image_barrier(*atlas_.image.image, kColorAspect, fresh, kCopiedTo)});
    command.copyBufferToImage(*staging.buffer, *atlas_.image.image, kCopiedTo.layout,
                              vk::BufferImageCopy{.imageSubresource = {.aspectMask = kColorAspect, .layerCount = 1},
                                                  .imageExtent = {extent.width, extent.height, 1}});
    record_barriers(command, {image_barrier(*atlas_.image.image, kColorAspect, kCopiedTo, kPanelSampled)});
  });
}

}  // namespace afm::render
