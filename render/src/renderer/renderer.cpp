// SPDX-License-Identifier: Apache-2.0
#include "render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "composition/readback.h"
#include "core/check.h"
#include "device/device_error.h"
#include "drawing/shader_variant.h"
#include "render/eye_memory.h"
#include "renderer/renderer_parts.h"

namespace afm::render {
namespace {

vk::raii::Semaphore create_timeline(const Device& device) {
  const vk::SemaphoreTypeCreateInfo type{.semaphoreType = vk::SemaphoreType::eTimeline, .initialValue = 0};
  return vk::raii::Semaphore(*device, vk::SemaphoreCreateInfo{.pNext = &type});
}

core::Result<void> check_options(const Device& device, const RendererOptions& options) {
  const auto limits = device.physical().getProperties().limits;
  const auto largest = limits.maxImageDimension2D;
  if (options.eye_width == 0 || options.eye_height == 0 || options.eye_width > largest ||
      options.eye_height > largest) {
    return core::failure(
        core::ErrorCategory::Failed,
        fmt::format("cannot draw eye images of {}x{} pixels on {}: choose a width and height of 1 to {} pixels",
                    options.eye_width, options.eye_height, device.name(), largest));
  }
  const double needed_gb = 1e-9 * eye_memory_bytes({options.eye_width, options.eye_height}, options.samples);
  const double memory_gb = 1e-9 * static_cast<double>(device.largest_heap_bytes());
  if (needed_gb > memory_gb) {
    return core::failure(
        core::ErrorCategory::Failed,
        fmt::format("cannot draw eye images of {}x{} pixels on {}: they need {:.1f} GB of its {:.1f} GB; choose fewer "
                    "pixels",
                    options.eye_width, options.eye_height, device.name(), needed_gb, memory_gb));
  }
  if (options.pass_mode == PassMode::Multiview && !device.multiview()) {
    return core::failure(
        core::ErrorCategory::Failed,
        fmt::format("cannot draw both eyes in one pass on {}: it does not support multiview; draw them in two passes",
                    device.name()));
  }
  const auto counts = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
  if (options.samples != 1 && (options.samples != 4 || !(counts & vk::SampleCountFlagBits::e4))) {
    return core::failure(
        core::ErrorCategory::Failed,
        fmt::format("cannot draw {} samples per pixel on {}: choose 1 or 4", options.samples, device.name()));
  }
  return {};
}

bool see_the_same(const std::array<scene::EyeView, 2>& eyes) {
  return eyes[0].projection == eyes[1].projection && eyes[0].view == eyes[1].view &&
         eyes[0].eye_position_m == eyes[1].eye_position_m;
}

}  // namespace

Renderer::Parts::Parts(const Device& the_device, const scene::Scene& scene, const RendererOptions& the_options,
                       FontFiles fonts)
    : device(the_device),
      options(the_options),
      quality{.scale = 1.0, .samples = options.samples},
      eyes(device, options),
      geometry(device, scene),
      materials(device, scene),
      node_count(scene.nodes.size()),
      shadow_map(device),
      soft_shadow(device, shadow_map.view()),
      set_layouts(device),
      scene_pass(device, set_layouts, materials, geometry.variants(), options.lighting),
      panels(device, std::move(fonts), *set_layouts.eyes, options),
      enlarger(device),
      composer(device, eyes, eye_changes),
      timeline(create_timeline(device)) {
  for (std::size_t i = 0; i < kFramesInFlight; ++i) {
    slots.emplace_back(device, set_layouts, soft_shadow, geometry);
    if (options.time_passes && TimestampQueries::works_on(device)) {
      clocks.emplace_back(device);
    }
  }
  if (options.lighting == Lighting::KeyAlone) soft_shadow.leave_empty();
}

void Renderer::Parts::wait_for(std::uint64_t value) const { device.wait_for(timeline, value); }

EyePassConfig Renderer::Parts::choose_drawing(const FrameState& frame, const DrawList& draws) const {
  const auto scaled = [&](std::uint32_t whole) {
    return std::max(1U, static_cast<std::uint32_t>(std::lround(quality.scale * static_cast<double>(whole))));
  };
  EyePassConfig drawing{.samples = quality.samples == 4 ? vk::SampleCountFlagBits::e4 : vk::SampleCountFlagBits::e1,
                        .extent = {scaled(eyes.extent().width), scaled(eyes.extent().height)}};
  const bool wrong_in_one = !device.multiview() || (draws.clipped && device.clips_first_view_only());
  if (see_the_same(frame.eyes)) {
    drawing.pass = EyePass::Single;
  } else if (options.pass_mode == PassMode::TwoPasses || (options.pass_mode == PassMode::Automatic && wrong_in_one)) {
    drawing.pass = EyePass::Single;
    drawing.pass_count = 2;
  }
  return drawing;
}

void Renderer::Parts::mark(const vk::raii::CommandBuffer& command, std::size_t slot, GpuTimer::Mark mark) const {
  if (!clocks.empty()) {
    clocks[slot].mark(command, mark);
  }
}

void Renderer::Parts::record_painting(std::size_t slot) {
  const auto& command = slots[slot].painting();
  command.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  mark(command, slot, GpuTimer::Mark::PanelsBegin);
  panels.record_textures(command, slot);
  mark(command, slot, GpuTimer::Mark::PanelsEnd);
  command.end();
}

void Renderer::Parts::record_shadow(std::size_t slot_index, ShadowStep step) {
  FrameSlot& slot = slots[slot_index];
  const auto& command = slot.shadow();
  const ScenePass::Input input{.geometry = geometry,
                               .materials = materials,
                               .draws = slot.draws,
                               .frame_set = slot.shadow_set(),
                               .draw_set = slot.draw_set(),
                               .draw_stride = slot.draw_stride(),
                               .copies = slot.copies(),
                               .shapes = slot.shapes()};
  command.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  mark(command, slot_index, GpuTimer::Mark::ShadowBegin);
  if (step == ShadowStep::Everything) {
    shadow_map.begin(command);
    scene_pass.record_shadow(command, input, slot.draws.shadow);
  } else {
    if (step == ShadowStep::StaticAndDynamic) {
      shadow_map.begin_static(command);
      scene_pass.record_shadow(command, input, shadow_casters.static_casters());
      shadow_map.end_static(command);
    }
    shadow_map.begin_on_static(command, shadow_casters.dirty());
    scene_pass.record_shadow(command, input, shadow_casters.dynamic_casters());
  }
  shadow_map.end(command);
  soft_shadow.record(command, shadow_casters.changed());
  mark(command, slot_index, GpuTimer::Mark::ShadowEnd);
  command.end();
}

void Renderer::Parts::submit(std::size_t slot_index) {
  FrameSlot& slot = slots[slot_index];
  slot.finished_at = ++frames;
  std::array<vk::CommandBufferSubmitInfo, 3> commands;
  std::uint32_t count = 0;
  if (slot.painted) {
    commands[count++].commandBuffer = *slot.painting();
  }
  if (slot.shadowed) {
    commands[count++].commandBuffer = *slot.shadow();
  }
  if (!slot.area.empty()) {
    commands[count++].commandBuffer = slot.area.everything() ? *slot.drawing() : *slot.patching();
  }
  const vk::SemaphoreSubmitInfo signal{
      .semaphore = *timeline, .value = slot.finished_at, .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
  device.queue().submit2(vk::SubmitInfo2{.commandBufferInfoCount = count,
                                         .pCommandBufferInfos = commands.data(),
                                         .signalSemaphoreInfoCount = 1,
                                         .pSignalSemaphoreInfos = &signal});
}

void Renderer::Parts::render(const FrameState& frame) {
  const std::size_t slot_index = frames % kFramesInFlight;
  FrameSlot& slot = slots[slot_index];
  wait_for(slot.finished_at);
  lister.list(frame, geometry, eyes.guard_band(), quality.scale * eyes.extent().height, slot.draws);
  eyes.begin_frame(choose_drawing(frame, slot.draws));
  slot.painted = panels.update(frame, slot_index);
  panels.set_apart(frame.panels_apart, PanelSight(frame, geometry, slot.draws));
  now.take(frame, geometry, slot.draws, eyes.drawing(), eyes.guard_band(), panels);
  if (options.redraw == Redraw::Everything) drawn.forget();
  slot.area = damage.between(drawn, now, geometry);
  const ShadowStep step =
      options.lighting == Lighting::KeyAlone ? ShadowStep::Nothing : shadow_casters.update(frame, geometry, slot.draws);
  slot.shadowed = step != ShadowStep::Nothing;
  redrawn_share = slot.area.share_of(eyes.drawing().extent);
  rested = slot.area.empty() && !slot.painted && !slot.shadowed;
  if (rested) {
    return;
  }
  slot.write(frame, now.blocks(), now.copies(), now.shapes(), eyes.drawing(), eyes.guard_band());
  if (slot.painted) {
    record_painting(slot_index);
  }
  if (slot.shadowed) {
    record_shadow(slot_index, step);
  }

  // For a full redraw, the recorded commands are resubmitted while the slot's Recorded stays the same: everything that
  // changes from frame to frame is in the slot's buffers.
  if (!slot.area.everything()) {
    if (!slot.area.empty()) record_patching(slot_index);
  } else if (slot.recorded.take(slot.draws, eyes.drawing(), panels.revision())) {
    record_drawing(slot_index);
  }
  drawn.forget();
  submit(slot_index);
  std::swap(drawn, now);
  if (!slot.area.empty()) {
    eye_changes.add(eyes.enlarged(slot.area));
  }
  eyes_drawn = true;
  near_m = frame.eyes[0].projection[3][2];
}

Renderer::Renderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

core::Result<Renderer> Renderer::create(Context& context, const scene::Scene& scene, const RendererOptions& options) {
  if (auto checked = check_options(context.device(), options); !checked) {
    return tl::unexpected(checked.error());
  }
  const auto largest = context.device().physical().getProperties().limits.maxImageDimension2D;
  for (const scene::Image& image : scene.images) {
    if (image.width > largest || image.height > largest) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("cannot show a texture of {}x{} pixels on {}: the limit is {} pixels in each "
                                       "direction; make the texture smaller",
                                       image.width, image.height, context.device().name(), largest));
    }
  }
  if (const std::size_t variants = count_variants(scene); variants > kMostShaderVariants) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("cannot draw a scene with {} combinations of textures and extensions in its "
                                     "materials: the limit is {}; use fewer kinds of material",
                                     variants, kMostShaderVariants));
  }
  auto fonts = read_panel_fonts();
  if (!fonts) {
    return tl::unexpected(fonts.error());
  }
  try {
    return Renderer(std::make_unique<Parts>(context.device(), scene, options, std::move(*fonts)));
  } catch (const vk::SystemError& error) {
    return core::failure(core::ErrorCategory::Failed,
                         describe_error(error, context.device(), "the pictures of the eyes"));
  }
}

