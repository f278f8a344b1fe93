// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace afm::curves {

// Runs `work` in a forked child that may take half a GiB of memory and three seconds of processor time more than there
// is now, and gives back what it returned: for libraries that crash on damaged files, as HDF5 1.10 does. Throws
// CurveError with the child's own message, or `on_death` if it died, and std::runtime_error if no child could be made.
//
// Not for a servo or any thread that others depend on. In a program with more threads the work may use nothing that
// another of them may have locked, memory aside.
std::string in_confined_child(const std::function<std::string()>& work, const std::string& on_death);

}  // namespace afm::curves
