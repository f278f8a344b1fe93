// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/commands/machine_facts.h"

namespace afm::app {

// Names that must not leave this machine; an empty one is unknown.
struct PrivateWords {
  std::string home{};  // home folder
  std::string user{};
  std::string host{};
};

PrivateWords private_words();

// Replaces the names by ~, USER and HOST, and removes all other home folders. Matches whole words only, and leaves
// names of fewer than three letters, so that a user "an" does not change "an error".
std::string without(const PrivateWords& secrets, std::string text);

// Text for a fault report: readable facts about this machine, for the user to check before sending. `findings` is the
// output of touchafm doctor.
std::string fault_bundle(const MachineFacts& facts, const std::string& findings);

}  // namespace afm::app
