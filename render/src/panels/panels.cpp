// SPDX-License-Identifier: Apache-2.0
#include "panels/panels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "device/barriers.h"
#include "device/pipelines.h"
#include "device/shader_interface.h"
#include "panels/panel_painting.h"
#include "shaders/panel_frag.h"
#include "shaders/panel_vert.h"
#include "shaders/panel_vert_one_view.h"

namespace afm::render {
namespace {

constexpr std::uint32_t kLargestTexture = 8192;  // limit for width and height; smaller if the device requires it

const Label kNoLabel{.text = {}, .highlighted = false, .placement = kNoPlacement};

vk::raii::DescriptorSetLayout create_texture_layout(const Device& device) {
  const vk::DescriptorSetLayoutBinding binding{.binding = AFM_BINDING_TEXTURE,
                                               .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                               .descriptorCount = 1,
                                               .stageFlags = vk::ShaderStageFlagBits::eFragment};
  return vk::raii::DescriptorSetLayout(*device, {.bindingCount = 1, .pBindings = &binding});
}

vk::raii::PipelineLayout create_rectangle_layout(const Device& device, vk::DescriptorSetLayout frame,
                                                 vk::DescriptorSetLayout texture) {
  const std::array sets{frame, texture};
  return create_pipeline_layout(
      device, {.sets = sets, .push_stages = vk::ShaderStageFlagBits::eVertex, .push_size = sizeof(PanelBlock)});
}

constexpr EyeCode kRectangleVertex{shaders::panel_vert, shaders::panel_vert_one_view};
constexpr EyeCode kRectangleFragment{shaders::panel_frag, shaders::panel_frag};

PipelineRequest rectangle_request(vk::PipelineLayout layout, const char* name, DepthUse depth) {
  return {.name = name,
          .layout = layout,
          .topology = vk::PrimitiveTopology::eTriangleStrip,
          .blending = Blending::Premultiplied,
          .depth = depth};
}

glm::dvec2 size_m(const PanelPlacement& placement) {
  return {glm::length(placement.right_m), glm::length(placement.up_m)};
}

// Size of a panel in the panels' millimetres.
glm::dvec2 size_mm(const PanelPlacement& placement, const PanelFonts& fonts) {
  return size_m(placement) * 1000.0 * static_cast<double>(fonts.true_mm);
}

// Placement of an eye's letter: the L in the left half of the calibration picture, the R in the right.
PanelPlacement mark_placement(const PanelPlacement& whole, scene::Eye eye) {
  const double left = eye == scene::Eye::Left ? 0.14 : 0.66;
  return {.lower_left_m = whole.lower_left_m + left * whole.right_m + 0.36 * whole.up_m,
          .right_m = 0.20 * whole.right_m,
          .up_m = 0.36 * whole.up_m};
}

// Enlarges the buffer to at least `bytes`, with room to grow.
void reserve(const Device& device, Buffer& buffer, const char* name, std::size_t bytes, vk::BufferUsageFlags usage) {
  if (buffer.size < bytes) {
    buffer = create_host_buffer(device, name, std::max<vk::DeviceSize>(2 * bytes, 65536), usage);
  }
}

}  // namespace

Panels::Panels(const Device& device, FontFiles fonts, vk::DescriptorSetLayout frame_set_layout,
               const RendererOptions& options)
    : device_(device),
      options_(options),
      largest_texture_(std::min(kLargestTexture, device.physical().getProperties().limits.maxImageDimension2D)),
      font_files_(std::move(fonts)),
      texture_layout_(create_texture_layout(device)),
      canvas_layout_(create_pipeline_layout(device, {.sets = {&*texture_layout_, 1},
                                                     .push_stages = vk::ShaderStageFlagBits::eVertex,
                                                     .push_size = sizeof(CanvasBlock)})),
      rectangle_layout_(create_rectangle_layout(device, frame_set_layout, *texture_layout_)),
      rectangle_pipeline_(device, rectangle_request(*rectangle_layout_, "panels", DepthUse::TestOnly), kRectangleVertex,
                          kRectangleFragment),
      over_all_pipeline_(device, rectangle_request(*rectangle_layout_, "banner", DepthUse::None), kRectangleVertex,
                         kRectangleFragment),
      sampler_(*device, vk::SamplerCreateInfo{.magFilter = vk::Filter::eLinear,
                                              .minFilter = vk::Filter::eLinear,
                                              .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                              .addressModeV = vk::SamplerAddressMode::eClampToEdge,
                                              .addressModeW = vk::SamplerAddressMode::eClampToEdge}) {}

Panels::~Panels() = default;

PanelBrush& Panels::brush() {
  if (!brush_) {
    auto fonts = draw_panel_fonts(font_files_, options_.panel_texels_per_m, options_.panel_millimetre_m,
                                  device_.physical().getProperties().limits.maxImageDimension2D);
    if (!fonts) throw std::runtime_error(fonts.error().message);
    brush_.emplace(device_, std::move(*fonts), PanelBrush::Layouts{*texture_layout_, *canvas_layout_, *sampler_});
    font_files_ = {};
  }
  return *brush_;
}

// Gives the panel a texture for its placement's size; true if it is a new one.
bool Panels::resize(Panel& panel) {
  const PanelFonts& fonts = brush().fonts();
  const glm::dvec2 canvas =
      glm::max(glm::ceil(size_mm(panel.placement, fonts) * static_cast<double>(fonts.texels_per_mm)), glm::dvec2(1.0));
  const double shrink = std::min(1.0, largest_texture_ / std::max(canvas.x, canvas.y));
  const glm::dvec2 texels = glm::clamp(glm::ceil(shrink * canvas), glm::dvec2(1.0), glm::dvec2(largest_texture_));
  const vk::Extent2D extent{static_cast<std::uint32_t>(texels.x), static_cast<std::uint32_t>(texels.y)};
  panel.canvas_texels = glm::vec2(canvas);
  if (panel.texture.image.extent == extent) {
    return false;
  }
  const vk::ImageUsageFlags usage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc;
  retired_[slot_].push_back(std::exchange(
      panel.texture, create_panel_texture(device_, "panel", {.format = kPanelFormat, .extent = extent, .usage = usage},
                                          *texture_layout_, *sampler_)));
  ++revision_;
  return true;
}

template <class Content>
void Panels::paint_on(Panel& panel, const Content& content, Texels texels) {
  brush().take_up();
  const PanelFonts& fonts = brush().fonts();
  ImGui::GetIO().DisplaySize = {panel.canvas_texels.x, panel.canvas_texels.y};
  ImGui::NewFrame();
  Canvas canvas(*ImGui::GetBackgroundDrawList(), fonts, memory_, glm::vec2(size_mm(panel.placement, fonts)),
                options_.panel_contrast);
  paint(canvas, content);
  ImGui::Render();

  const ImDrawData* data = ImGui::GetDrawData();
  Painting painting{.panel = &panel,
                    .first_vertex = shapes_.vertices.size(),
                    .first_index = shapes_.indices.size(),
                    .first_command = shapes_.commands.size()};
  latest_.clear();
  for (int i = 0; i < data->CmdListsCount; ++i) {
    const ImDrawList& list = *data->CmdLists[i];
    latest_.add(list);
    for (ImDrawCmd command : list.CmdBuffer) {
      command.VtxOffset += static_cast<unsigned int>(shapes_.vertices.size() - painting.first_vertex);
      command.IdxOffset += static_cast<unsigned int>(shapes_.indices.size() - painting.first_index);
      shapes_.commands.push_back(command);
    }
    shapes_.vertices.insert(shapes_.vertices.end(), list.VtxBuffer.begin(), list.VtxBuffer.end());
    shapes_.indices.insert(shapes_.indices.end(), list.IdxBuffer.begin(), list.IdxBuffer.end());
  }
  painting.command_count = shapes_.commands.size() - painting.first_command;
  const std::optional<CanvasBox> changed = latest_.difference(panel.shapes);
  std::swap(latest_, panel.shapes);
  painting.whole = texels == Texels::Fresh || !changed;
  panel.part = painting.whole ? PanelPart{} : part_of(*changed, panel.canvas_texels, panel.texture.image.extent);
  painting.whole = painting.whole || options_.redraw == Redraw::Everything;
  paintings_.push_back(painting);
}

template <class Content>
void Panels::update(Panel& panel, const PanelPlacement& placement, const Content& content, Content& painted) {
  const glm::dvec2 size = size_m(placement);
  const bool shown = size.x > 0.0 && size.y > 0.0;
  if (panel.placement != placement || panel.shown != shown) {
    ++revision_;
  }
  panel.placement = placement;
  panel.layer = kLayerOf<Content>;
  panel.shown = shown;
  if (!panel.shown) {
    return;
  }
  const bool resized = resize(panel);
  if (resized || panel.painting == 0 || !(painted == content)) {
    painted = content;
    ++panel.painting;
    paint_on(panel, content, resized ? Texels::Fresh : Texels::Kept);
  }
}

bool Panels::update(const FrameState& frame, std::size_t slot) {
  slot_ = slot;
  retired_[slot].clear();
  paintings_.clear();
  shapes_.vertices.clear();
  shapes_.indices.clear();
  shapes_.commands.clear();
  memory_.grids.clear();
  std::size_t slot_index = 0;
  core::for_each_member(
      [&](auto& painted, const auto& shown) {
        update(slots_[slot_index++], shown.placement, shown.content, painted.content);
      },
      painted_.panels, frame.panels);
  labels_.resize(std::max(labels_.size(), frame.labels.size()));
  painted_.labels.resize(labels_.size());
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    const Label& label = i < frame.labels.size() ? frame.labels[i] : kNoLabel;
    update(labels_[i], label.placement, label, painted_.labels[i]);
  }
  const PanelSlot<CalibrationPanel>& calibration = frame.panels.calibration;
  for (std::size_t i = 0; i < eye_marks_.size(); ++i) {
    eye_marks_[i].only_eye = scene::kEyes[i];
    update(eye_marks_[i],
           calibration.content.eye_marks ? mark_placement(calibration.placement, scene::kEyes[i]) : kNoPlacement,
           EyeMark{scene::kEyes[i]}, painted_.marks[i]);
  }
  return !paintings_.empty();
}

