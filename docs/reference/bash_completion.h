// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/options/command_line.h"

namespace afm::reference {

// The words for a value, by what the help calls it ("MATERIAL"). Values in braces bring their own words; those that
// name a FILE or SESSION, or a DIR, are completed as files or folders.
using ValueWords = std::map<std::string, std::vector<std::string>>;

// The script that bash sources to complete the program's command line. It starts no program.
std::string bash_completion(const app::CommandDescription& program, const ValueWords& words);

}  // namespace afm::reference
