// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace afm::support {

// Size of a class, from its definition. Nested classes are counted separately.
struct ClassShape {
  std::string name;
  int fields = 0;     // number of non-static fields
  int functions = 0;  // number of declarations, including constructors and operators
};

// All classes and structs that a C++ source defines, except those in functions.
std::vector<ClassShape> classes_of(std::string_view source);

// Names of the classes whose members a C++ source defines outside the class, as written there ("Outer::Inner");
// includes namespaces whose functions are defined in this way.
std::set<std::string> owners_of_members(std::string_view source);

}  // namespace afm::support
