// SPDX-License-Identifier: Apache-2.0
#include "app/commands/standard_output.h"
#include "core/system_error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>

namespace afm::app {

core::Result<void> write_stdout(std::string_view text) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot write to stdout: {}", core::system_error(errno)));
  }
  return {};
}

}  // namespace afm::app
