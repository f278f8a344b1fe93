// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace afm::physics {

// One row of data/paper_cases.csv.
struct Case {
  std::string id;
  std::map<std::string, std::string> inputs;  // "A=2.45e-20;R=5e-08" by name
  std::string output;
  std::string expected;
  double relative_tolerance = 0.0;
};

// All rows; throws std::runtime_error if the file is missing or a row is not as expected.
std::vector<Case> read_cases(const std::string& path);

}  // namespace afm::physics
