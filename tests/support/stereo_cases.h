// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "support/places.h"

namespace afm::test {

// A row of tests/scene/data/stereo_cases.csv, the research's test vectors.
struct StereoCase {
  std::string id, kind, convention;
  std::string input;           // text in the file
  std::vector<double> inputs;  // values, if the text is a list of numbers
  std::vector<double> expected;
};

// Numbers in the text, up to the first other word.
inline std::vector<double> numbers(const std::string& text) {
  std::istringstream stream(text);
  std::vector<double> values;
  for (std::string word; stream >> word;) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);  // value; unlike >>, strtod knows "inf"
    if (end != word.c_str() + word.size()) break;
    values.push_back(value);
  }
  return values;
}

inline std::vector<StereoCase> stereo_cases(const std::string& kind) {
  std::ifstream file(support::source("tests/scene/data/stereo_cases.csv"));
  std::vector<StereoCase> cases;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    if (fields.size() >= 6 && fields[1] == kind) {
      cases.push_back({fields[0], fields[1], fields[2], fields[4], numbers(fields[4]), numbers(fields[5])});
    }
  }
  return cases;
}

}  // namespace afm::test
