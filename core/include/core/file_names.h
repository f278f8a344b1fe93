// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace afm::core {

// A name that may contain slashes, such as that of a material, as a part of a file's name: "SiO2%2FSi".
std::string in_file_name(std::string_view name);

}  // namespace afm::core
