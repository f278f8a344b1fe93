// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/options/command_line.h"

namespace afm::reference {

struct Release {
  std::string version;
  std::string date;  // year-month-day
};

// The man page of the whole program in roff's macros "man", from nothing but its help: a section for each command, and
// for each command of a command.
std::string man_page(const app::CommandDescription& program, const Release& release);

}  // namespace afm::reference
