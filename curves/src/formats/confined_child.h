// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace afm::curves {

inline constexpr auto kChildPatience = std::chrono::seconds(20);

// Exit status of a child. Done: its result was written. Fault: a fault of the file was written. Failed: neither could
// be written.
enum class ChildExit : int { Done = 0, Fault = 1, Failed = 2 };

// Runs `work` in a forked, confined child (confine_this_process), and returns its result: for libraries that crash on
// damaged files, as HDF5 1.10 does. The child has no descriptors except stderr and its pipe, dies with the calling
// thread, and is killed after `patience`. Throws CurveError with the child's own message, or `on_death` if it died, and
// std::runtime_error if no child could be created.
//
// Never call it in the servo or a thread that others depend on. If the program has other threads, `work` must not use
// anything that they may have locked, except memory allocation.
std::string in_confined_child(const std::function<std::string()>& work, const std::string& on_death,
                              std::chrono::milliseconds patience = kChildPatience);

// The same with one of our programs, in the running one's folder or in ../bin, which confines itself. Passes `input` on
// stdin and returns its stdout. Throws std::runtime_error also if there is no such program.
std::string from_confined_program(const std::string& name, const std::vector<std::string>& arguments,
                                  std::string_view input, const std::string& on_death,
                                  std::chrono::milliseconds patience = kChildPatience);

}  // namespace afm::curves
