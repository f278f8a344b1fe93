// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gltf_buffers.h"
#include "scene/gltf/gltf_loader.h"

namespace afm::scene {

// The textures that the scene's materials use, whose indices are still the file's, with their samplers and images; what
// is not used is not read. Images are decoded on all cores. Where a texture's image is only there in a format that is
// not read (an extension's that is not required), its uses are dropped. Throws GltfError.
void read_textures(GltfModel& model, const GltfBuffers& buffers, Scene& scene, GltfWarnings& notes);

}  // namespace afm::scene
