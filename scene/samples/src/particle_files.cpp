// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/particle_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

namespace afm::scene {

namespace {

std::string folder_of(const std::string& assets_dir) { return assets_dir + "/particles"; }

}  // namespace

bool is_particle_path(std::string_view name_or_path) {
  return name_or_path.find_first_of("/.") != std::string_view::npos;
}

std::vector<std::string> particle_sets(const std::string& assets_dir) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder_of(assets_dir), ignored)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

core::Result<std::string> particle_file(const std::string& name_or_path, const std::string& assets_dir) {
  std::error_code ignored;
  const std::filesystem::path path(name_or_path);
  const std::vector<std::string> known = particle_sets(assets_dir);
  if (is_particle_path(name_or_path)) {
    const bool is_included = std::find(known.begin(), known.end(), path.stem()) != known.end();
    if (!is_included || path.has_parent_path() || std::filesystem::exists(path, ignored)) return name_or_path;
    return core::wrong_usage(
        fmt::format("there is no file {}; the included set is called {}", name_or_path, path.stem().string()));
  }
  if (std::find(known.begin(), known.end(), name_or_path) != known.end()) {
    return fmt::format("{}/{}.toml", folder_of(assets_dir), name_or_path);
  }
  if (std::filesystem::exists(path, ignored)) return name_or_path;
  if (known.empty()) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot look for the particles \"{}\": there are no sets in {}; install TouchAFM "
                                     "again, or give the path of a file",
                                     name_or_path, folder_of(assets_dir)));
  }
  return core::wrong_usage(fmt::format("unknown set of particles \"{}\"; choose {}, or give the path of a file",
                                       name_or_path, fmt::join(known, ", ")));
}

}  // namespace afm::scene
