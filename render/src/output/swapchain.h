// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "composition/composer.h"
#include "device/device.h"
#include "render/presenter.h"

namespace afm::render {

// UNORM in sRGB: 8 bits per channel, which take the eyes' bytes unchanged, or else 10, as on a desktop of 30 bits.
// DeviceMissing if the surface has neither.
core::Result<vk::SurfaceFormatKHR> choose_surface_format(const Device& device, vk::SurfaceKHR surface);

// True if the surface can change its picture in the same refresh as synchronised displays of other machines.
bool offers_present_barrier(const Device& device, vk::SurfaceKHR surface);

// Images of one size that a surface shows in turn, first in, first out. With two layers, the second is the right eye's.
// Recreated for every size.
class Swapchain {
 public:
  // Purpose of the images. `wanted_px` is used if the surface leaves the size to us, `swap` is WithOthers only if the
  // surface offers it, and images that are `read` may be copied.
  struct Use {
    vk::Extent2D wanted_px;
    std::uint32_t layers = 1;
    Swap swap = Swap::Alone;
    bool read = false;
  };

  // `old` may be null; nothing of it may be in flight, and it is unusable afterwards. Throws if vkCreateSwapchainKHR
  // fails.
  Swapchain(const Device& device, vk::SurfaceKHR surface, vk::SurfaceFormatKHR format, const Use& use,
            const Swapchain* old);

  const vk::raii::SwapchainKHR& operator*() const { return swapchain_; }
  const vk::raii::SwapchainKHR* operator->() const { return &swapchain_; }
  vk::Extent2D extent() const { return extent_; }
  vk::Image image(std::uint32_t index) const { return images_[index]; }
  std::uint32_t layer_count() const { return layer_count_; }
  bool takes_copies() const { return takes_copies_; }

  // Picture in an image; images keep their contents between presentations.
  std::optional<ComposedPicture>& shown(std::uint32_t index) { return shown_[index]; }

  // Views of the layers, one each.
  std::span<const vk::ImageView> layers(std::uint32_t index) const {
    return std::span(layers_).subspan(index * layer_count_, layer_count_);
  }

  // Signalled when the picture in the image is drawn; presentation waits for it.
  vk::Semaphore drawn(std::uint32_t index) const { return *drawn_[index]; }

 private:
  vk::Extent2D extent_;
  std::uint32_t layer_count_;
  bool takes_copies_ = false;
  vk::raii::SwapchainKHR swapchain_{nullptr};
  std::vector<vk::Image> images_;  // owned by the swapchain
  std::vector<std::optional<ComposedPicture>> shown_;
  std::vector<vk::raii::ImageView> views_;
  std::vector<vk::ImageView> layers_;  // views of all layers of the first image, then of the next
  std::vector<vk::raii::Semaphore> drawn_;
};

}  // namespace afm::render
