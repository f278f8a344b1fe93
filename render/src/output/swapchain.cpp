// SPDX-License-Identifier: Apache-2.0
#include "output/swapchain.h"

#include <algorithm>
#include <limits>

#include "drawing/eye_targets.h"

namespace afm::render {
namespace {

// Extent of a surface that leaves its size to the application (Wayland).
constexpr std::uint32_t kFreeExtent = std::numeric_limits<std::uint32_t>::max();

vk::Extent2D choose_extent(const vk::SurfaceCapabilitiesKHR& surface, vk::Extent2D wanted) {
  if (surface.currentExtent.width != kFreeExtent) {
    return surface.currentExtent;
  }
  return {std::clamp(wanted.width, surface.minImageExtent.width, surface.maxImageExtent.width),
          std::clamp(wanted.height, surface.minImageExtent.height, surface.maxImageExtent.height)};
}

// One more than the minimum, so that drawing need not wait for the image on screen.
std::uint32_t choose_image_count(const vk::SurfaceCapabilitiesKHR& surface) {
  const std::uint32_t count = surface.minImageCount + 1;
  return surface.maxImageCount == 0 ? count : std::min(count, surface.maxImageCount);
}

vk::CompositeAlphaFlagBitsKHR choose_alpha(const vk::SurfaceCapabilitiesKHR& surface) {
  const auto opaque = vk::CompositeAlphaFlagBitsKHR::eOpaque;
  return surface.supportedCompositeAlpha & opaque ? opaque : vk::CompositeAlphaFlagBitsKHR::eInherit;
}

}  // namespace

core::Result<vk::SurfaceFormatKHR> choose_surface_format(const Device& device, vk::SurfaceKHR surface) {
  if (device.physical().getSurfaceSupportKHR(device.queue_family(), surface) == VK_TRUE) {
    const auto formats = device.physical().getSurfaceFormatsKHR(surface);
    for (const vk::Format wanted : {kEyeFormat, vk::Format::eR8G8B8A8Unorm, vk::Format::eA2B10G10R10UnormPack32,
                                    vk::Format::eA2R10G10B10UnormPack32}) {
      const vk::SurfaceFormatKHR format{wanted, vk::ColorSpaceKHR::eSrgbNonlinear};
      if (std::find(formats.begin(), formats.end(), format) != formats.end()) return format;
    }
  }
  return core::failure(core::ErrorCategory::DeviceMissing,
                       "cannot show pictures with 8 or 10 bits per channel in a window on this display with " +
                           device.name() + ": set the display to a colour depth of 24 or 30 bits");
}

bool offers_present_barrier(const Device& device, vk::SurfaceKHR surface) {
  using Barrier = vk::SurfaceCapabilitiesPresentBarrierNV;
  return device.present_barrier() && device.physical()
                                             .getSurfaceCapabilities2KHR<vk::SurfaceCapabilities2KHR, Barrier>(
                                                 vk::PhysicalDeviceSurfaceInfo2KHR{.surface = surface})
                                             .get<Barrier>()
                                             .presentBarrierSupported == VK_TRUE;
}

Swapchain::Swapchain(const Device& device, vk::SurfaceKHR surface, vk::SurfaceFormatKHR format, const Use& use,
                     const Swapchain* old)
    : layer_count_(use.layers) {
  const vk::SwapchainPresentBarrierCreateInfoNV barrier{.presentBarrierEnable = VK_TRUE};
  const auto capabilities = device.physical().getSurfaceCapabilitiesKHR(surface);
  extent_ = choose_extent(capabilities, use.wanted_px);
  constexpr auto kCopies = vk::ImageUsageFlagBits::eTransferDst;
  takes_copies_ = static_cast<bool>(capabilities.supportedUsageFlags & kCopies);
  vk::ImageUsageFlags usage = vk::ImageUsageFlagBits::eColorAttachment;
  if (takes_copies_) usage |= kCopies;
  if (use.read) usage |= vk::ImageUsageFlagBits::eTransferSrc;
  swapchain_ =
      vk::raii::SwapchainKHR(*device, {.pNext = use.swap == Swap::WithOthers ? &barrier : nullptr,
                                       .surface = surface,
                                       .minImageCount = choose_image_count(capabilities),
                                       .imageFormat = format.format,
                                       .imageColorSpace = format.colorSpace,
                                       .imageExtent = extent_,
                                       .imageArrayLayers = use.layers,
                                       .imageUsage = usage,
                                       .imageSharingMode = vk::SharingMode::eExclusive,
                                       .preTransform = capabilities.currentTransform,
                                       .compositeAlpha = choose_alpha(capabilities),
                                       .presentMode = vk::PresentModeKHR::eFifo,
                                       .clipped = VK_FALSE,  // parts hidden by other windows are kept
                                       .oldSwapchain = old == nullptr ? vk::SwapchainKHR() : *old->swapchain_});
  for (const VkImage image : swapchain_.getImages()) {
    images_.emplace_back(image);
    shown_.emplace_back();
    for (std::uint32_t layer = 0; layer < use.layers; ++layer) {
      views_.emplace_back(*device,
                          vk::ImageViewCreateInfo{.image = image,
                                                  .viewType = vk::ImageViewType::e2D,
                                                  .format = format.format,
                                                  .subresourceRange = {.aspectMask = vk::ImageAspectFlagBits::eColor,
                                                                       .levelCount = 1,
                                                                       .baseArrayLayer = layer,
                                                                       .layerCount = 1}});
      layers_.push_back(*views_.back());
    }
    drawn_.emplace_back(*device, vk::SemaphoreCreateInfo{});
  }
}

}  // namespace afm::render
