// SPDX-License-Identifier: Apache-2.0
#include "python/json.h"

#include <nlohmann/json.hpp>

namespace afm::python {

pybind11::dict dict_of(const nlohmann::ordered_json& json) {
  return pybind11::module_::import("json").attr("loads")(json.dump());
}

}  // namespace afm::python
