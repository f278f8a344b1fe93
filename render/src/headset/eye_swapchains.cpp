// SPDX-License-Identifier: Apache-2.0
#include "headset/eye_swapchains.h"

#include <algorithm>
#include <array>
#include <limits>

#include "device/barriers.h"

namespace afm::render {
namespace {

// Runtimes interpret formats without sRGB as linear light.
constexpr std::array kHeadsetFormats{HeadsetFormat{vk::Format::eB8G8R8A8Srgb, "B8G8R8A8 sRGB", false},
                                     HeadsetFormat{vk::Format::eR8G8B8A8Srgb, "R8G8B8A8 sRGB", true}};

constexpr XrDuration kTurnOfWaitNs = 5'000'000;
constexpr int kMostTurnsOfWait = 50;

constexpr ImageUse kEyeShown{vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eNone,
                             vk::ImageLayout::eShaderReadOnlyOptimal};
constexpr ImageUse kReorderedFrom{vk::PipelineStageFlagBits2::eBlit, vk::AccessFlagBits2::eTransferRead,
                                  vk::ImageLayout::eTransferSrcOptimal};
constexpr ImageUse kReorderedTo{vk::PipelineStageFlagBits2::eBlit, vk::AccessFlagBits2::eTransferWrite,
                                vk::ImageLayout::eTransferDstOptimal};

}  // namespace

std::optional<HeadsetFormat> choose_headset_format(const std::vector<std::int64_t>& offered) {
  for (const HeadsetFormat& format : kHeadsetFormats) {
    if (std::find(offered.begin(), offered.end(), static_cast<std::int64_t>(format.format)) != offered.end()) {
      return format;
    }
  }
  return std::nullopt;
}

PictureChain::PictureChain(const OpenXrInstance& calls, XrSession session, vk::Format format, vk::Extent2D extent,
                           std::uint32_t layers)
    : calls_(calls) {
  const XrSwapchainCreateInfo info{
      .type = XR_TYPE_SWAPCHAIN_CREATE_INFO,
      .next = nullptr,
      .createFlags = 0,
      .usageFlags =
          XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT |
          static_cast<XrSwapchainUsageFlags>(format == kDepthFormat ? XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                                    : XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT),
      .format = static_cast<std::int64_t>(format),
      .sampleCount = 1,
      .width = extent.width,
      .height = extent.height,
      .faceCount = 1,
      .arraySize = layers,
      .mipCount = 1};
  check_openxr(calls.CreateSwapchain(session, &info, &chain_), "xrCreateSwapchain");
  const auto images = openxr_list<XrSwapchainImageVulkan2KHR>(
      "xrEnumerateSwapchainImages", {.type = XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR, .next = nullptr, .image = {}},
      [&](std::uint32_t capacity, std::uint32_t* count, XrSwapchainImageVulkan2KHR* list) {
        return calls.EnumerateSwapchainImages(chain_, capacity, count,
                                              reinterpret_cast<XrSwapchainImageBaseHeader*>(list));
      });
  for (const XrSwapchainImageVulkan2KHR& image : images) images_.emplace_back(image.image);
}

bool PictureChain::take(const std::function<void()>& while_waiting) {
  for (int turn = 0; !taken_ && turn < kMostTurnsOfWait; ++turn) {
    if (!wait_once(kTurnOfWaitNs)) while_waiting();
  }
  return taken_;
}

bool PictureChain::wait_once(XrDuration most_ns) {
  if (!acquired_) {
    const XrSwapchainImageAcquireInfo info{.type = XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO, .next = nullptr};
    check_openxr(calls_.AcquireSwapchainImage(chain_, &info, &index_), "xrAcquireSwapchainImage");
    // an index beyond the list is the runtime's error and must not become ours
    if (index_ >= images_.size()) throw OpenXrFailure(XR_ERROR_RUNTIME_FAILURE, "xrAcquireSwapchainImage");
    acquired_ = true;
  }
  const XrSwapchainImageWaitInfo wait{.type = XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, .next = nullptr, .timeout = most_ns};
  const XrResult waited = calls_.WaitSwapchainImage(chain_, &wait);
  check_openxr(waited, "xrWaitSwapchainImage");
  taken_ = waited != XR_TIMEOUT_EXPIRED;
  return taken_;
}

void PictureChain::give_back() {
  const XrSwapchainImageReleaseInfo info{.type = XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO, .next = nullptr};
  acquired_ = taken_ = false;
  check_openxr(calls_.ReleaseSwapchainImage(chain_, &info), "xrReleaseSwapchainImage");
}

EyeSwapchains::EyeSwapchains(const OpenXrInstance& calls, XrSession session, const Device& device, HeadsetFormat format,
                             vk::Extent2D extent, Depth depth)
    : format_(format), color_(create(calls, session, format.format, extent)) {
  if (depth == Depth::Shown) {
    try {
      depth_ = create(calls, session, kDepthFormat, extent);
    } catch (const OpenXrFailure& failure) {
      if (is_loss(failure)) throw;
    }
  }
  if (format.other_order) {
    reordered_ = create_image(device, "headset's byte order",
                              {.format = vk::Format::eR8G8B8A8Unorm,
                               .extent = extent,
                               .usage = vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eTransferSrc});
  }
}

EyeSwapchains::Chains EyeSwapchains::create(const OpenXrInstance& calls, XrSession session, vk::Format format,
                                            vk::Extent2D extent) {
  Chains made;
  try {
    made.chains.emplace_back(calls, session, format, extent, 2U);
  } catch (const OpenXrFailure& failure) {
    if (is_loss(failure)) throw;
    for (int eye = 0; eye < 2; ++eye) made.chains.emplace_back(calls, session, format, extent, 1U);
  }
  return made;
}

bool EyeSwapchains::take(const std::function<void()>& while_waiting) {
  const auto take_all = [](Chains& of, const auto& take) {
    return std::all_of(of.chains.begin(), of.chains.end(), take);
  };
  if (!take_all(color_, [&](PictureChain& chain) { return chain.take(while_waiting); })) return false;
  has_depth_ = !depth_.chains.empty() && take_all(depth_, [](PictureChain& chain) { return chain.take_if_lent(); });
  return true;
}

void EyeSwapchains::give_back() {
  for (PictureChain& chain : color_.chains) chain.give_back();
  if (!has_depth_) return;
  for (PictureChain& chain : depth_.chains) chain.give_back();
}

EyeSwapchains::Place EyeSwapchains::Chains::place(scene::Eye eye) const {
  const std::uint32_t index = eye == scene::Eye::Left ? 0 : 1;
  return chains.size() == 1 ? Place{.image = chains[0].image(), .layer = index}
                            : Place{.image = chains[index].image(), .layer = 0};
}

XrSwapchainSubImage EyeSwapchains::Chains::sub_image(scene::Eye eye, vk::Extent2D drawn) const {
  const std::size_t chain = chains.size() == 1 || eye == scene::Eye::Left ? 0 : 1;
  return {.swapchain = chains[chain].handle(),
          .imageRect = {.offset = {0, 0},
                        .extent = {static_cast<std::int32_t>(drawn.width), static_cast<std::int32_t>(drawn.height)}},
          .imageArrayIndex = place(eye).layer};
}

std::optional<XrCompositionLayerDepthInfoKHR> EyeSwapchains::depth(scene::Eye eye, vk::Extent2D drawn) const {
  if (!has_depth_) return std::nullopt;
  return XrCompositionLayerDepthInfoKHR{.type = XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR,
                                        .next = nullptr,
                                        .subImage = depth_.sub_image(eye, drawn),
                                        .minDepth = 0.0F,
                                        .maxDepth = 1.0F,
                                        .nearZ = std::numeric_limits<float>::infinity(),
                                        .farZ = static_cast<float>(scene::kNearM)};
}

void EyeSwapchains::record_depth(const vk::raii::CommandBuffer& command, const EyeTargets& eyes) const {
  for (const scene::Eye eye : scene::kEyes) {
    const Place to = depth_.place(eye);
    const LayerRange layer{to.layer, 1};
    record_barriers(command, {image_barrier(to.image, kDepthAspect, kRuntimesDepth.discarded(), kCopiedTo, layer)});
    eyes.copy_depth(command, eye, to.image, to.layer);
    record_barriers(command, {image_barrier(to.image, kDepthAspect, kCopiedTo, kRuntimesDepth, layer)});
  }
}

void EyeSwapchains::record(const vk::raii::CommandBuffer& command, const EyeTargets& eyes) const {
  for (const scene::Eye eye : scene::kEyes) {
    const Place to = color_.place(eye);
    record_barriers(command, {image_barrier(to.image, kColorAspect, kRuntimes.discarded(), kCopiedTo, {to.layer, 1})});
  }
  if (format_.other_order) {
    record_reordered(command, eyes);
  } else {
    eyes.begin_copies(command);
    for (const scene::Eye eye : scene::kEyes) {
      const Place to = color_.place(eye);
      eyes.copy(command, eye, PixelBox::whole(eyes.extent()), to.image, to.layer, {0, 0});
    }
    eyes.end_copies(command);
  }
  for (const scene::Eye eye : scene::kEyes) {
    const Place to = color_.place(eye);
    record_barriers(command, {image_barrier(to.image, kColorAspect, kCopiedTo, kRuntimes, {to.layer, 1})});
  }
  if (has_depth_) record_depth(command, eyes);
}

// Blits and then copies. A blit changes the byte order between formats without sRGB, and a copy keeps the bytes: the
// runtime's image ends up with our values.
void EyeSwapchains::record_reordered(const vk::raii::CommandBuffer& command, const EyeTargets& eyes) const {
  const vk::Extent2D extent = eyes.extent();
  const std::array<vk::Offset3D, 2> corners{
      {{0, 0, 0}, {static_cast<std::int32_t>(extent.width), static_cast<std::int32_t>(extent.height), 1}}};
  for (const scene::Eye eye : scene::kEyes) {
    const EyeTargets::EyeImage from = eyes.eye(eye);
    const Place to = color_.place(eye);
    const vk::ImageSubresourceLayers first{.aspectMask = kColorAspect, .baseArrayLayer = 0, .layerCount = 1};
    const vk::ImageSubresourceLayers source{.aspectMask = kColorAspect, .baseArrayLayer = from.layer, .layerCount = 1};
    const vk::ImageSubresourceLayers target{.aspectMask = kColorAspect, .baseArrayLayer = to.layer, .layerCount = 1};
    record_barriers(command, {image_barrier(from.image, kColorAspect, kEyeShown, kReorderedFrom, {from.layer, 1}),
                              image_barrier(*reordered_.image, kColorAspect, kCopiedFrom.discarded(), kReorderedTo)});
    command.blitImage(
        from.image, kReorderedFrom.layout, *reordered_.image, kReorderedTo.layout,
        vk::ImageBlit{.srcSubresource = source, .srcOffsets = corners, .dstSubresource = first, .dstOffsets = corners},
        vk::Filter::eNearest);
    record_barriers(command, {image_barrier(from.image, kColorAspect, kReorderedFrom, kEyeShown, {from.layer, 1}),
                              image_barrier(*reordered_.image, kColorAspect, kReorderedTo, kCopiedFrom)});
    command.copyImage(
        *reordered_.image, kCopiedFrom.layout, to.image, kCopiedTo.layout,
        vk::ImageCopy{.srcSubresource = first, .dstSubresource = target, .extent = {extent.width, extent.height, 1}});
  }
}

}  // namespace afm::render
