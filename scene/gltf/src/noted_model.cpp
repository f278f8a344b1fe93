// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/noted_model.h"

#include <fmt/format.h>

#include "core/log.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/gltf/loading_notice.h"

namespace afm::scene {

core::Result<Scene> load_noted_model(const std::string& file) {
  GltfWarnings notes;
  auto loaded = [&] {
    const LoadingNotice notice(file);
    return load_gltf(file, &notes);
  }();
  if (!loaded) return loaded;
  for (const std::string& missing : notes.missing) {
    core::log_line(fmt::format("'{}' is drawn without an image: {}", file, missing));
  }
  if (!notes.empty.empty()) core::log_line(fmt::format("nothing of '{}' is shown: {}", file, notes.empty));
  return loaded;
}

}  // namespace afm::scene
