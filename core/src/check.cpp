// SPDX-License-Identifier: Apache-2.0
#include "core/check.h"

#include <cstdio>
#include <cstdlib>

namespace afm::core {

void check_failed(const char* expression, const char* file, int line) {
  std::fprintf(stderr, "touchafm: internal error: the check %s failed (%s:%d)\n", expression, file, line);
  std::abort();
}

}  // namespace afm::core
