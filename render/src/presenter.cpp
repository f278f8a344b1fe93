// SPDX-License-Identifier: Apache-2.0
#include "render/presenter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "barriers.h"
#include "core/check.h"
#include "explained.h"
#include "renderer_parts.h"
#include "swapchain.h"
#include "window_handle.h"

namespace afm::render {
namespace {

constexpr std::uint64_t kTurnNs = 5'000'000;  // from one call of while_waiting to the next
constexpr int kMostSurfacesLost = 20;         // one after the other
constexpr int kMostTurns = 40;                // how long a display may keep all its images before the loop goes on

constexpr ImageUse kAcquired{vk::PipelineStageFlagBits2::eColorAttachmentOutput, vk::AccessFlagBits2::eNone,
                             vk::ImageLayout::eUndefined};
constexpr ImageUse kDrawn{vk::PipelineStageFlagBits2::eColorAttachmentOutput,
                          vk::AccessFlagBits2::eColorAttachmentWrite, vk::ImageLayout::eColorAttachmentOptimal};
constexpr ImageUse kPresented{vk::PipelineStageFlagBits2::eNone, vk::AccessFlagBits2::eNone,
                              vk::ImageLayout::ePresentSrcKHR};

}  // namespace

PicturePlace picture_place(glm::uvec2 window_px, glm::uvec2 picture_px) {
  const glm::dvec2 window(window_px);
  const glm::dvec2 picture(picture_px);
  double scale = std::min(window.x / picture.x, window.y / picture.y);
  // a picture that was made for this window may be a pixel short of its border
  if (scale > 1.0 && (window_px.x - picture_px.x <= 1 || window_px.y - picture_px.y <= 1)) {
    scale = 1.0;
  }
  const glm::uvec2 size = glm::clamp(glm::uvec2(glm::round(picture * scale)), glm::uvec2(1), window_px);
  return {.offset_px = (window_px - size) / 2U, .size_px = size};
}

// In the order of creation.
struct Presenter::Parts {
  Parts(const Device& the_device, Window& the_window, Renderer::Parts& the_renderer)
      : device(the_device),
        window(the_window),
        renderer(the_renderer),
        surface(window.handle().create_surface(device.instance())),
        pool(*device, vk::CommandPoolCreateInfo{.queueFamilyIndex = device.queue_family()}),
        commands(std::move(
            vk::raii::CommandBuffers(
                *device, {.commandPool = *pool, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1})
                .front())),
        acquired(*device, vk::SemaphoreCreateInfo{}),
        finished(*device, vk::FenceCreateInfo{}) {}
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() { device.wait_idle(); }

  core::Result<void> choose_format();
  bool follow_window();
  std::optional<std::uint32_t> acquire(const std::function<void()>& while_waiting);
  void draw(std::uint32_t index, const Composition& composition);
  void show(std::uint32_t index);
  void replace_surface();
  bool present(const Composition& composition, const std::function<void()>& while_waiting);

  const Device& device;
  Window& window;
  Renderer::Parts& renderer;
  vk::raii::SurfaceKHR surface;
  vk::SurfaceFormatKHR format;
  vk::raii::Pipeline pipeline{nullptr};
  vk::raii::CommandPool pool;
  vk::raii::CommandBuffer commands;
  vk::raii::Semaphore acquired;
  vk::raii::Fence finished;
  std::optional<Swapchain> swapchain;
  bool outdated = false;
  int surfaces_lost = 0;  // since a picture was shown
};

core::Result<void> Presenter::Parts::choose_format() {
  if (device.physical().getSurfaceSupportKHR(device.queue_family(), *surface) == VK_TRUE) {
    format = choose_surface_format(device, *surface);
  }
  if (format.format == vk::Format::eUndefined) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         "cannot show pictures of 8 bits a channel in a window of this display with " + device.name() +
                             ": set the display to a colour depth of 24 bits");
  }
  pipeline = renderer.composer.create_pipeline_for(format.format);
  return {};
}

// Makes the swapchain that fits the window as it is now; false if there is nothing to fit.
bool Presenter::Parts::follow_window() {
  const glm::uvec2 size = window.size_px();
  if (size.x == 0 || size.y == 0) {
    return false;
  }
  const vk::Extent2D wanted{size.x, size.y};
  if (swapchain && !outdated && swapchain->extent() == wanted) {
    return true;
  }
  const auto capabilities = device.physical().getSurfaceCapabilitiesKHR(*surface);
  if (capabilities.maxImageExtent.width == 0 || capabilities.maxImageExtent.height == 0) {
    return false;
  }
  device->waitIdle();
  swapchain = Swapchain(device, *surface, format, wanted, swapchain ? &*swapchain : nullptr);
  outdated = false;
  return true;
}

std::optional<std::uint32_t> Presenter::Parts::acquire(const std::function<void()>& while_waiting) {
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const auto [result, index] = (*swapchain)->acquireNextImage(kTurnNs, *acquired);
    if (result == vk::Result::eSuccess || result == vk::Result::eSuboptimalKHR) {
      return index;
    }
    while_waiting();
  }
  return std::nullopt;
}