void Renderer::render(const FrameState& frame) {
  AFM_CHECK(frame.room_from_node.size() == parts_->node_count);
  AFM_CHECK(frame.visible.empty() || frame.visible.size() == parts_->node_count);
  for (const MeshCopies& each : frame.copies) {
    AFM_CHECK(each.node < parts_->node_count && each.copies.size() <= parts_->geometry.most_copies(each.node));
  }
  for (const MeshShape& each : frame.shapes) {
    AFM_CHECK(each.node < parts_->node_count && each.vertices.size() == parts_->geometry.shape_size(each.node));
  }
  rethrow_as_device_failure(parts_->device, "drawing a frame", [&] { parts_->render(frame); });
}

Image Renderer::read_eye(scene::Eye eye) {
  AFM_CHECK(parts_->eyes_drawn);
  const auto image = parts_->eyes.eye(eye);
  return rethrow_as_device_failure(parts_->device, "reading a picture back", [&] {
    return read_back(parts_->device, image.image, image.layer, parts_->eyes.extent());
  });
}

Image Renderer::read_composed(const Composition& composition, const ReadArea& area) {
  AFM_CHECK(parts_->eyes_drawn && !scene::has_two_pictures(composition.mode));
  return rethrow_as_device_failure(parts_->device, "reading a picture back",
                                   [&] { return std::move(parts_->composer.compose(composition, area).front()); });
}

