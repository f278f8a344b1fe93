// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "device/memory.h"
#include "drawing/eye_targets.h"
#include "headset/openxr_calls.h"

namespace afm::render {

// Picture format of the runtime that can hold our bytes: the eyes' images contain sRGB values.
struct HeadsetFormat {
  vk::Format format;
  const char* name;
  bool other_order;  // true: red and blue swapped against the eyes' images
};

// The runtime's first format that we can fill; nothing if it offers none.
std::optional<HeadsetFormat> choose_headset_format(const std::vector<std::int64_t>& offered);

// State in which the runtime hands over its images and gets them back: as an attachment. Its own use of them between
// two of our frames is unknown.
inline constexpr ImageUse kRuntimes{vk::PipelineStageFlagBits2::eAllCommands,
                                    vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite,
                                    vk::ImageLayout::eColorAttachmentOptimal};
inline constexpr ImageUse kRuntimesDepth{kRuntimes.stages, kRuntimes.access,
                                         vk::ImageLayout::eDepthStencilAttachmentOptimal};

// Images of the runtime; one at a time is being filled.
class PictureChain {
 public:
  // Throws OpenXrFailure.
  PictureChain(const OpenXrInstance& calls, XrSession session, vk::Format format, vk::Extent2D extent,
               std::uint32_t layers);

  // Acquires the image that is filled next, unless one is already acquired. Returns false if the runtime provides none
  // for 250 ms, the longest time a hand may be held without a picture.
  bool take(const std::function<void()>& while_waiting);
  // Same without waiting.
  bool take_if_lent() { return taken_ || wait_once(0); }
  void give_back();

  XrSwapchain handle() const { return chain_; }
  vk::Image image() const { return images_[index_]; }
  bool taken() const { return taken_; }

 private:
  bool wait_once(XrDuration most_ns);

  const OpenXrInstance& calls_;
  XrSwapchain chain_ = XR_NULL_HANDLE;
  std::vector<vk::Image> images_;
  std::uint32_t index_ = 0;
  bool acquired_ = false, taken_ = false;
};

// Pictures of both eyes for the runtime: one chain of images with two layers or, if the runtime refuses that, one chain
// per eye. The eyes are drawn and resolved as for a wall, then copied, as is their depth if the runtime accepts it.
class EyeSwapchains {
 public:
  enum class Depth { None, Shown };
  EyeSwapchains(const OpenXrInstance& calls, XrSession session, const Device& device, HeadsetFormat format,
                vk::Extent2D extent, Depth depth);

  // Returns false if the runtime provides no colour image. Without a depth image the frame is shown without depth.
  bool take(const std::function<void()>& while_waiting);
  // Copies the newest eyes into the acquired images.
  void record(const vk::raii::CommandBuffer& command, const EyeTargets& eyes) const;
  void give_back();

  XrSwapchainSubImage sub_image(scene::Eye eye, vk::Extent2D drawn) const { return color_.sub_image(eye, drawn); }

  // Depth of the last released frame, reversed infinite: 1 at scene::kNearM, 0 infinitely far away.
  std::optional<XrCompositionLayerDepthInfoKHR> depth(scene::Eye eye, vk::Extent2D drawn) const;

 private:
  struct Place {
    vk::Image image;
    std::uint32_t layer = 0;
  };
  // One chain with two layers, or two chains.
  struct Chains {
    std::vector<PictureChain> chains;
    Place place(scene::Eye eye) const;
    XrSwapchainSubImage sub_image(scene::Eye eye, vk::Extent2D drawn) const;
  };
  static Chains create(const OpenXrInstance& calls, XrSession session, vk::Format format, vk::Extent2D extent);
  void record_depth(const vk::raii::CommandBuffer& command, const EyeTargets& eyes) const;
  void record_reordered(const vk::raii::CommandBuffer& command, const EyeTargets& eyes) const;

  HeadsetFormat format_;
  Chains color_, depth_;    // chains of both images; `depth_` is empty if the runtime accepts no depth
  bool has_depth_ = false;  // true: depth valid for this frame
  DeviceImage reordered_;   // image in the runtime's byte order, if that differs
};

}  // namespace afm::render
