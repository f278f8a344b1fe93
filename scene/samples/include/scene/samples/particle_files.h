// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace afm::scene {

// True for a path, false for what may be the name of a set.
bool is_particle_path(std::string_view name_or_path);

// Names of the sets in the folder particles of the assets, sorted.
std::vector<std::string> particle_sets(const std::string& assets_dir);

// The file of a set of particles: a path, or the name of a file in the folder particles of the assets, without its
// ending. WrongUsage, with all names, for a name that is neither; Failed for a name if the assets have no sets.
core::Result<std::string> particle_file(const std::string& name_or_path, const std::string& assets_dir);

}  // namespace afm::scene
