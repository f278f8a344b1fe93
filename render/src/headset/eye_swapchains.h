// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "device/memory.h"
#include "headset/openxr_calls.h"
#include "passes/eye_targets.h"

namespace afm::render {

// A way in which the runtime takes pictures with the bytes of ours: the eyes' images hold sRGB values.
struct HeadsetFormat {
  vk::Format format;
  const char* name;
  bool other_order;  // of red and blue than the eyes' images
};

// The first of the formats that we can fill which the runtime offers; nothing if it offers none of them.
std::optional<HeadsetFormat> choose_headset_format(const std::vector<std::int64_t>& offered);

// Images of the runtime of which one at a time is filled.
class PictureChain {
 public:
  // Throws OpenXrFailure.
  PictureChain(const OpenXrInstance& calls, XrSession session, vk::Format format, vk::Extent2D extent,
               std::uint32_t layers);

  // Takes the image that is filled next, unless one is already taken; false if the runtime lends none for a while.
  bool take(const std::function<void()>& while_waiting);
  void give_back();

  XrSwapchain handle() const { return chain_; }
  vk::Image image() const { return images_[index_]; }

 private:
  const OpenXrInstance& calls_;
  XrSwapchain chain_ = XR_NULL_HANDLE;
  std::vector<vk::Image> images_;
  std::uint32_t index_ = 0;
  bool acquired_ = false, taken_ = false;
};

// The pictures of both eyes for the runtime: one chain of images with two layers, or, where it refuses that, one for
// each eye. The eyes are drawn and resolved as for a wall, then copied.
class EyeSwapchains {
 public:
  EyeSwapchains(const OpenXrInstance& calls, XrSession session, const Device& device, HeadsetFormat format,
                vk::Extent2D extent);

  bool take(const std::function<void()>& while_waiting);
  // Copies the newest eyes into the taken images.
  void record(const vk::raii::CommandBuffer& command, const EyeTargets& eyes) const;
  void give_back();

  XrSwapchainSubImage sub_image(scene::Eye eye, vk::Extent2D drawn) const;
  bool layered() const { return chains_.size() == 1; }

 private:
  struct Place {
    vk::Image image;
    std::uint32_t layer = 0;
  };
  Place place(scene::Eye eye) const;
  void record_reordered(const vk::raii::CommandBuffer& command, const EyeTargets& eyes) const;

  HeadsetFormat format_;
  std::vector<PictureChain> chains_;
  DeviceImage reordered_;  // with the runtime's order of the bytes, where that differs
};

}  // namespace afm::render
