// SPDX-License-Identifier: Apache-2.0
#include "case_table.h"

#include <fstream>
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

}  // namespace

std::vector<Case> read_cases(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::string line;
  std::getline(file, line);
  if (line != "case_id,group,model,description,inputs,output,expected,unit,tol_rel,tol_abs,source") {
    throw std::runtime_error("unknown columns in " + path);
  }
  std::vector<Case> cases;
  while (std::getline(file, line)) {
    const auto fields = split_row(line);
    if (fields.size() != 11) throw std::runtime_error("not 11 fields: " + line);
    cases.push_back({fields[0], read_inputs(fields[4]), fields[5], fields[6], std::stod(fields[8])});
  }
  return cases;
}

}  // namespace afm::physics