void Presenter::Parts::draw(std::uint32_t index, const Composition& composition) {
  const vk::Extent2D window_size = swapchain->extent();
  const vk::Extent2D picture = renderer.composer.extent(composition.mode);
  const PicturePlace place = picture_place({window_size.width, window_size.height}, {picture.width, picture.height});
  pool.reset();
  commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  record_barriers(commands,
                  {image_barrier(swapchain->image(index), vk::ImageAspectFlagBits::eColor, kAcquired, kDrawn)});
  const vk::RenderingAttachmentInfo color{.imageView = swapchain->view(index),
                                          .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                          .loadOp = vk::AttachmentLoadOp::eClear,
                                          .storeOp = vk::AttachmentStoreOp::eStore,
                                          .clearValue = vk::ClearColorValue(std::array{0.0F, 0.0F, 0.0F, 1.0F})};
  commands.beginRendering(
      {.renderArea = {.extent = window_size}, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &color});
  renderer.composer.record(
      commands, *pipeline, composition,
      {.target = window_size,
       .area = {.offset = {static_cast<std::int32_t>(place.offset_px.x), static_cast<std::int32_t>(place.offset_px.y)},
                .extent = {place.size_px.x, place.size_px.y}},
       .screen_px = scene::is_interleaved(composition.mode) ? window.handle().screen_px() : glm::ivec2(0)});
  commands.endRendering();
  record_barriers(commands,
                  {image_barrier(swapchain->image(index), vk::ImageAspectFlagBits::eColor, kDrawn, kPresented)});
  commands.end();

  const vk::CommandBufferSubmitInfo submit{.commandBuffer = *commands};
  const vk::SemaphoreSubmitInfo wait{.semaphore = *acquired,
                                     .stageMask = vk::PipelineStageFlagBits2::eColorAttachmentOutput};
  const vk::SemaphoreSubmitInfo signal{.semaphore = swapchain->drawn(index),
                                       .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
  device.queue().submit2(vk::SubmitInfo2{.waitSemaphoreInfoCount = 1,
                                         .pWaitSemaphoreInfos = &wait,
                                         .commandBufferInfoCount = 1,
                                         .pCommandBufferInfos = &submit,
                                         .signalSemaphoreInfoCount = 1,
                                         .pSignalSemaphoreInfos = &signal},
                         *finished);
}

void Presenter::Parts::show(std::uint32_t index) {
  const vk::Semaphore drawn = swapchain->drawn(index);
  const vk::Result result = device.queue().presentKHR({.waitSemaphoreCount = 1,
                                                       .pWaitSemaphores = &drawn,
                                                       .swapchainCount = 1,
                                                       .pSwapchains = &***swapchain,
                                                       .pImageIndices = &index});
  outdated = result == vk::Result::eSuboptimalKHR;
}

// The window system took the surface away: a display driver was restarted, a monitor was lost.
void Presenter::Parts::replace_surface() {
  if (++surfaces_lost > kMostSurfacesLost) {
    throw DeviceFailure("the window's surface was lost and no other can be had: see to the display and start again");
  }
  device->waitIdle();
  swapchain.reset();
  surface = nullptr;
  surface = window.handle().create_surface(device.instance());
}

Presenter::Presenter(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Presenter::Presenter(Presenter&&) noexcept = default;
Presenter& Presenter::operator=(Presenter&&) noexcept = default;
Presenter::~Presenter() = default;

core::Result<Presenter> Presenter::create(Context& context, Window& window, Renderer& renderer) {
  auto parts = std::make_unique<Parts>(context.device(), window, *renderer.parts_);
  if (auto chosen = parts->choose_format(); !chosen) {
    return tl::unexpected(chosen.error());
  }
  return Presenter(std::move(parts));
}

bool Presenter::present(const Composition& composition, const std::function<void()>& while_waiting) {
  AFM_CHECK(parts_->renderer.eyes_drawn);
  return explained(parts_->device, "showing a picture", [&] { return parts_->present(composition, while_waiting); });
}

bool Presenter::Parts::present(const Composition& composition, const std::function<void()>& while_waiting) {
  try {
    if (!follow_window()) {
      return false;
    }
    const auto index = acquire(while_waiting);
    if (!index) {
      return false;
    }
    draw(*index, composition);

    // presented only once it is drawn: some drivers (lavapipe) would wait inside the call, where nobody beats
    while (device->waitForFences(*finished, VK_TRUE, kTurnNs) == vk::Result::eTimeout) {
      while_waiting();
    }
    device->resetFences(*finished);
    show(*index);
    surfaces_lost = 0;
    return true;
  } catch (const vk::OutOfDateKHRError&) {
    outdated = true;
  } catch (const vk::SurfaceLostKHRError&) {
    replace_surface();
  }
  return false;
}

}  // namespace afm::render
