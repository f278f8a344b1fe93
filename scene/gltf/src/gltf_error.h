// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace afm::scene {

// Fault in a model, as the end of a sentence that begins with the model's name. Used only inside the loader:
// load_gltf() turns it into an Error.
struct GltfError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A side file that is missing or must not be read. If it is an image, the model is drawn without it.
struct GltfMissingFile : GltfError {
  using GltfError::GltfError;
};

}  // namespace afm::scene
