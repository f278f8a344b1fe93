// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/options/command_line.h"

namespace afm::app {

// Command that was typed last.
struct TypedCommand {
  std::string words;  // words such as "touchafm bench render"
  CommandDescription command;
  std::vector<std::string> left;  // words that fit nothing
};

// Accepted values of the option or argument of this name, as in the help.
std::string taken_by(const CommandDescription& command, const std::string& name);

// Refusal of a text that is no number: "cannot read ...; give SECONDS, without a unit". `value`: accepted values of the
// option, or empty.
std::string no_number(const std::string& value, const std::string& written);

// Message about a wrong command line, in the user's words, with a correction and a pointer to further reading. `text`
// is the parser's message; `incomplete`: words are left, or something required is missing, perhaps under a wrong name.
std::string usage_text(const TypedCommand& typed, const std::string& text, bool incomplete);

}  // namespace afm::app
