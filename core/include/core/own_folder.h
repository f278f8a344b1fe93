// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace afm::core {

// Folder of the file that holds this code: a program, or the Python module. Empty if the system does not say.
std::filesystem::path own_folder();

}  // namespace afm::core
