// SPDX-License-Identifier: Apache-2.0
#include "core/write_all.h"

#include <unistd.h>

#include <cerrno>
#include <cstddef>

namespace afm::core {

int write_all(int descriptor, std::string_view bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace afm::core
