// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "scene/scene.h"

namespace afm::scene {

// Reads a glTF 2.0 model, .glb or .gltf (told apart by content), and checks all of it before anything is built from it:
// no file, however broken or hostile, crashes the program or is believed unchecked. Any thread.
//
// Read: the nodes of the default scene (TRS or matrix), triangle lists with 8, 16 or 32-bit indices or none, POSITION,
// NORMAL (flat normals are made where it is absent), COLOR_0, the factors of metallic-roughness materials, emission,
// double sides, alphaMode BLEND, KHR_materials_unlit and KHR_materials_emissive_strength. Ignored: textures, cameras,
// animations, skins and morph targets (the rest shape is shown), alphaMode MASK (opaque). Refused: what
// extensionsRequired names beyond the two above, sparse accessors, points, lines, strips and fans; files and side files
// that together exceed 256 MiB; side files that are not plain files inside the model's own folder.
//
// A node with negative determinant keeps its triangles as they are; whoever draws it turns the winding.
// Errors are BadInputFile: one line that names the file, what is wrong with it, and what to do.
core::Result<Scene> load_gltf(const std::string& path);

}  // namespace afm::scene
