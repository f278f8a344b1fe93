// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <string>

namespace afm::scene {

// Why the model must not be used, or nothing: one pass over every extension, index, size and number that load_gltf()
// will follow, in 64-bit arithmetic, before anything is built. tinygltf itself checks next to none of them.
std::optional<std::string> complaint_about(const tinygltf::Model& model);

}  // namespace afm::scene