void Panels::record_textures(const vk::raii::CommandBuffer& command, std::size_t slot) {
  Geometry& geometry = geometry_[slot];
  const std::size_t vertex_bytes = shapes_.vertices.size() * sizeof(ImDrawVert);
  const std::size_t index_bytes = shapes_.indices.size() * sizeof(ImDrawIdx);
  reserve(device_, geometry.vertices, "panel vertices", vertex_bytes, vk::BufferUsageFlagBits::eVertexBuffer);
  reserve(device_, geometry.indices, "panel indices", index_bytes, vk::BufferUsageFlagBits::eIndexBuffer);
  std::memcpy(geometry.vertices.mapped, shapes_.vertices.data(), vertex_bytes);
  std::memcpy(geometry.indices.mapped, shapes_.indices.data(), index_bytes);
  geometry.grids.record_upload(command, device_, memory_.grids, *texture_layout_, *sampler_);
  for (const Painting& painting : paintings_) {
    record_painting(command, geometry, painting);
  }
}

void Panels::record_painting(const vk::raii::CommandBuffer& command, const Geometry& geometry,
                             const Painting& painting) const {
  const Panel& panel = *painting.panel;
  const vk::Extent2D extent = panel.texture.image.extent;
  const PixelBox part =
      painting.whole ? PixelBox::whole(extent) : texels_of(panel.part, extent).within(PixelBox::whole(extent));
  if (part.empty()) return;
  record_barriers(command, {image_barrier(*panel.texture.image.image, kColorAspect,
                                          painting.whole ? kPanelSampled.discarded() : kPanelSampled, kColorDrawn)});
  const vk::RenderingAttachmentInfo color{.imageView = *panel.texture.view,
                                          .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                          .loadOp = vk::AttachmentLoadOp::eClear,
                                          .storeOp = vk::AttachmentStoreOp::eStore};
  command.beginRendering(
      {.renderArea = part.rect(), .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &color});
  const auto bind = [&](const vk::raii::Pipeline& pipeline, vk::DescriptorSet texture) {
    command.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
    command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *canvas_layout_, 0, texture, nullptr);
  };
  bind(brush_->canvas(), brush_->glyphs());
  set_viewport(command, extent);
  const CanvasBlock block{.scale = {2.0F / panel.canvas_texels.x, 2.0F / panel.canvas_texels.y, 0.0F, 0.0F}};
  command.pushConstants<CanvasBlock>(*canvas_layout_, vk::ShaderStageFlagBits::eVertex, 0, block);
  command.bindVertexBuffers(0, *geometry.vertices.buffer, vk::DeviceSize{0});
  command.bindIndexBuffer(*geometry.indices.buffer, 0,
                          sizeof(ImDrawIdx) == 2 ? vk::IndexType::eUint16 : vk::IndexType::eUint32);
  for (std::size_t i = 0; i < painting.command_count; ++i) {
    const ImDrawCmd& draw = shapes_.commands[painting.first_command + i];
    const glm::vec2 limit(static_cast<float>(extent.width), static_cast<float>(extent.height));
    const glm::vec2 shrink = limit / panel.canvas_texels;
    const glm::vec2 from = glm::clamp(shrink * glm::vec2(draw.ClipRect.x, draw.ClipRect.y), glm::vec2(0.0F), limit);
    const glm::vec2 to = glm::clamp(shrink * glm::vec2(draw.ClipRect.z, draw.ClipRect.w), from, limit);
    const PixelBox clip = PixelBox{glm::ivec2(from), glm::ivec2(from) + glm::ivec2(to - glm::floor(from))}.within(part);
    if (clip.empty()) continue;
    command.setScissor(0, clip.rect());
    const bool is_grid = draw.GetTexID() == &memory_.grids;
    if (is_grid) bind(brush_->grids(), geometry.grids.set());
    command.drawIndexed(draw.ElemCount, 1, static_cast<std::uint32_t>(painting.first_index) + draw.IdxOffset,
                        static_cast<std::int32_t>(painting.first_vertex + draw.VtxOffset), 0);
    if (is_grid) bind(brush_->canvas(), brush_->glyphs());
  }
  command.endRendering();
  record_barriers(command, {image_barrier(*panel.texture.image.image, kColorAspect, kColorDrawn, kPanelSampled)});
}

