// SPDX-License-Identifier: Apache-2.0
#include "render/renderer.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "core/check.h"
#include "readback.h"
#include "renderer_parts.h"

namespace afm::render {
namespace {

vk::raii::Semaphore create_timeline(const Device& device) {
  const vk::SemaphoreTypeCreateInfo type{.semaphoreType = vk::SemaphoreType::eTimeline, .initialValue = 0};
  return vk::raii::Semaphore(*device, vk::SemaphoreCreateInfo{.pNext = &type});
}

core::Result<void> check_options(const Device& device, const RendererOptions& options) {
  const auto limits = device.physical().getProperties().limits;
  const auto largest = limits.maxImageDimension2D / 2;  // side by side is twice as wide
  if (options.eye_width == 0 || options.eye_height == 0 || options.eye_width > largest ||
      options.eye_height > largest) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot draw eye images of {}x{} pixels on {}: choose 1 to {} pixels each way",
                                     options.eye_width, options.eye_height, device.name(), largest));
  }
  const auto counts = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
  if (options.samples != 1 && (options.samples != 4 || !(counts & vk::SampleCountFlagBits::e4))) {
    return core::failure(core::ErrorCategory::Failed, fmt::format("cannot draw {} samples a pixel on {}: choose 1 or 4",
                                                                  options.samples, device.name()));
  }
  return {};
}

}  // namespace

Renderer::Parts::Parts(const Device& the_device, const scene::Scene& scene, const RendererOptions& the_options,
                       PanelFonts fonts)
    : device(the_device),
      options(the_options),
      eyes(device, options),
      geometry(device, scene),
      node_count(scene.nodes.size()),
      shadow_map(device),
      frame_set_layout(create_frame_set_layout(device)),
      scene_pass(device, eyes, *frame_set_layout),
      panels(device, std::move(fonts), eyes, *frame_set_layout),
      composer(device, eyes),
      timeline(create_timeline(device)) {
  for (std::size_t i = 0; i < kFramesInFlight; ++i) {
    slots.emplace_back(device, *frame_set_layout, shadow_map, eyes.pass_count(), geometry.draws().size());
  }
}

void Renderer::Parts::wait_for(std::uint64_t value) const {
  const vk::SemaphoreWaitInfo info{.semaphoreCount = 1, .pSemaphores = &*timeline, .pValues = &value};
  AFM_CHECK(device->waitSemaphores(info, std::numeric_limits<std::uint64_t>::max()) == vk::Result::eSuccess);
}

void Renderer::Parts::record(const vk::raii::CommandBuffer& command, FrameSlot& slot, std::size_t slot_index,
                             const FrameState& frame) {
  panels.record_textures(command, slot_index, frame);
  shadow_map.begin(command);
  scene_pass.record_shadow(command, {geometry, slot.draw_order(), frame.visible, slot.set(0), slot.draw_stride()});
  shadow_map.end(command);
  for (std::size_t pass = 0; pass < eyes.pass_count(); ++pass) {
    eyes.begin(command, pass);
    scene_pass.record_eyes(command, {geometry, slot.draw_order(), frame.visible, slot.set(pass), slot.draw_stride()});
    panels.record_rectangles(command, slot.set(pass));
    eyes.end(command, pass);
  }
}

Renderer::Renderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

core::Result<Renderer> Renderer::create(Context& context, const scene::Scene& scene, const RendererOptions& options) {
  if (auto checked = check_options(context.device(), options); !checked) {
    return tl::unexpected(checked.error());
  }
  auto fonts = load_panel_fonts(options.panel_texels_per_m);
  if (!fonts) {
    return tl::unexpected(fonts.error());
  }
  return Renderer(std::make_unique<Parts>(context.device(), scene, options, std::move(*fonts)));
}

void Renderer::render(const FrameState& frame) {
  Parts& parts = *parts_;
  AFM_CHECK(frame.room_from_node.size() == parts.node_count);
  AFM_CHECK(frame.visible.empty() || frame.visible.size() == parts.node_count);
  const std::size_t slot_index = parts.frames % kFramesInFlight;
  FrameSlot& slot = parts.slots[slot_index];
  parts.wait_for(slot.finished_at);
  slot.write(frame, parts.geometry, parts.eyes);
  const auto& command = slot.begin_commands();
  parts.record(command, slot, slot_index, frame);
  command.end();

  slot.finished_at = ++parts.frames;
  parts.eyes_drawn = true;
  const vk::CommandBufferSubmitInfo commands{.commandBuffer = *command};
  const vk::SemaphoreSubmitInfo signal{
      .semaphore = *parts.timeline, .value = slot.finished_at, .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
  parts.device.queue().submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1,
                                               .pCommandBufferInfos = &commands,
                                               .signalSemaphoreInfoCount = 1,
                                               .pSignalSemaphoreInfos = &signal});
}

Image Renderer::read_eye(scene::Eye eye) {
  AFM_CHECK(parts_->eyes_drawn);
  const auto image = parts_->eyes.eye(eye);
  return read_back(parts_->device, image.image, image.layer, parts_->eyes.extent());
}

Image Renderer::read_composed(Layout layout) {
  AFM_CHECK(parts_->eyes_drawn);
  return parts_->composer.compose(layout);
}

bool Renderer::ready() const {
  return parts_->timeline.getCounterValue() >= parts_->slots[parts_->frames % kFramesInFlight].finished_at;
}

core::Result<void> Renderer::resize(std::uint32_t eye_width, std::uint32_t eye_height) {
  RendererOptions options = parts_->options;
  options.eye_width = eye_width;
  options.eye_height = eye_height;
  if (auto checked = check_options(parts_->device, options); !checked) {
    return checked;
  }
  parts_->device->waitIdle();
  parts_->options = options;
  parts_->eyes = EyeTargets(parts_->device, options);
  parts_->composer.eyes_changed();
  parts_->eyes_drawn = false;
  return {};
}

void Renderer::wait() { parts_->wait_for(parts_->frames); }

}  // namespace afm::render
