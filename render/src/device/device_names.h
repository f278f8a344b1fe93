// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/result.h"

namespace afm::render {

// The drivers' names of a machine's graphics devices, made distinct: the second of two equal names gets " #2".
std::vector<std::string> distinct_names(std::vector<std::string> names);

// Index of the device that a user means by `wanted`: the one with that name, otherwise the only one whose name contains
// it; ignores the case of A to Z. `names` are distinct. DeviceMissing: no match; WrongUsage: several
// matches. Both messages list the names.
core::Result<std::size_t> find_device(const std::vector<std::string>& names, const std::string& wanted);

}  // namespace afm::render
