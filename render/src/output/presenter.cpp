// SPDX-License-Identifier: Apache-2.0
#include "render/presenter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/check.h"
#include "device/device_error.h"
#include "output/window_surface.h"
#include "renderer/renderer_parts.h"

namespace afm::render {
namespace {

constexpr int kMostSurfacesLost = 20;  // limit on successive losses

}  // namespace

PicturePlace picture_place(glm::uvec2 window_px, glm::uvec2 picture_px, PictureFit fit) {
  if (fit == PictureFit::Fill) {
    return {.offset_px = glm::uvec2(0), .size_px = window_px};
  }
  const glm::dvec2 window(window_px);
  const glm::dvec2 picture(picture_px);
  double scale = std::min(window.x / picture.x, window.y / picture.y);
  // a picture made for this window may be a pixel smaller than it
  if (scale > 1.0 && (window_px.x - picture_px.x <= 1 || window_px.y - picture_px.y <= 1)) {
    scale = 1.0;
  }
  const glm::uvec2 size = glm::clamp(glm::uvec2(glm::round(picture * scale)), glm::uvec2(1), window_px);
  return {.offset_px = (window_px - size) / 2U, .size_px = size};
}

// Members in the order of creation.
struct Presenter::Parts {
  Parts(const Device& the_device, Renderer::Parts& the_renderer)
      : device(the_device),
        renderer(the_renderer),
        pool(*device, vk::CommandPoolCreateInfo{.queueFamilyIndex = device.queue_family()}),
        commands(std::move(
            vk::raii::CommandBuffers(
                *device, {.commandPool = *pool, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1})
                .front())),
        finished(*device, vk::FenceCreateInfo{}) {
    if (renderer.options.time_passes && TimestampQueries::works_on(device)) stopwatch.emplace(device, 2);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() { device.wait_idle(); }

  // Window, and its state in the current frame.
  struct Pane {
    std::unique_ptr<WindowSurface> surface;
    WindowPicture picture;
    bool taken = false;  // true: image available to draw into
    bool drawn = false;
  };

  core::Result<void> add(Window& window, Swap swap);
  template <class Work>
  bool follow_surfaces(Work&& work);
  void draw(std::span<const std::size_t> windows, const std::function<void()>& while_waiting);
  void show();

  const Device& device;
  Renderer::Parts& renderer;
  vk::raii::CommandPool pool;
  vk::raii::CommandBuffer commands;
  vk::raii::Fence finished;
  std::optional<TimestampQueries> stopwatch;  // marks 0 and 1: before and after composing
  std::vector<Pane> panes;
  int surfaces_lost = 0;  // number of losses since a picture was last shown
};

core::Result<void> Presenter::Parts::add(Window& window, Swap swap) {
  panes.push_back({.surface = std::make_unique<WindowSurface>(device, window, renderer.composer, swap), .picture = {}});
  return panes.back().surface->choose_format();
}

// Runs `work`, which may find a surface outdated or lost; false if it does.
template <class Work>
bool Presenter::Parts::follow_surfaces(Work&& work) {
  try {
    std::forward<Work>(work)();
    return true;
  } catch (const vk::SystemError& error) {
    const auto result = static_cast<vk::Result>(error.code().value());
    // Mesa also returns this when the display has gone, which the window's next poll() finds
    const bool no_memory = result == vk::Result::eErrorOutOfHostMemory || result == vk::Result::eErrorOutOfDeviceMemory;
    const bool lost = result == vk::Result::eErrorSurfaceLostKHR;
    if (!no_memory && !lost && result != vk::Result::eErrorOutOfDateKHR) throw;
    if ((no_memory || lost) && ++surfaces_lost > kMostSurfacesLost) {
      if (no_memory) throw;
      throw DeviceFailure("the window's surface was lost and cannot be recreated: check the display and start again");
    }
    for (Pane& pane : panes) lost ? pane.surface->lose() : pane.surface->outdate();
  }
  for (Pane& pane : panes) {
    pane.taken = pane.drawn = false;
  }
  return false;
}

void Presenter::Parts::draw(std::span<const std::size_t> windows, const std::function<void()>& while_waiting) {
  std::array<vk::SemaphoreSubmitInfo, kMostWindows> waits, signals;
  std::uint32_t count = 0;
  pool.reset();
  commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  if (stopwatch) {
    stopwatch->reset(commands, 0, 2);
    stopwatch->mark(commands, 0);
  }
  for (const std::size_t window : windows) {
    Pane& pane = panes.at(window);
    if (!pane.taken) {
      continue;
    }
    WindowSurface& surface = *pane.surface;
    surface.record(commands, pane.picture);
    waits[count] = {.semaphore = surface.acquired(), .stageMask = kFilling};
    signals[count] = {.semaphore = surface.drawn(), .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
    pane.drawn = true;
    ++count;
  }
  if (stopwatch) stopwatch->mark(commands, 1);
  commands.end();
  const vk::CommandBufferSubmitInfo submit{.commandBuffer = *commands};
  device.queue().submit2(vk::SubmitInfo2{.waitSemaphoreInfoCount = count,
                                         .pWaitSemaphoreInfos = waits.data(),
                                         .commandBufferInfoCount = 1,
                                         .pCommandBufferInfos = &submit,
                                         .signalSemaphoreInfoCount = count,
                                         .pSignalSemaphoreInfos = signals.data()},
                         *finished);

  // presented only after drawing: some drivers (lavapipe) would otherwise wait inside the call, without a heartbeat
  device.wait_for(finished, while_waiting);
  device->resetFences(*finished);
  if (stopwatch) renderer.compose_ms = stopwatch->between_ms(0, 1);
}

void Presenter::Parts::show() {
  std::array<vk::Semaphore, kMostWindows> drawn;
  std::array<vk::SwapchainKHR, kMostWindows> swapchains;
  std::array<std::uint32_t, kMostWindows> indices{};
  std::uint32_t count = 0;
  for (Pane& pane : panes) {
    if (!pane.drawn) {
      continue;
    }
    drawn[count] = pane.surface->drawn();
    swapchains[count] = pane.surface->swapchain();
    indices[count] = pane.surface->index();
    pane.surface->put();
    pane.surface->presented();
    pane.taken = pane.drawn = false;
    ++count;
  }
  if (count == 0) {
    return;
  }
  const vk::Result result = device.queue().presentKHR({.waitSemaphoreCount = count,
                                                       .pWaitSemaphores = drawn.data(),
                                                       .swapchainCount = count,
                                                       .pSwapchains = swapchains.data(),
                                                       .pImageIndices = indices.data()});
  surfaces_lost = 0;
  if (result == vk::Result::eSuboptimalKHR) {
    for (Pane& pane : panes) {
      pane.surface->outdate();
    }
  }
}

Presenter::Presenter(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Presenter::Presenter(Presenter&&) noexcept = default;
Presenter& Presenter::operator=(Presenter&&) noexcept = default;
Presenter::~Presenter() = default;

core::Result<Presenter> Presenter::create(Context& context, Renderer& renderer, std::span<Window* const> windows,
                                          Swap swap) {
  AFM_CHECK(!windows.empty() && windows.size() <= kMostWindows);
  auto parts = std::make_unique<Parts>(context.device(), *renderer.parts_);
  for (Window* const window : windows) {
    if (auto added = parts->add(*window, swap); !added) {
      return tl::unexpected(added.error());
    }
  }
  return Presenter(std::move(parts));
}

bool Presenter::swaps_with_others() const {
  return std::all_of(parts_->panes.begin(), parts_->panes.end(),
                     [](const Parts::Pane& pane) { return pane.surface->swap() == Swap::WithOthers; });
}

core::Result<void> Presenter::check_mode(scene::StereoMode mode) const {
  const auto flat = [](const Parts::Pane& pane) { return pane.surface->most_layers() < 2; };
  const auto& panes = parts_->panes;
  if (mode == scene::StereoMode::QuadBuffer && std::any_of(panes.begin(), panes.end(), flat)) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         "stereo mode quad-buffer: " + parts_->device.name() +
                             " offers one picture for both eyes on this display; enable stereo in the driver of a "
                             "professional graphics card, or choose another mode");
  }
  return {};
}

bool Presenter::begin(std::span<const WindowPicture> pictures, const std::function<void()>& while_waiting) {
  auto& panes = parts_->panes;
  AFM_CHECK(pictures.size() == panes.size());
  const auto take = [&] {
    for (std::size_t i = 0; i < panes.size(); ++i) {
      const bool quad = pictures[i].composition.mode == scene::StereoMode::QuadBuffer;
      panes[i].picture = pictures[i];
      panes[i].taken = panes[i].surface->follow_window(quad ? 2 : 1) && panes[i].surface->acquire(while_waiting);
    }
  };
  return rethrow_as_device_failure(parts_->device, "showing a picture",
                                   [&] { return parts_->follow_surfaces(take); }) &&
         std::any_of(panes.begin(), panes.end(), [](const Parts::Pane& pane) { return pane.taken; });
}

void Presenter::draw(std::span<const std::size_t> windows, const std::function<void()>& while_waiting) {
  AFM_CHECK(parts_->renderer.eyes_drawn);
  rethrow_as_device_failure(parts_->device, "showing a picture", [&] { parts_->draw(windows, while_waiting); });
}

void Presenter::show() {
  rethrow_as_device_failure(parts_->device, "showing a picture",
                            [&] { parts_->follow_surfaces([&] { parts_->show(); }); });
}

}  // namespace afm::render
