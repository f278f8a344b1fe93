// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tiny_gltf.h>

#include <string>

#include "core/result.h"

namespace afm::scene {

// The file and its side files together.
inline constexpr std::uint64_t kLargestGltfBytes = 256ULL << 20U;

// Reads `path` and its side files and lets tinygltf parse them, after checking by itself what tinygltf 2.7 gets wrong:
// nesting deep enough to overflow its stack, a binary chunk that reaches past the file, negative sizes (taken for 0),
// versions, and side files anywhere on the disk. The model's indices and sizes are NOT checked: see gltf_validation.h.
// The error's message is the reason alone, without the file's name.
core::Result<tinygltf::Model> read_gltf_file(const std::string& path);

}  // namespace afm::scene
