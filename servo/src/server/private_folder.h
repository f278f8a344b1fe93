// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/result.h"

namespace afm::servo {

// Private folder of this user's processes: touchafm in $XDG_RUNTIME_DIR or, without one, /tmp/touchafm-UID. Created
// with mode 700. Failed: it cannot be created, or is not a private folder of this user.
core::Result<std::filesystem::path> private_folder();

}  // namespace afm::servo
