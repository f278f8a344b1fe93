// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/result.h"

namespace afm::servo {

// Where this user's processes meet: touchafm in $XDG_RUNTIME_DIR, or without one /tmp/touchafm-UID. Made with mode 700.
// Failed: it cannot be made, or is not a folder of this user that nobody else can enter.
core::Result<std::filesystem::path> private_folder();

}  // namespace afm::servo
