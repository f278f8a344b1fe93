// SPDX-License-Identifier: Apache-2.0
#include "imaging/drawn_surface.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "core/log.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/graph/height_field.h"

namespace afm::imaging {

std::string model_of(const std::string& assets_dir, const scene::MaterialEntry& material) {
  constexpr const char* kNeutralLook = "si3n4";
  for (const std::string& name : {material.name, material.look}) {
    std::error_code ignored;
    if (std::filesystem::exists(fmt::format("{}/models/sample-{}.glb", assets_dir, name), ignored)) return name;
  }
  core::log_line(fmt::format("material {}: {}/models/sample-{}.glb is missing; it is shown in plain grey",
                             material.name, assets_dir, material.look));
  return kNeutralLook;
}

core::Result<std::unique_ptr<scene::SharedHeightField>> drawn_surface(const std::string& assets_dir,
                                                                      const scene::MaterialEntry& material) {
  const std::string file = fmt::format("{}/models/sample-{}.glb", assets_dir, model_of(assets_dir, material));
  const auto loaded = scene::load_gltf(file);
  if (!loaded) return tl::unexpected(loaded.error());
  const auto surface = loaded->find_node("surface");
  const auto field = surface ? scene::height_field_below(*loaded, *surface) : std::nullopt;
  if (!field) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("{}: it has no node \"surface\" with heights", file));
  }
  return std::make_unique<scene::SharedHeightField>(*field);
}

}  // namespace afm::imaging
