// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace afm::support {

// Size of a class, as its definition has it. Nested classes are counted by themselves.
struct ClassShape {
  std::string name;
  int fields = 0;     // not static
  int functions = 0;  // every declaration, constructors and operators too
};

// All classes and structs that a C++ source defines, those in functions left out.
std::vector<ClassShape> classes_of(std::string_view source);

// Names of the classes whose members a C++ source defines outside the class, as they stand there ("Outer::Inner");
// namespaces, whose functions are defined so, are among them.
std::set<std::string> owners_of_members(std::string_view source);

}  // namespace afm::support
