// SPDX-License-Identifier: Apache-2.0
#include "core/version.h"

namespace afm::core {

const char* const kVersion = AFM_VERSION;

}  // namespace afm::core
