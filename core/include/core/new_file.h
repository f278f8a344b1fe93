// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"

namespace afm::core {

// Writes like write_file() (core/whole_file.h), but replaces no regular file, including one that another program has
// created meanwhile: WrongUsage.
Result<void> write_new_file(const std::string& path, std::string_view bytes);

}  // namespace afm::core
