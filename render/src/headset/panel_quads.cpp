// SPDX-License-Identifier: Apache-2.0
#include "headset/panel_quads.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "device/barriers.h"
#include "headset/openxr_pose.h"

namespace afm::render {
namespace {

constexpr auto kQuadFormat = static_cast<std::int64_t>(vk::Format::eR8G8B8A8Srgb);  // same bytes as kPanelFormat
constexpr std::uint64_t kFramesInCopy = 3;  // frames after which the device has finished copying a frame

}  // namespace

PanelQuads::PanelQuads(const OpenXrInstance& calls, XrSession session, const std::vector<std::int64_t>& offered,
                       std::uint32_t most_layers)
    : calls_(calls), session_(session) {
  const bool fits = std::find(offered.begin(), offered.end(), kQuadFormat) != offered.end();
  if (fits && most_layers > 1) most_ = most_layers - 1;
}

void PanelQuads::retire(Shown& shown) {
  if (shown.chain) retired_.emplace_back(shown.chain->handle(), frame_);
  shown.chain.reset();
  shown.painting = 0;
}

void PanelQuads::prepare(const ApartPanel& panel, Shown& shown) {
  if (shown.extent != panel.extent) retire(shown);
  if (shown.chain) return;
  shown.chain.emplace(calls_, session_, static_cast<vk::Format>(kQuadFormat), panel.extent, 1U);
  shown.extent = panel.extent;
}

void PanelQuads::take(std::vector<ApartPanel> panels) {
  ++frame_;
  std::erase_if(retired_, [&](const auto& each) {
    if (frame_ - each.second < kFramesInCopy) return false;
    calls_.DestroySwapchain(each.first);
    return true;
  });
  panels_ = std::move(panels);
  for (const ApartPanel& panel : panels_) shown_.resize(std::max(shown_.size(), panel.place + 1));
  try {
    for (const ApartPanel& panel : panels_) {
      Shown& shown = shown_[panel.place];
      prepare(panel, shown);
      if (shown.painting != panel.painting) shown.chain->take_if_lent();
    }
  } catch (const OpenXrFailure& failure) {
    if (is_loss(failure)) throw;
    refused_ = true;  // panels are drawn in the eyes' pictures from the next frame on
  }
}

void PanelQuads::record(const vk::raii::CommandBuffer& command) const {
  for (const ApartPanel& panel : panels_) {
    const Shown& shown = shown_[panel.place];
    if (!shown.chain || !shown.chain->taken()) continue;
    const vk::Image to = shown.chain->image();
    constexpr vk::ImageSubresourceLayers kWhole{.aspectMask = kColorAspect, .layerCount = 1};
    record_barriers(command, {image_barrier(panel.texture, kColorAspect, kPanelSampled, kCopiedFrom),
                              image_barrier(to, kColorAspect, kRuntimes.discarded(), kCopiedTo)});
    command.copyImage(panel.texture, kCopiedFrom.layout, to, kCopiedTo.layout,
                      vk::ImageCopy{.srcSubresource = kWhole,
                                    .dstSubresource = kWhole,
                                    .extent = {panel.extent.width, panel.extent.height, 1}});
    record_barriers(command, {image_barrier(panel.texture, kColorAspect, kCopiedFrom, kPanelSampled),
                              image_barrier(to, kColorAspect, kCopiedTo, kRuntimes)});
  }
}

void PanelQuads::give_back() {
  for (const ApartPanel& panel : panels_) {
    Shown& shown = shown_[panel.place];
    if (!shown.chain || !shown.chain->taken()) continue;
    shown.chain->give_back();
    shown.painting = panel.painting;
  }
}

const std::vector<XrCompositionLayerQuad>& PanelQuads::layers(XrSpace floor, const scene::HeadPose& room_from_floor) {
  layers_.clear();
  for (const ApartPanel& panel : panels_) {
    const Shown& shown = shown_[panel.place];
    if (shown.painting == 0) continue;  // no image received from the runtime yet
    const PanelPlacement& place = panel.placement;
    const glm::dvec3 right = glm::normalize(place.right_m), up = glm::normalize(place.up_m);
    const scene::HeadPose middle{.position_m = place.lower_left_m + 0.5 * (place.right_m + place.up_m),
                                 .room_from_head = glm::quat_cast(glm::dmat3(right, up, glm::cross(right, up)))};
    layers_.push_back(
        {.type = XR_TYPE_COMPOSITION_LAYER_QUAD,
         .next = nullptr,
         .layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT,  // premultiplied
         .space = floor,
         .eyeVisibility = XR_EYE_VISIBILITY_BOTH,
         .subImage = {.swapchain = shown.chain->handle(),
                      .imageRect = {.offset = {0, 0},
                                    .extent = {static_cast<std::int32_t>(shown.extent.width),
                                               static_cast<std::int32_t>(shown.extent.height)}},
                      .imageArrayIndex = 0},
         .pose = from_room(room_from_floor, middle),
         .size = {static_cast<float>(glm::length(place.right_m)), static_cast<float>(glm::length(place.up_m))}});
  }
  return layers_;
}

}  // namespace afm::render
