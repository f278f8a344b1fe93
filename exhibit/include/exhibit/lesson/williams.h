// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace afm::exhibit {

// Orders of `conditions` conditions for participants (Williams 1949): each condition is at each position equally often,
// and follows each other condition equally often. There are as many orders as conditions for an even number, twice as
// many for an odd one. Participant p takes order p modulo their number.
std::vector<std::vector<std::size_t>> williams_orders(std::size_t conditions);

}  // namespace afm::exhibit
