// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gltf_file.h"
#include "gltf_json.h"

namespace afm::scene {

// A part of a buffer, within its bounds; decompressed if it was compressed.
struct BufferView {
  std::span<const std::uint8_t> bytes;
  std::size_t stride = 0;  // 0: packed
};

// Buffers and their views, checked and read. `file` must outlive it.
class GltfBuffers {
 public:
  // Throws GltfFault.
  GltfBuffers(GltfFile& file, const JsonElement& root);

  const std::vector<BufferView>& views() const { return views_; }

 private:
  void read_buffers(GltfFile& file, const JsonElement& root);
  BufferView read_view(const JsonElement& element);
  BufferView decompress(const JsonElement& view, const JsonElement& compression);
  std::span<const std::uint8_t> range(const JsonElement& element) const;

  // a buffer without bytes is a placeholder for what is stored compressed
  std::vector<std::vector<std::uint8_t>> owned_;
  std::vector<std::optional<std::span<const std::uint8_t>>> buffers_;
  std::vector<BufferView> views_;
  std::uint64_t decompressed_bytes_ = 0;
};

}  // namespace afm::scene
