// SPDX-License-Identifier: Apache-2.0
#include "models/noted_model.h"

#include <fmt/format.h>

#include "core/log.h"
#include "exhibit/models/loading_notice.h"
#include "scene/gltf/gltf_loader.h"

namespace afm::exhibit {

core::Result<scene::Scene> load_noted_model(const std::string& file) {
  scene::GltfWarnings notes;
  auto loaded = [&] {
    const LoadingNotice notice(file);
    return scene::load_gltf(file, &notes);
  }();
  if (!loaded) return loaded;
  for (const std::string& missing : notes.missing) {
    core::log_line(fmt::format("'{}' is drawn without an image: {}", file, missing));
  }
  if (!notes.empty.empty()) core::log_line(fmt::format("nothing of '{}' is shown: {}", file, notes.empty));
  return loaded;
}

}  // namespace afm::exhibit
