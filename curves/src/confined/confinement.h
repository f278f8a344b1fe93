// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace afm::curves {

// Limits this process until its end: at most half a GiB of memory and this processor time more than now, and no opening
// of files, sockets or processes, by Landlock and a seccomp filter if the kernel has them. Open descriptors stay open.
// Throws std::runtime_error if a limit cannot be set, or if a kernel that has Landlock or seccomp refuses it.
void confine_this_process(std::chrono::seconds processor_time);

}  // namespace afm::curves
