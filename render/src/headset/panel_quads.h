// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "headset/eye_swapchains.h"
#include "panels/panels.h"

namespace afm::render {

// Panels as separate layers that the runtime draws from their textures, at the headset's own resolution instead of that
// of the eyes' pictures. Each panel has a chain of images, filled again whenever the panel is repainted.
class PanelQuads {
 public:
  // `offered` lists the runtime's formats. `most_layers` is its limit per frame, the eyes included.
  PanelQuads(const OpenXrInstance& calls, XrSession session, const std::vector<std::int64_t>& offered,
             std::uint32_t most_layers);

  // Number of panels that can be shown. 0 if the runtime has too few layers, has no format with the bytes of the
  // textures, or has refused their images.
  std::size_t most() const { return refused_ ? 0 : most_; }

  // Begins a frame: acquires an image for each repainted panel, copies the textures and releases the images. If the
  // runtime has no image ready, the panel keeps its old picture, which is better than a late frame.
  void take(std::vector<ApartPanel> panels);
  void record(const vk::raii::CommandBuffer& command) const;
  void give_back();

  // Layers of that frame's panels, in drawing order.
  const std::vector<XrCompositionLayerQuad>& layers(XrSpace floor, const scene::HeadPose& room_from_floor);

 private:
  struct Shown {
    std::optional<PictureChain> chain;
    vk::Extent2D extent;
    std::uint64_t painting = 0;  // number of the painting shown by the runtime; 0: none
  };
  void prepare(const ApartPanel& panel, Shown& shown);
  void retire(Shown& shown);

  const OpenXrInstance& calls_;
  XrSession session_;
  std::size_t most_ = 0;
  bool refused_ = false;
  std::uint64_t frame_ = 0;
  std::vector<ApartPanel> panels_;                              // panels of the current frame
  std::vector<Shown> shown_;                                    // indexed by ApartPanel::place
  std::vector<std::pair<XrSwapchain, std::uint64_t>> retired_;  // chains, each with the frame after which it is unused
  std::vector<XrCompositionLayerQuad> layers_;
};

}  // namespace afm::render
