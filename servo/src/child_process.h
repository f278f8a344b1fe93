// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <array>
#include <string>
#include <vector>

#include "core/result.h"

namespace afm::servo {

// Numbers of the two inherited descriptors in a child.
inline constexpr std::array<int, 2> kInherited{3, 4};

// Starts a program in its own process group, so that Ctrl-C in a terminal reaches it only through its parent. It
// inherits only the standard streams and the two descriptors, as kInherited: a lifeline held open by another child
// would never close.
core::Result<pid_t> start_child(const std::string& program, std::vector<std::string> arguments,
                                const std::array<int, 2>& descriptors);

// True if the child ends within this time; it is then reaped, and `status` is that of waitpid().
bool child_ended_within(pid_t child, int milliseconds, int& status) noexcept;

}  // namespace afm::servo
