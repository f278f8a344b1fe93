// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "scene/graph/scene.h"

namespace afm::scene {

// Warnings about a loaded model, as text: one line each.
struct GltfWarnings {
  std::string generator;                // the program that has written the file, as it says
  std::vector<std::string> extensions;  // those that the file uses and the loader understands
  std::vector<std::string> ignored;     // what is not shown, and why

  // Says a thing once.
  void ignore(const std::string& what);
};

// Reads a glTF 2.0 model, .glb or .gltf (distinguished by content), and checks all of it before anything is built from
// it: no file, however broken or hostile, crashes the program or is believed unchecked. Any thread; images are decoded
// on all cores.
//
// docs/gltf.md lists what is read, what is ignored and what is refused. A model and its side files may have 256 MiB
// together, its side files must be plain files in its own folder or below, its meshes and animations may take 384 MiB
// and its images 128 megapixels. Of several scenes the default one is read.
//
// A node with negative determinant keeps its triangles as they are; the renderer reverses the winding. Errors are
// BadInputFile: one line that names the file, what is wrong with it, and what to do.
core::Result<Scene> load_gltf(const std::string& path, GltfWarnings* notes = nullptr);

}  // namespace afm::scene
