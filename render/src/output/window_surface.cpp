// SPDX-License-Identifier: Apache-2.0
#include "output/window_surface.h"

#include <span>
#include <utility>

#include "device/barriers.h"
#include "render/presenter.h"

namespace afm::render {
namespace {

constexpr int kMostTurns = 40;  // limit on the wait for a display that keeps all its images

constexpr ImageUse kAcquired{kFilling, vk::AccessFlagBits2::eNone, vk::ImageLayout::eUndefined};
constexpr ImageUse kPresented{vk::PipelineStageFlagBits2::eNone, vk::AccessFlagBits2::eNone,
                              vk::ImageLayout::ePresentSrcKHR};
constexpr ImageUse kComposed{vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
                             vk::ImageLayout::ePresentSrcKHR};

}  // namespace

WindowSurface::WindowSurface(const Device& device, Window& window, Composer& composer, Swap swap)
    : device_(device),
      window_(window),
      composer_(composer),
      wanted_swap_(swap),
      surface_(window.handle().create_surface(device.instance())),
      acquired_(*device, vk::SemaphoreCreateInfo{}) {}

core::Result<void> WindowSurface::choose_format() {
  const auto format = choose_surface_format(device_, *surface_);
  if (!format) return tl::unexpected(format.error());
  format_ = *format;
  const bool ten_bits =
      format_.format == vk::Format::eA2B10G10R10UnormPack32 || format_.format == vk::Format::eA2R10G10B10UnormPack32;
  if (ten_bits && device_.physical().getProperties().deviceType == vk::PhysicalDeviceType::eCpu) {
    const std::optional<std::uint32_t> window = window_.handle().x_window();
    if (window) by_x_ = XPicture::of(*window);
  }
  pipeline_ = composer_.create_pipeline_for(format_.format);
  return {};
}

std::uint32_t WindowSurface::most_layers() const {
  return lost_ ? 1 : device_.physical().getSurfaceCapabilitiesKHR(*surface_).maxImageArrayLayers;
}

Swap WindowSurface::swap() const {
  const bool offered = wanted_swap_ == Swap::WithOthers && offers_present_barrier(device_, *surface_);
  return offered ? Swap::WithOthers : Swap::Alone;
}

bool WindowSurface::follow_window(std::uint32_t layers) {
  const glm::uvec2 size = window_.size_px();
  if (size.x == 0 || size.y == 0) {
    return false;
  }
  if (lost_) replace();
  const vk::Extent2D wanted{size.x, size.y};
  if (swapchain_ && !outdated_ && swapchain_->extent() == wanted && swapchain_->layer_count() == layers) {
    return true;
  }
  const auto capabilities = device_.physical().getSurfaceCapabilitiesKHR(*surface_);
  if (capabilities.maxImageExtent.width == 0 || capabilities.maxImageExtent.height == 0) {
    return false;
  }
  device_.finish_all();
  swapchain_ = Swapchain(device_, *surface_, format_,
                         {.wanted_px = wanted, .layers = layers, .swap = swap(), .read = by_x_ != nullptr},
                         swapchain_ ? &*swapchain_ : nullptr);
  // an image acquired from the old swapchain may have left it signalled
  acquired_ = vk::raii::Semaphore(*device_, vk::SemaphoreCreateInfo{});
  index_.reset();
  outdated_ = false;
  return true;
}

bool WindowSurface::acquire(const std::function<void()>& while_waiting) {
  const int most_turns = std::exchange(starved_, false) ? 1 : kMostTurns;
  for (int turn = 0; !index_ && turn < most_turns; ++turn) {
    const auto [result, index] = (*swapchain_)->acquireNextImage(Device::kTurnNs, *acquired_);
    if (result == vk::Result::eSuccess || result == vk::Result::eSuboptimalKHR) {
      index_ = index;
    } else {
      while_waiting();
    }
  }
  starved_ = !index_;
  return !starved_;
}

void WindowSurface::record(const vk::raii::CommandBuffer& command, const WindowPicture& picture) {
  const Composition& composition = picture.composition;
  const vk::Extent2D window_size = swapchain_->extent();
  const vk::Extent2D whole = composer_.extent(composition.mode);
  const PicturePlace place =
      picture_place({window_size.width, window_size.height}, {whole.width, whole.height}, picture.fit);
  composer_.record(
      command, *pipeline_, composition,
      {.target = window_size,
       .area = {.offset = {static_cast<std::int32_t>(place.offset_px.x), static_cast<std::int32_t>(place.offset_px.y)},
                .extent = {place.size_px.x, place.size_px.y}},
       .screen_px = scene::is_interleaved(composition.mode) ? window_.handle().screen_px() : glm::ivec2(0)},
      {.image = swapchain_->image(*index_),
       .layers = swapchain_->layers(*index_),
       .before = kAcquired,
       .after = kPresented,
       .takes_copies = swapchain_->takes_copies() && format_.format == kEyeFormat,
       .shown = &swapchain_->shown(*index_)});
  if (!by_x_) return;
  const vk::Image image = swapchain_->image(*index_);
  record_barriers(command, {image_barrier(image, kColorAspect, kComposed, kCopiedFrom)});
  host_.record(device_, command, image, 1, window_size);
  record_barriers(command, {image_barrier(image, kColorAspect, kCopiedFrom, kPresented)});
}

void WindowSurface::put() const {
  if (by_x_) by_x_->put(swapchain_->extent(), std::as_bytes(host_.picture(0).bytes));
}

void WindowSurface::replace() {
  device_.finish_all();
  swapchain_.reset();
  index_.reset();
  surface_ = nullptr;
  surface_ = window_.handle().create_surface(device_.instance());
  acquired_ = vk::raii::Semaphore(*device_, vk::SemaphoreCreateInfo{});
  lost_ = false;
}

}  // namespace afm::render
