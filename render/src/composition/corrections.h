// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <vector>

#include "device/memory.h"
#include "drawing/pixel_tiles.h"
#include "render/composition.h"

namespace afm::render {

// Correction of one output's picture for its projector, as read by the compose pass: the warp mesh as a map of the
// pixels covered by one eye's image, and the blending.
class Correction {
 public:
  Correction(const Device& device, vk::DescriptorSetLayout layout, vk::Sampler sampler, const Composition& composition,
             vk::Extent2D eye_px);

  // True for this mesh and blending, at any size; serves() also compares the size.
  bool corrects_as(const Composition& composition) const {
    return warp_ == composition.warp && blend_ == composition.blend;
  }
  bool serves(const Composition& composition, vk::Extent2D eye_px) const {
    return corrects_as(composition) && (!warp_ || eye_px_ == eye_px);
  }

  vk::DescriptorSet set() const { return *set_; }

  // Adds every tile of the map with a pixel that shows a part of `box`. `box` lies in an eye's image of that size;
  // `at` is the map's first pixel.
  void add_moved(const PixelBox& box, vk::Extent2D eye, const glm::ivec2& at, PixelTiles& tiles) const;

 private:
  // Square of the map, and the part of the picture that its pixels show.
  struct Tile {
    PixelBox pixels;
    glm::vec2 low{0.0F}, high{0.0F};
  };
  void find_tiles(const std::vector<glm::vec4>& map);

  std::shared_ptr<const scene::WarpMesh> warp_;
  std::shared_ptr<const scene::Blend> blend_;
  vk::Extent2D eye_px_;
  std::vector<Tile> tiles_;  // tiles that show anything
  DeviceImage map_;
  vk::raii::ImageView view_{nullptr};
  Buffer block_;
  vk::raii::DescriptorPool pool_{nullptr};
  vk::raii::DescriptorSet set_{nullptr};
};

// Corrections in use, initially only that of an output without any. A new one is made when a mesh or blending is first
// shown at a size, which waits for the device.
class Corrections {
 public:
  explicit Corrections(const Device& device);

  vk::DescriptorSetLayout layout() const { return *layout_; }

  // Correction for eye images that cover `eye_px` pixels of the picture. The newest sizes of each mesh and blending are
  // kept, more than one submission uses.
  const Correction& find(const Composition& composition, vk::Extent2D eye_px);

 private:
  void forget_oldest(const Composition& composition);

  const Device& device_;
  vk::raii::DescriptorSetLayout layout_;
  vk::raii::Sampler sampler_;
  std::list<Correction> newest_first_;
};

}  // namespace afm::render
