// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace afm::app {

// Word that a person who typed `typed` probably meant: the one with the fewest letters added, left out or
// replaced (Levenshtein's distance), at most a third of them or two of four; else one that contains it. Empty: none.
std::string nearest_word(const std::string& typed, const std::vector<std::string>& words);

// Text such as " (did you mean --step?)", or empty.
std::string suggestion(const std::string& typed, const std::vector<std::string>& words);

}  // namespace afm::app
