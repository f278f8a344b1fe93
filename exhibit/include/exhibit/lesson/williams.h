// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace afm::exhibit {

// The orders in which participants meet `conditions` conditions (Williams 1949): each condition stands at each place
// equally often, and each follows each other one equally often. As many orders as conditions for an even number, twice
// as many for an odd one. Participant p takes order p modulo their number.
std::vector<std::vector<std::size_t>> williams_orders(std::size_t conditions);

}  // namespace afm::exhibit
