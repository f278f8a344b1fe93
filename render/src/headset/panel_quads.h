// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "headset/eye_swapchains.h"
#include "panels/panels.h"

namespace afm::render {

// Panels as layers of their own, which the runtime draws from their textures: as sharp as the headset is, not as the
// eyes' pictures are. Each has a chain of images, filled again when the panel was painted again.
class PanelQuads {
 public:
  // `offered`: the runtime's formats. `most_layers`: that it takes in a frame, with the eyes.
  PanelQuads(const OpenXrInstance& calls, XrSession session, const std::vector<std::int64_t>& offered,
             std::uint32_t most_layers);

  // How many panels can be shown; 0: none, as the runtime has too few layers, no format with the bytes of the textures,
  // or has refused their images.
  std::size_t most() const { return refused_ ? 0 : most_; }

  // A frame: takes an image for each panel that was painted again; copies the textures; gives the images back. A panel
  // for which the runtime lends none at once keeps its old picture, which is better than a late frame.
  void take(std::vector<ApartPanel> panels);
  void record(const vk::raii::CommandBuffer& command) const;
  void give_back();

  // The panels of that frame, in the order in which they cover each other.
  const std::vector<XrCompositionLayerQuad>& layers(XrSpace floor, const scene::HeadPose& room_from_floor);

 private:
  struct Shown {
    std::optional<PictureChain> chain;
    vk::Extent2D extent;
    std::uint64_t painting = 0;  // that the runtime has; 0: none
  };
  void prepare(const ApartPanel& panel, Shown& shown);
  void retire(Shown& shown);

  const OpenXrInstance& calls_;
  XrSession session_;
  std::size_t most_ = 0;
  bool refused_ = false;
  std::uint64_t frame_ = 0;
  std::vector<ApartPanel> panels_;                              // of this frame
  std::vector<Shown> shown_;                                    // by ApartPanel::place
  std::vector<std::pair<XrSwapchain, std::uint64_t>> retired_;  // with the frame since which they are not used
  std::vector<XrCompositionLayerQuad> layers_;
};

}  // namespace afm::render
