// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gltf_model.h"

namespace afm::scene {

// Part of a buffer, within its bounds, after decompression.
struct BufferView {
  std::span<const std::uint8_t> bytes;
  std::size_t stride = 0;  // distance between elements in bytes; 0: packed
};

// Checked views of a model's buffers. `model` must outlive it.
class GltfBuffers {
 public:
  // Throws GltfError.
  explicit GltfBuffers(const tinygltf::Model& model);

  const std::vector<BufferView>& views() const { return views_; }

 private:
  BufferView decompress(const tinygltf::Model& model, std::size_t view, const tinygltf::Value& compression);

  std::vector<std::vector<std::uint8_t>> decompressed_;
  std::vector<BufferView> views_;
  std::uint64_t decompressed_bytes_ = 0;
};

}  // namespace afm::scene
