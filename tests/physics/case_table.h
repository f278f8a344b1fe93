// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace afm::physics {

// One row of data/physics_cases.csv: the expected value of one output for given inputs, found by independent
// solvers. SI.
struct Case {
  std::string id;                             // "jkr_04"; several rows share it
  std::string name;                           // name of the row's test: "jkr_04_z_out_2", unique in the table
  std::map<std::string, std::string> inputs;  // "A=2.45e-20;R=5e-08" by name
  std::string output;
  std::string expected;  // a number, or several between blanks
  double relative_tolerance = 0.0;
  double absolute_tolerance = 0.0;

  // An input as a number ("inf" is one); throws std::out_of_range if the row has no such input.
  double input(const std::string& key) const { return std::stod(inputs.at(key)); }
  double input_or(const std::string& key, double otherwise) const {
    return inputs.contains(key) ? input(key) : otherwise;
  }

  // Largest accepted difference of a result from `expected_value`: the larger of the two tolerances.
  double allowed_error(double expected_value) const;
};

// Prints a row in the messages of failing tests.
void PrintTo(const Case& row, std::ostream* out);

// Passes if `actual` agrees with a row with one number, within its tolerance.
void expect_agrees(const Case& row, double actual);

// The numbers of a field that holds several.
std::vector<double> numbers(const std::string& text);

// All rows; throws std::runtime_error if the file is missing or a row is malformed.
std::vector<Case> read_cases();

// Test program that checks a row.
enum class CaseProgram {
  Cycle,     // cycle_cases: whole cycles and their folds, through lever and support
  Contact,   // contact_cases: the laws of force alone
  Lever,     // lever_cases: thermal noise, dynamics, beams
  Friction,  // friction_cases: lateral forces on the tip
};
std::vector<Case> cases_of(CaseProgram program);

}  // namespace afm::physics
