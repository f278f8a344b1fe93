// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::core {

// Lets the allocator keep up to 4 MiB of freed memory for each thread. Otherwise it returns the arrays of a long curve
// to the system after each one, and the kernel clears the same pages again for the next: a fifth of the time of a fit.
// For commands that compute the same thing for many curves; concerns the whole process and its children. Call it before
// other threads allocate.
void keep_freed_memory();

}  // namespace afm::core
