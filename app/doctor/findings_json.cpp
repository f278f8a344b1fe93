// SPDX-License-Identifier: Apache-2.0
#include "app/doctor/findings_json.h"

#include <nlohmann/json.hpp>

namespace afm::app {

nlohmann::json to_json(const std::vector<Finding>& findings) {
  nlohmann::json checks = nlohmann::json::array();
  for (const Finding& f : findings) {
    checks.push_back({{"check", f.check}, {"verdict", word(f.verdict)}, {"found", f.found}, {"mend", f.fix}});
  }
  return checks;
}

}  // namespace afm::app
