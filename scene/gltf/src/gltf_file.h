// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gltf_check.h"

namespace afm::scene {

using Bytes = std::vector<std::uint8_t>;

// Files that a model may refer to: data URIs, and regular files in its folder or below, without links that lead
// outside.
class SideFiles {
 public:
  SideFiles() = default;
  SideFiles(std::filesystem::path folder, std::uint64_t bytes_left)
      : folder_(std::move(folder)), bytes_left_(bytes_left) {}

  // Throws GltfError.
  Bytes read(const std::string& uri);

 private:
  std::optional<std::filesystem::path> resolve(const std::string& uri) const;

  std::filesystem::path folder_;
  std::uint64_t bytes_left_ = 0;
};

// Text of a model as a tree of limited depth and size, and the binary chunk of a .glb, if it has one.
struct GltfFile {
  Json document;
  std::optional<Bytes> binary;
  SideFiles side_files;
};

// Throws GltfError.
GltfFile read_gltf_file(const std::string& path);

}  // namespace afm::scene