std::array<Image, 2> Renderer::read_pair(const Composition& composition, const ReadArea& area) {
  AFM_CHECK(parts_->eyes_drawn && scene::has_two_pictures(composition.mode));
  auto pictures = rethrow_as_device_failure(parts_->device, "reading a picture back",
                                            [&] { return parts_->composer.compose(composition, area); });
  return {std::move(pictures[0]), std::move(pictures[1])};
}

void Renderer::wait_until_ready(const std::function<void()>& while_waiting) {
  rethrow_as_device_failure(parts_->device, "drawing a frame", [&] {
    const std::uint64_t earlier = parts_->slots[parts_->frames % kFramesInFlight].finished_at;
    parts_->device.wait_for(parts_->timeline, earlier, while_waiting);
  });
}

core::Result<void> Renderer::resize(std::uint32_t eye_width, std::uint32_t eye_height) {
  RendererOptions options = parts_->options;
  options.eye_width = eye_width;
  options.eye_height = eye_height;
  if (auto checked = check_options(parts_->device, options); !checked) {
    return checked;
  }
  try {
    EyeTargets eyes(parts_->device, options);
    parts_->device.finish_all();
    parts_->eyes = std::move(eyes);
  } catch (const vk::SystemError& error) {
    return core::failure(core::ErrorCategory::Failed,
                         describe_error(error, parts_->device, "the pictures of the eyes"));
  }
  parts_->options = options;
  for (FrameSlot& slot : parts_->slots) {
    slot.recorded = {};
  }
  parts_->drawn.forget();
  PixelArea everything;
  everything.add_everything();
  parts_->eye_changes.add(everything);
  parts_->composer.eyes_changed();
  parts_->enlarger.eyes_changed();
  parts_->eyes_drawn = false;
  return {};
}

