// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace afm::core {

// Path of the running program. Empty if the system does not say.
std::filesystem::path own_program();

// Folder of the file that holds this code: a program, or the Python module. Empty if the system does not say.
std::filesystem::path own_folder();

// The folder share/touchafm of a program: below the folder above bin (a build) or above libexec/touchafm (an
// installation, which may have been moved). It may be missing.
std::filesystem::path assets_of(const std::filesystem::path& program);

}  // namespace afm::core
