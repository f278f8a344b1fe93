// SPDX-License-Identifier: Apache-2.0
#include "case_table.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <ostream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace afm::physics {
namespace {

// Comma-separated, with quotes around fields that hold commas.
std::vector<std::string> split_row(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

std::map<std::string, std::string> read_inputs(const std::string& text) {
  std::map<std::string, std::string> inputs;
  std::istringstream stream(text);
  for (std::string pair; std::getline(stream, pair, ';');) {
    const std::size_t equals = pair.find('=');
    if (equals == std::string::npos) throw std::runtime_error("not name=value: " + pair);
    inputs[pair.substr(0, equals)] = pair.substr(equals + 1);
  }
  return inputs;
}

double tolerance(const std::string& text) { return text.empty() ? 0.0 : std::stod(text); }

CaseProgram program_of(const std::string& id) {
  static const std::set<std::string> kContactCases{"vdw_01", "dmt_04", "jkr_01", "md_01", "md_02", "md_03",
                                                   "md_04",  "md_05",  "md_07",  "md_08", "cap_01"};
  if (kContactCases.contains(id)) return CaseProgram::Contact;
  const std::string family = id.substr(0, id.find('_'));
  if (family == "thermal" || family == "dyn" || family == "beam") return CaseProgram::Lever;
  if (family == "friction") return CaseProgram::Friction;
  return CaseProgram::Cycle;
}

}  // namespace

double Case::allowed_error(double expected_value) const {
  return std::max(relative_tolerance * std::abs(expected_value), absolute_tolerance);
}

void PrintTo(const Case& row, std::ostream* out) { *out << row.name << ", expected " << row.expected; }

void expect_agrees(const Case& row, double actual) {
  const double expected = std::stod(row.expected);
  EXPECT_NEAR(actual, expected, row.allowed_error(expected));
}

std::vector<double> numbers(const std::string& text) {
  std::vector<double> values;
  std::istringstream stream(text);
  for (double value; stream >> value;) values.push_back(value);
  if (!stream.eof()) throw std::runtime_error("not numbers: " + text);
  return values;
}

std::vector<Case> read_cases() {
  const std::string path = support::source("tests/physics/data/physics_cases.csv");
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::string line;
  std::getline(file, line);
  if (line != "case_id,group,model,description,inputs,output,expected,unit,tol_rel,tol_abs,source") {
    throw std::runtime_error("unknown columns in " + path);
  }
  std::vector<Case> cases;
  std::map<std::string, int> rows_of_name;
  while (std::getline(file, line)) {
    const auto fields = split_row(line);
    if (fields.size() != 11) throw std::runtime_error("not 11 fields: " + line);
    std::string name = fields[0] + "_" + fields[5];
    if (const int rows = ++rows_of_name[name]; rows > 1) name += "_" + std::to_string(rows);
    cases.push_back(
        {fields[0], name, read_inputs(fields[4]), fields[5], fields[6], tolerance(fields[8]), tolerance(fields[9])});
  }
  return cases;
}

std::vector<Case> cases_of(CaseProgram program) {
  std::vector<Case> cases = read_cases();
  std::erase_if(cases, [program](const Case& row) { return program_of(row.id) != program; });
  return cases;
}

}  // namespace afm::physics
