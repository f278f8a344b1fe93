// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace afm::core {

// A name that may contain slashes, such as that of a material, as a part of a file's name: "SiO2%2FSi".
std::string in_file_name(std::string_view name);

// True if a name has this ending, such as ".svg", in small or capital letters.
bool has_ending(std::string_view name, std::string_view ending);

// True if the ending of a name is that of a picture, sound, film, document, table or archive other than `own`, as which
// other programs would open the file.
bool is_named_as_another(std::string_view name, std::string_view own);

}  // namespace afm::core
