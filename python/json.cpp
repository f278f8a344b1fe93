// SPDX-License-Identifier: Apache-2.0
#include "python/json.h"
#include "core/json_text.h"

#include <nlohmann/json.hpp>

namespace afm::python {

pybind11::dict dict_of(const nlohmann::ordered_json& json) { return dict_of_text(core::json_text(json)); }

pybind11::dict dict_of_text(const std::string& json) { return pybind11::module_::import("json").attr("loads")(json); }

}  // namespace afm::python
