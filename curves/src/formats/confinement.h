// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::curves {

// For the rest of the process's life: at most half a GiB of memory and three seconds of processor time more than now;
// no file, socket or process opened, by Landlock and by a seccomp filter, where the kernel has them. What is open stays
// open. Throws std::runtime_error if a limit cannot be set, or if a kernel that has Landlock or seccomp refuses it.
void confine_this_process();

}  // namespace afm::curves
