// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace afm::app {

// Names that must not leave this machine.
struct PrivateWords {
  std::vector<std::string> homes{};  // home folders
  std::vector<std::string> users{};  // login names, and the words of full names
  std::vector<std::string> hosts{};  // names of this computer, and of that of a forwarded display
  std::vector<std::string> paths{};  // absolute paths in the environment; they may contain blanks
};

// Words of this process, and of the person who became root through sudo.
PrivateWords private_words();

// Replaces names by ~, USER and HOST, folders outside the system's own by "...", keeping the name of the file, and
// the digits after "serial".
// Names count as whole words in any case, so that a user "an" leaves "an error" alone; names shorter than three
// letters stay.
std::string without(const PrivateWords& secrets, std::string text);

// Name of a device without its serial number and without all words that belong to no known model or maker, because its
// owner may have named it.
std::string model_of(std::string_view device_name);

}  // namespace afm::app
