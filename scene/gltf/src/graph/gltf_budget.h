// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "gltf_error.h"

namespace afm::scene {

// Memory budget for the meshes and animations of a model. Many of them may share an accessor, so a small file can
// require a lot of memory; every stream is charged before its allocation.
class GltfBudget {
 public:
  void take(std::uint64_t count, std::uint64_t bytes_each) {
    if (count > kMostBytes / bytes_each || count * bytes_each > kMostBytes - taken_) {
      throw GltfError("its meshes and animations take more than 384 MiB; make it smaller");
    }
    taken_ += count * bytes_each;
  }

 private:
  static constexpr std::uint64_t kMostBytes = 384ULL << 20U;
  std::uint64_t taken_ = 0;
};

}  // namespace afm::scene
