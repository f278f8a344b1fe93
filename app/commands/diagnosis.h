// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/commands/machine_facts.h"

namespace afm::app {

enum class Verdict {
  Good,
  Limited,  // TouchAFM works, and less well than it could
  Missing,  // something that a person may want does not work
};

struct Finding {
  std::string check;
  Verdict verdict = Verdict::Good;
  std::string found;
  std::string fix;  // the fix: a command to type or an instruction; empty if good
};

// One finding a check, in a fixed order.
std::vector<Finding> diagnose(const MachineFacts& facts);

const char* word(Verdict verdict);

}  // namespace afm::app
