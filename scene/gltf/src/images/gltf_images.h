// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gltf_buffers.h"
#include "scene/gltf/gltf_loader.h"

namespace afm::scene {

// Reads the textures used by the scene's materials, whose indices are still those of the file, with their samplers and
// images; skips unused ones. Decodes images on all cores. Drops the uses of a texture whose image is missing, or
// exists only in an unsupported format (of an optional extension), with a note. Throws GltfError.
void read_textures(GltfModel& model, const GltfBuffers& buffers, Scene& scene, GltfWarnings& notes);

}  // namespace afm::scene
