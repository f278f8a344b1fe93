// SPDX-License-Identifier: Apache-2.0
#include "app/commands/standard_output.h"
#include "core/system_error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>

namespace afm::app {

core::Result<void> write_stdout(std::string_view text) {
  errno = 0;
  std::fwrite(text.data(), 1, text.size(), stdout);
  return flush_stdout();
}

core::Result<void> flush_stdout() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot write to stdout: {}", core::system_error(errno)));
  }
  return {};
}

}  // namespace afm::app
