// SPDX-License-Identifier: Apache-2.0
#include "core/system_error.h"

#include <cstring>

namespace afm::core {

const char* system_error(int error) noexcept {
  const char* const text = ::strerrordesc_np(error);
  return text == nullptr ? "unknown error" : text;
}

}  // namespace afm::core
