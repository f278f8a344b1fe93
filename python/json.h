// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace afm::python {

// JSON as Python's objects, by way of the text that a command prints, so that every number has its digits.
pybind11::dict dict_of(const nlohmann::ordered_json& json);
pybind11::dict dict_of_text(const std::string& json);

}  // namespace afm::python
