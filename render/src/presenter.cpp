// SPDX-License-Identifier: Apache-2.0
#include "render/presenter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/check.h"
#include "explained.h"
#include "renderer_parts.h"
#include "window_surface.h"

namespace afm::render {
namespace {

constexpr std::uint64_t kTurnNs = 5'000'000;  // from one call of while_waiting to the next
constexpr int kMostSurfacesLost = 20;         // one after the other
constexpr std::size_t kMostWindows = 2;       // one for each eye

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
  Parts(const Device& the_device, Renderer::Parts& the_renderer)
      : device(the_device),
        renderer(the_renderer),
        pool(*device, vk::CommandPoolCreateInfo{.queueFamilyIndex = device.queue_family()}),
        commands(std::move(
            vk::raii::CommandBuffers(
                *device, {.commandPool = *pool, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1})
                .front())),
        finished(*device, vk::FenceCreateInfo{}) {}
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() { device.wait_idle(); }

  core::Result<void> add(Window& window);
  bool ready(scene::StereoMode mode, const std::function<void()>& while_waiting);
  void draw(const Composition& composition);
  void show();
  bool present(const Composition& composition, const std::function<void()>& while_waiting);

  const Device& device;
  Renderer::Parts& renderer;
  vk::raii::CommandPool pool;
  vk::raii::CommandBuffer commands;
  vk::raii::Fence finished;
  std::vector<std::unique_ptr<WindowSurface>> surfaces;
  int surfaces_lost = 0;  // since a picture was shown
};

core::Result<void> Presenter::Parts::add(Window& window) {
  surfaces.push_back(std::make_unique<WindowSurface>(device, window, renderer.composer));
  return surfaces.back()->choose_format();
}

// Whether every window has an image to draw into.
bool Presenter::Parts::ready(scene::StereoMode mode, const std::function<void()>& while_waiting) {
  const std::uint32_t layers = mode == scene::StereoMode::QuadBuffer ? 2 : 1;
  for (const auto& surface : surfaces) {
    if (!surface->follow_window(layers) || !surface->acquire(while_waiting)) {
      return false;
    }
  }
  return true;
}

void Presenter::Parts::draw(const Composition& composition) {
  const bool dual = composition.mode == scene::StereoMode::Dual;
  pool.reset();
  commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  std::array<vk::SemaphoreSubmitInfo, kMostWindows> waits, signals;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    surfaces[i]->record(commands, composition, dual && i == 1 ? 1 : 0);
    waits[i] = {.semaphore = surfaces[i]->acquired(), .stageMask = vk::PipelineStageFlagBits2::eColorAttachmentOutput};
    signals[i] = {.semaphore = surfaces[i]->drawn(), .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
  }
  commands.end();
  const auto count = static_cast<std::uint32_t>(surfaces.size());
  const vk::CommandBufferSubmitInfo submit{.commandBuffer = *commands};
  device.queue().submit2(vk::SubmitInfo2{.waitSemaphoreInfoCount = count,
                                         .pWaitSemaphoreInfos = waits.data(),
                                         .commandBufferInfoCount = 1,
                                         .pCommandBufferInfos = &submit,
                                         .signalSemaphoreInfoCount = count,
                                         .pSignalSemaphoreInfos = signals.data()},
                         *finished);
}

// All windows in one call: both eyes change in the same refresh where the device can do it.
void Presenter::Parts::show() {
  std::array<vk::Semaphore, kMostWindows> drawn;
  std::array<vk::SwapchainKHR, kMostWindows> swapchains;
  std::array<std::uint32_t, kMostWindows> indices{};
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    drawn[i] = surfaces[i]->drawn();
    swapchains[i] = surfaces[i]->swapchain();
    indices[i] = surfaces[i]->index();
    surfaces[i]->presented();
  }
  const auto count = static_cast<std::uint32_t>(surfaces.size());
  const vk::Result result = device.queue().presentKHR({.waitSemaphoreCount = count,
                                                       .pWaitSemaphores = drawn.data(),
                                                       .swapchainCount = count,
                                                       .pSwapchains = swapchains.data(),
                                                       .pImageIndices = indices.data()});
  if (result == vk::Result::eSuboptimalKHR) {
    for (const auto& surface : surfaces) {
      surface->outdate();
    }
  }
}

Presenter::Presenter(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Presenter::Presenter(Presenter&&) noexcept = default;
Presenter& Presenter::operator=(Presenter&&) noexcept = default;
Presenter::~Presenter() = default;

core::Result<Presenter> Presenter::create(Context& context, Window& window, Renderer& renderer, Window* second) {
  auto parts = std::make_unique<Parts>(context.device(), *renderer.parts_);
  if (auto added = parts->add(window); !added) {
    return tl::unexpected(added.error());
  }
  if (second != nullptr) {
    if (auto added = parts->add(*second); !added) {
      return tl::unexpected(added.error());
    }
  }
  return Presenter(std::move(parts));
}

core::Result<void> Presenter::check_mode(scene::StereoMode mode) const {
  const auto& surfaces = parts_->surfaces;
  if (mode == scene::StereoMode::QuadBuffer && surfaces.front()->most_layers() < 2) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         "stereo mode quad-buffer: " + parts_->device.name() +
                             " gives this display one picture for both eyes; enable stereo in the driver of a "
                             "professional graphics card, or choose another mode");
  }
  if (mode == scene::StereoMode::Dual && surfaces.size() < 2) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         "stereo mode dual: there is one window; start with --stereo dual");
  }
  return {};
}

bool Presenter::present(const Composition& composition, const std::function<void()>& while_waiting) {
  AFM_CHECK(parts_->renderer.eyes_drawn);
  return explained(parts_->device, "showing a picture", [&] { return parts_->present(composition, while_waiting); });
}

bool Presenter::Parts::present(const Composition& composition, const std::function<void()>& while_waiting) {
  try {
    if (!ready(composition.mode, while_waiting)) {
      return false;
    }
    draw(composition);

    // presented only once it is drawn: some drivers (lavapipe) would wait inside the call, where nobody beats
    while (device->waitForFences(*finished, VK_TRUE, kTurnNs) == vk::Result::eTimeout) {
      while_waiting();
    }
    device->resetFences(*finished);
    show();
    surfaces_lost = 0;
    return true;
  } catch (const vk::OutOfDateKHRError&) {
    for (const auto& surface : surfaces) {
      surface->outdate();
    }
  } catch (const vk::SurfaceLostKHRError&) {
    if (++surfaces_lost > kMostSurfacesLost) {
      throw DeviceFailure("the window's surface was lost and no other can be had: see to the display and start again");
    }
    for (const auto& surface : surfaces) {
      surface->replace();
    }
  }
  return false;
}

}  // namespace afm::render
