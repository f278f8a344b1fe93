// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "scene/graph/scene.h"

namespace afm::scene {

// Warnings about a loaded model, one line each. At most 100 of a kind are kept.
struct GltfWarnings {
  std::string generator;                // program that wrote the file, as stated in it
  std::vector<std::string> extensions;  // extensions used by the file and supported by the loader
  std::vector<std::string> ignored;     // parts that are not shown, with the reason
  std::vector<std::string> corrected;   // values that violate glTF, with their replacements
  std::vector<std::string> missing;     // images that were not found; the model is drawn without them
  std::string empty;                    // reason why nothing is shown; empty if something is

  // Each adds a warning unless it is already listed.
  void ignore(const std::string& what);
  void correct(const std::string& what);
  void miss(const std::string& what);
};

// Reads a glTF 2.0 model, .glb or .gltf (distinguished by content), and checks all of it before building anything from
// it: no file, however broken or hostile, crashes the program or is trusted unchecked. Any thread; images are decoded
// on all cores.
//
// docs/gltf.md lists what is read, ignored and refused. A model and its side files may have 256 MiB together, its side
// files must be plain files in its own folder or below, its meshes and animations may take 384 MiB, and its images 128
// megapixels. Of several scenes the default one is read.
//
// A node with negative determinant keeps its triangles; the renderer reverses the winding. Errors are BadInputFile: one
// line that names the file, the fault, and the remedy.
core::Result<Scene> load_gltf(const std::string& path, GltfWarnings* notes = nullptr);

}  // namespace afm::scene
