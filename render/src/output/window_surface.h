// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "composition/composer.h"
#include "composition/readback.h"
#include "output/swapchain.h"
#include "output/window_handle.h"
#include "output/x_picture.h"
#include "render/presenter.h"

namespace afm::render {

// Stage that waits until an acquired image may be filled.
inline constexpr auto kFilling = vk::PipelineStageFlagBits2::eColorAttachmentOutput | vk::PipelineStageFlagBits2::eCopy;

// Window surface with the images it shows in turn, recreated as the window changes. Not movable; the window and the
// composer must outlive it.
class WindowSurface {
 public:
  WindowSurface(const Device& device, Window& window, Composer& composer, Swap swap);
  WindowSurface(const WindowSurface&) = delete;
  WindowSurface& operator=(const WindowSurface&) = delete;

  // DeviceMissing: the display shows no pictures of 8 or 10 bits per channel.
  core::Result<void> choose_format();

  // 2 on a display with a picture for each eye; 1 while the surface is lost.
  std::uint32_t most_layers() const;

  // Timing of the picture change: WithOthers if requested and offered by the surface.
  Swap swap() const;

  // Creates images that fit the current window; false if there is nothing to fit.
  bool follow_window(std::uint32_t layers);

  // Acquires the image that is drawn next, unless one is already acquired. Returns false if the display provides none
  // for a while, as for a window that nobody sees.
  bool acquire(const std::function<void()>& while_waiting);

  // Draws the picture into layer 0, or each eye's picture into its own layer.
  void record(const vk::raii::CommandBuffer& command, const WindowPicture& picture);

  vk::Semaphore acquired() const { return *acquired_; }
  vk::Semaphore drawn() const { return swapchain_->drawn(*index_); }
  vk::SwapchainKHR swapchain() const { return ***swapchain_; }
  std::uint32_t index() const { return *index_; }

  // Puts the drawn picture into a window that its driver leaves black; call before presented().
  void put() const;

  // Marks the acquired image as presented. An outdated surface gets new images next time.
  void presented() { index_.reset(); }
  void outdate() { outdated_ = true; }

  // Marks the surface as lost, after a driver restart or the loss of a monitor. It is recreated next time.
  void lose() { lost_ = true; }

 private:
  void replace();

  const Device& device_;
  Window& window_;
  Composer& composer_;
  Swap wanted_swap_;
  vk::raii::SurfaceKHR surface_;
  vk::SurfaceFormatKHR format_;
  std::optional<ComposePipeline> pipeline_;
  vk::raii::Semaphore acquired_;
  std::optional<Swapchain> swapchain_;
  std::unique_ptr<XPicture> by_x_;      // picture shown through X; null: shown by the driver
  HostCopy host_;                       // copy of the drawn image for by_x_
  std::optional<std::uint32_t> index_;  // index of the acquired image
  bool outdated_ = false;
  bool lost_ = false;
  bool starved_ = false;  // true: no image last time, so the next wait is short
};

}  // namespace afm::render