void Renderer::set_quality(const FrameQuality& quality) {
  AFM_CHECK(quality.scale > 0.0 && quality.scale <= 1.0);
  AFM_CHECK(quality.samples == 1 || (quality.samples == 4 && parts_->options.samples == 4));
  parts_->quality = quality;
}

FrameQuality Renderer::quality() const { return parts_->quality; }

std::optional<PassTimes> Renderer::pass_times() const {
  const std::uint64_t finished = parts_->timeline.getCounterValue();
  // the slot of an older frame is in use again
  if (parts_->clocks.empty() || finished == 0 || finished + kFramesInFlight <= parts_->frames) {
    return std::nullopt;
  }
  const std::size_t slot = (finished - 1) % kFramesInFlight;
  const FrameSlot& newest = parts_->slots[slot];
  PassTimes times;
  if (!parts_->rested) times = parts_->clocks[slot].times(newest.painted, newest.shadowed, !newest.area.empty());
  times.compose_ms = parts_->compose_ms;
  times.readback_ms = parts_->readback_ms;
  return times;
}

double Renderer::redrawn_share() const { return parts_->redrawn_share; }

void Renderer::wait() {
  rethrow_as_device_failure(parts_->device, "drawing a frame", [this] { parts_->wait_for(parts_->frames); });
}

}  // namespace afm::render
