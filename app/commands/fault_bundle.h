// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/commands/machine_facts.h"

namespace afm::app {

// What must not leave this machine. Empty: there is none.
struct PrivateWords {
  std::string home{};  // folder
  std::string user{};
  std::string host{};
};

PrivateWords private_words();

// The text with ~, USER and HOST in their place, and no home folder of anyone else. Names count as whole words, so that
// a user "an" leaves "an error" alone: names of fewer than three letters stay.
std::string without(const PrivateWords& secrets, std::string text);

// What a report of a fault needs to say about this machine, as text to be read before it is sent. `findings` is what
// touchafm doctor prints.
std::string fault_bundle(const MachineFacts& facts, const std::string& findings);

}  // namespace afm::app
