// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "device/memory.h"
#include "scene/graph/scene.h"

namespace afm::render {

// Images of a scene with their mipmaps, in each colour space in which a material reads them, and a sampler per texture.
class SceneTextures {
 public:
  SceneTextures(const Device& device, const scene::Scene& scene);

  vk::DescriptorImageInfo descriptor(std::uint32_t texture, bool srgb) const;

  // One white pixel, for a slot without a texture.
  vk::DescriptorImageInfo white() const;

 private:
  struct Uploaded {
    DeviceImage image;
    vk::raii::ImageView view{nullptr};
  };
  static Uploaded upload(const Device& device, const scene::Image& image, bool srgb);

  std::vector<std::uint32_t> image_of_;  // indexed by texture
  std::vector<vk::raii::Sampler> samplers_;
  std::map<std::pair<std::uint32_t, bool>, Uploaded> images_;
  Uploaded white_;
  vk::raii::Sampler white_sampler_;
};

}  // namespace afm::render