bool Panels::shows_any() const {
  const auto is_seen = [](const Panel& panel) { return panel.shown && !panel.apart; };
  return std::any_of(slots_.begin(), slots_.end(), is_seen) || std::any_of(labels_.begin(), labels_.end(), is_seen) ||
         std::any_of(eye_marks_.begin(), eye_marks_.end(), is_seen);
}

void Panels::record_rectangles(const vk::raii::CommandBuffer& command, const EyePassConfig& drawing,
                               vk::DescriptorSet frame_set) {
  if (!shows_any()) return;  // no panel, so that no pipeline is needed yet
  command.bindPipeline(vk::PipelineBindPoint::eGraphics, rectangle_pipeline_.get(drawing.pass, drawing.samples));
  command.setCullMode(vk::CullModeFlagBits::eNone);
  const auto show = [&](const Panel& panel) {
    if (!panel.shown || panel.apart) {
      return;
    }
    const std::array sets{frame_set, *panel.texture.set};
    command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *rectangle_layout_, 0, sets, nullptr);
    const float only_eye = !panel.only_eye ? -1.0F : *panel.only_eye == scene::Eye::Left ? 0.0F : 1.0F;
    const PanelBlock block{.lower_left = glm::vec4(glm::vec3(panel.placement.lower_left_m), only_eye),
                           .right = glm::vec4(glm::vec3(panel.placement.right_m), 0.0F),
                           .up = glm::vec4(glm::vec3(panel.placement.up_m), 0.0F)};
    command.pushConstants<PanelBlock>(*rectangle_layout_, vk::ShaderStageFlagBits::eVertex, 0, block);
    command.draw(4, 1, 0, 0);
  };
  const auto show_all = [&](PanelLayer layer) {
    for (const Panel& panel : slots_) {
      if (panel.layer == layer) show(panel);
    }
  };
  show_all(PanelLayer::InScene);
  std::for_each(labels_.begin(), labels_.end(), show);
  command.bindPipeline(vk::PipelineBindPoint::eGraphics, over_all_pipeline_.get(drawing.pass, drawing.samples));
  show_all(PanelLayer::OverAll);
  command.bindPipeline(vk::PipelineBindPoint::eGraphics, rectangle_pipeline_.get(drawing.pass, drawing.samples));
  show_all(PanelLayer::Calibration);
  std::for_each(eye_marks_.begin(), eye_marks_.end(), show);
}

}  // namespace afm::render
