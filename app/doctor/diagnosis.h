// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/doctor/machine_facts.h"

namespace afm::app {

enum class Verdict {
  Good,
  Limited,  // works, but not as well as it could
  Missing,  // optional feature that does not work
};

struct Finding {
  std::string check;
  Verdict verdict = Verdict::Good;
  std::string found;
  std::string fix;  // command or instruction as a remedy; empty if good
};

// Returns one finding per check, in a fixed order.
std::vector<Finding> diagnose(const MachineFacts& facts);

const char* word(Verdict verdict);

}  // namespace afm::app
