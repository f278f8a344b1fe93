// SPDX-License-Identifier: Apache-2.0
#include "core/freed_memory.h"

#include <malloc.h>

namespace afm::core {

void keep_freed_memory() {
  constexpr int kKept = 4 << 20;
  ::mallopt(M_TRIM_THRESHOLD, kKept);  // NOLINT(concurrency-mt-unsafe): before other threads allocate
  // setting the other one ends its adaptation to larger blocks
  ::mallopt(M_MMAP_THRESHOLD, kKept);  // NOLINT(concurrency-mt-unsafe): before other threads allocate
}

}  // namespace afm::core
