// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/commands/machine_facts.h"

namespace afm::app {

// Names that must not leave this machine. Empty: unknown.
struct PrivateWords {
  std::string home{};  // folder
  std::string user{};
  std::string host{};
};

PrivateWords private_words();

// Replaces the names by ~, USER and HOST, and removes all other home folders. Names count as whole words, so that a
// user "an" leaves "an error" alone: names of fewer than three letters stay.
std::string without(const PrivateWords& secrets, std::string text);

// Text for a fault report: the facts about this machine, readable, for the user to check before sending. `findings` is
// the output of touchafm doctor.
std::string fault_bundle(const MachineFacts& facts, const std::string& findings);

}  // namespace afm::app
