// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace afm::support {

// Names in a C++ source.
struct FunctionNames {
  // Functions declared or defined outside function bodies, without constructors, operators, and overriding functions,
  // which are called through their base.
  std::set<std::string> declared;
  std::map<std::string, int> used;  // number of other occurrences of every name
};

FunctionNames function_names_of(std::string_view source);

}  // namespace afm::support
