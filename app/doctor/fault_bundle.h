// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/doctor/machine_facts.h"

namespace afm::app {

// Text for a fault report: readable facts about this machine, for the user to check before sending. `findings` is the
// output of touchafm doctor.
std::string fault_bundle(const MachineFacts& facts, const std::string& findings);

}  // namespace afm::app
