// SPDX-License-Identifier: Apache-2.0
#include "app/options/standard_output.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <utility>

#include "core/printable.h"
#include "core/system_error.h"
#include "core/written_by.h"

namespace afm::app {

namespace {

core::Result<void> cannot_write() {
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("cannot write to stdout: {}", core::system_error(errno)));
}

}  // namespace

core::Result<void> write_stdout(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) return cannot_write();
  return flush_stdout();
}

core::Result<void> write_report(std::string text) {
  return write_stdout(core::printable(core::with_software_line(std::move(text))));
}

core::Result<void> flush_stdout() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) return cannot_write();
  return {};
}

}  // namespace afm::app
