// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace afm::curves {

inline constexpr auto kChildPatience = std::chrono::seconds(20);

// How a child ended: its result, or what is wrong with the file, was written; or it could not do that.
enum class ChildExit : int { Done = 0, Fault = 1, Failed = 2 };

// Runs `work` in a forked child that is confined (confine_this_process), and gives back what it returned: for libraries
// that crash on damaged files, as HDF5 1.10 does. The child holds no descriptor but stderr and its pipe, dies with the
// thread that called, and is killed after `patience`. Throws CurveError with the child's own message, or `on_death` if
// it died, and std::runtime_error if no child could be made.
//
// Not for a servo or any thread that others depend on. In a program with more threads the work may use nothing that
// another of them may have locked, memory aside.
std::string in_confined_child(const std::function<std::string()>& work, const std::string& on_death,
                              std::chrono::milliseconds patience = kChildPatience);

// The same with a program of ours, which lies beside the running one or in ../bin and confines itself: what it writes
// to stdout when it is given `input` on stdin. std::runtime_error also if there is no such program.
std::string from_confined_program(const std::string& name, const std::vector<std::string>& arguments,
                                  std::string_view input, const std::string& on_death,
                                  std::chrono::milliseconds patience = kChildPatience);

}  // namespace afm::curves
