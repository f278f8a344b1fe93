// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "device/device.h"
#include "output/composer.h"
#include "render/presenter.h"

namespace afm::render {

// 8-bit UNORM in sRGB, which takes the eyes' bytes as they are; eUndefined if the surface has none.
vk::SurfaceFormatKHR choose_surface_format(const Device& device, vk::SurfaceKHR surface);

// Whether the surface can change its picture in the same refresh as those of other machines whose displays are in step.
bool offers_present_barrier(const Device& device, vk::SurfaceKHR surface);

// The images of one size that a surface shows in turn, first in first out; with two layers the second is the right
// eye's. Made anew for every size.
class Swapchain {
 public:
  // `wanted` counts where the surface leaves the size to us. `swap`: with others only if the surface offers it. `old`
  // may be null; nothing of it is in flight, and it is not used afterwards. Throws as vkCreateSwapchainKHR fails.
  Swapchain(const Device& device, vk::SurfaceKHR surface, vk::SurfaceFormatKHR format, vk::Extent2D wanted,
            std::uint32_t layers, Swap swap, const Swapchain* old);

  const vk::raii::SwapchainKHR& operator*() const { return swapchain_; }
  const vk::raii::SwapchainKHR* operator->() const { return &swapchain_; }
  vk::Extent2D extent() const { return extent_; }
  vk::Image image(std::uint32_t index) const { return images_[index]; }
  std::uint32_t layer_count() const { return layer_count_; }
  bool takes_copies() const { return takes_copies_; }

  // Images keep what they show from one time they are presented to the next.
  std::optional<ComposedPicture>& shown(std::uint32_t index) { return shown_[index]; }

  // A view of each layer.
  std::span<const vk::ImageView> layers(std::uint32_t index) const {
    return std::span(layers_).subspan(index * layer_count_, layer_count_);
  }

  // Signalled when the picture in the image is drawn; what presents it waits for it.
  vk::Semaphore drawn(std::uint32_t index) const { return *drawn_[index]; }

 private:
  vk::Extent2D extent_;
  std::uint32_t layer_count_;
  bool takes_copies_ = false;
  vk::raii::SwapchainKHR swapchain_{nullptr};
  std::vector<vk::Image> images_;  // owned by the swapchain
  std::vector<std::optional<ComposedPicture>> shown_;
  std::vector<vk::raii::ImageView> views_;
  std::vector<vk::ImageView> layers_;  // of each image in turn
  std::vector<vk::raii::Semaphore> drawn_;
};

}  // namespace afm::render
