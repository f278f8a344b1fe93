// SPDX-License-Identifier: Apache-2.0
#include "core/log.h"

#include <unistd.h>

#include <string>

#include "core/printable.h"

namespace afm::core {

void log_line(std::string_view text) {
  std::string line = "touchafm: ";
  line += printable_line(text);
  line += '\n';
  // a closed stderr cannot be reported
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace afm::core
