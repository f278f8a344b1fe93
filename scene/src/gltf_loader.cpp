// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_loader.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <new>
#include <string_view>

#include "gltf_animations.h"
#include "gltf_fault.h"
#include "gltf_file.h"
#include "gltf_images.h"
#include "gltf_materials.h"
#include "gltf_meshes.h"
#include "gltf_nodes.h"

namespace afm::scene {
namespace {

constexpr std::array<std::string_view, 13> kUnderstood{
    "EXT_mesh_gpu_instancing", "EXT_meshopt_compression",   "KHR_draco_mesh_compression",
    "KHR_lights_punctual",     "KHR_materials_clearcoat",   "KHR_materials_emissive_strength",
    "KHR_materials_ior",       "KHR_materials_iridescence", "KHR_materials_specular",
    "KHR_materials_unlit",     "KHR_materials_variants",    "KHR_mesh_quantization",
    "KHR_texture_transform"};

bool is_understood(const std::string& name) {
  return std::find(kUnderstood.begin(), kUnderstood.end(), name) != kUnderstood.end();
}

void check_asset(const JsonElement& root, GltfNotes& notes) {
  const JsonElement asset = root.required_object("asset");
  const std::string version = asset.required_text("version"), least = asset.text("minVersion", "2.0");
  if (version.rfind("2.", 0) != 0 || least != "2.0") {
    throw GltfFault(fmt::format("it is glTF of version '{}'; export it as glTF 2.0", version.substr(0, 20)));
  }
  notes.generator = asset.text("generator", "");
}

void check_extensions(const JsonElement& root, GltfNotes& notes) {
  std::string refused;
  for (const JsonElement& element : root.values("extensionsRequired")) {
    const std::string name = element.as_text();
    if (!is_understood(name)) refused += fmt::format("{}'{}'", refused.empty() ? "" : ", ", name.substr(0, 80));
  }
  if (!refused.empty()) {
    throw GltfFault(fmt::format(
        "it requires {}, which TouchAFM does not know; export it without (docs/gltf.md lists what is known)", refused));
  }
  for (const JsonElement& element : root.values("extensionsUsed")) {
    const std::string name = element.as_text();
    if (is_understood(name)) {
      notes.extensions.push_back(name);
    } else {
      notes.ignore(fmt::format("{}: not known, and not required to show the model", name));
    }
  }
}

Scene read_scene(const std::string& path, GltfNotes& notes) {
  GltfFile file = read_gltf_file(path);
  const JsonElement root(file.document);
  check_asset(root, notes);
  check_extensions(root, notes);
  const GltfBuffers buffers(file, root);
  const GltfAccessors accessors(buffers, root);
  GltfBudget budget;
  Scene scene;
  read_materials(root, scene, notes);
  read_textures(file, buffers, root, scene, notes);
  read_meshes(root, buffers, accessors, budget, scene, notes);
  const NodePlaces places = read_nodes(root, accessors, budget, scene, notes);
  read_animations(root, accessors, places, budget, scene, notes);
  return scene;
}

// A message may quote the file, which must not break the line or reach a terminal as a control sequence.
std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; }, '?');
  return text;
}

}  // namespace

void GltfNotes::ignore(const std::string& what) {
  constexpr std::size_t kMostNotes = 100;
  const std::string line = printable(what);
  if (ignored.size() < kMostNotes && std::find(ignored.begin(), ignored.end(), line) == ignored.end())
    ignored.push_back(line);
}

core::Result<Scene> load_gltf(const std::string& path, GltfNotes* notes) {
  const auto refuse = [&](std::string reason) {
    if (reason.find("; ") == std::string::npos) reason += "; export it again and check it with gltf-validator";
    return core::failure(core::ErrorCategory::BadInputFile,
                         printable(fmt::format("cannot load the model '{}': {}", path, reason)));
  };
  GltfNotes own_notes;
  try {
    return read_scene(path, notes == nullptr ? own_notes : *notes);
  } catch (const GltfFault& fault) {
    return refuse(fault.what());
  } catch (const std::bad_alloc&) {
    return refuse("it needs more memory than there is; make it smaller");
  }
}

}  // namespace afm::scene
