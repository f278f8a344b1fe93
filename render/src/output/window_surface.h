// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "output/composer.h"
#include "output/swapchain.h"
#include "output/window_handle.h"
#include "render/presenter.h"

namespace afm::render {

// Stage that waits until an acquired image may be filled.
inline constexpr auto kFilling = vk::PipelineStageFlagBits2::eColorAttachmentOutput | vk::PipelineStageFlagBits2::eCopy;

// A window's surface with the images that it shows in turn, made anew as the window changes. Not moved: the window and
// the composer must outlive it.
class WindowSurface {
 public:
  WindowSurface(const Device& device, Window& window, Composer& composer, Swap swap);
  WindowSurface(const WindowSurface&) = delete;
  WindowSurface& operator=(const WindowSurface&) = delete;

  // DeviceMissing: the display shows no pictures of 8 bits a channel.
  core::Result<void> choose_format();

  // 2 on a display with a picture for each eye; 1 while the surface is lost.
  std::uint32_t most_layers() const;

  // How its pictures change: with those of other machines if that is wanted and the surface offers it.
  Swap swap() const;

  // Makes the images that fit the window as it is now; false if there is nothing to fit.
  bool follow_window(std::uint32_t layers);

  // Takes the image that is drawn next, unless one is already taken; false if the display lends none for a while, as to
  // a window that nobody sees.
  bool acquire(const std::function<void()>& while_waiting);

  // Draws the picture into layer 0, or each eye's into its own.
  void record(const vk::raii::CommandBuffer& command, const WindowPicture& picture);

  vk::Semaphore acquired() const { return *acquired_; }
  vk::Semaphore drawn() const { return swapchain_->drawn(*index_); }
  vk::SwapchainKHR swapchain() const { return ***swapchain_; }
  std::uint32_t index() const { return *index_; }

  // The taken image is presented; an outdated surface gets other images next time.
  void presented() { index_.reset(); }
  void outdate() { outdated_ = true; }

  // The window system took the surface away: a display driver was restarted, a monitor was lost. Another is made next
  // time.
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
  std::optional<std::uint32_t> index_;  // of the image that is taken
  bool outdated_ = false;
  bool lost_ = false;
  bool starved_ = false;  // it lent no image last time, so that nobody waits long for the next
};

}  // namespace afm::render
