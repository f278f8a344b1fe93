// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"

namespace afm::core {

// As write_file() (core/whole_file.h), but no regular file is replaced, also none that another program has made
// meanwhile: WrongUsage.
Result<void> write_new_file(const std::string& path, std::string_view bytes);

}  // namespace afm::core
