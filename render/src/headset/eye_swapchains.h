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

// What the runtime does with an image between two of our frames is its own; it gets and gives it as an attachment.
inline constexpr ImageUse kRuntimes{vk::PipelineStageFlagBits2::eAllCommands,
                                    vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite,
                                    vk::ImageLayout::eColorAttachmentOptimal};
inline constexpr ImageUse kRuntimesDepth{kRuntimes.stages, kRuntimes.access,
                                         vk::ImageLayout::eDepthStencilAttachmentOptimal};

// Images of the runtime of which one at a time is filled.
class PictureChain {
 public:
  // Throws OpenXrFailure.
  PictureChain(const OpenXrInstance& calls, XrSession session, vk::Format format, vk::Extent2D extent,
               std::uint32_t layers);

  // Takes the image that is filled next, unless one is already taken. False: the runtime has lent none for 250 ms, as
  // long as a hand may be held without a picture.
  bool take(const std::function<void()>& while_waiting);
  // The same without waiting.
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

// The pictures of both eyes for the runtime: one chain of images with two layers, or, where it refuses that, one for
// each eye. The eyes are drawn and resolved as for a wall, then copied; likewise their depth, where the runtime takes
// it.
class EyeSwapchains {
 public:
  enum class Depth { None, Shown };
  EyeSwapchains(const OpenXrInstance& calls, XrSession session, const Device& device, HeadsetFormat format,
                vk::Extent2D extent, Depth depth);

  // False if the runtime lends no image for the colours; where it lends none for the depth, the frame goes without.
  bool take(const std::function<void()>& while_waiting);
  // Copies the newest eyes into the taken images.
  void record(const vk::raii::CommandBuffer& command, const EyeTargets& eyes) const;
  void give_back();

  XrSwapchainSubImage sub_image(scene::Eye eye, vk::Extent2D drawn) const { return color_.sub_image(eye, drawn); }

  // Of the frame that was given back last; reversed infinite: 1 at scene::kNearM, 0 infinitely far away.
  std::optional<XrCompositionLayerDepthInfoKHR> depth(scene::Eye eye, vk::Extent2D drawn) const;

 private:
  struct Place {
    vk::Image image;
    std::uint32_t layer = 0;
  };
  // Of two layers, or two.
  struct Chains {
    std::vector<PictureChain> chains;
    Place place(scene::Eye eye) const;
    XrSwapchainSubImage sub_image(scene::Eye eye, vk::Extent2D drawn) const;
  };
  static Chains create(const OpenXrInstance& calls, XrSession session, vk::Format format, vk::Extent2D extent);
  void record_depth(const vk::raii::CommandBuffer& command, const EyeTargets& eyes) const;
  void record_reordered(const vk::raii::CommandBuffer& command, const EyeTargets& eyes) const;

  HeadsetFormat format_;
  Chains color_, depth_;    // the latter empty where none is shown
  bool has_depth_ = false;  // this frame
  DeviceImage reordered_;   // with the runtime's order of the bytes, where that differs
};

}  // namespace afm::render
